// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "oiler/core/size.hpp"

namespace oiler {

/// A PNG of 8-bit RGB pixels, whose rows come without padding and bottom row first, as GL reads
/// them back. Tuned for speed: one filter (up) and the fastest deflate; the same pixels always give
/// the same bytes. Throws Error(Exit::usage) for an empty frame or one of a gigabyte and more.
[[nodiscard]] std::vector<std::byte> encode_png(Size size,
                                                std::span<const std::uint8_t> rgb_bottom_up);

}  // namespace oiler
