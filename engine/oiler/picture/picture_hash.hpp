// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// XXH3 over the bits of all numbers and texts of a picture. Pictures with equal hashes are drawn
/// alike by the same renderer. Layers of 0, and lists that Oiler 0.1 did not have, are hashed only
/// if they are used, so that its captures stay comparable.
[[nodiscard]] std::uint64_t hash_of(const Picture& picture);

}  // namespace oiler
