// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// XXH3 over the bits of all numbers and texts of a picture, in the order of its lists. Pictures
/// with equal hashes are drawn alike by the same renderer.
[[nodiscard]] std::uint64_t hash_of(const Picture& picture);

}  // namespace oiler
