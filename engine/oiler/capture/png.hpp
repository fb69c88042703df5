// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "oiler/core/size.hpp"

namespace oiler {

/// Encodes 8-bit RGB pixels as PNG. Rows have no padding, bottom row first, as GL reads them. For
/// speed it uses one filter (up) and the fastest deflate. The same pixels always give the same
/// bytes. Throws Error(Exit::usage) for an empty frame or a frame of 1 GiB and more.
[[nodiscard]] std::vector<std::byte> encode_png(Size size,
                                                std::span<const std::uint8_t> rgb_bottom_up);

/// Pixels as encode_png() takes them.
struct Image {
    Size size;
    std::vector<std::uint8_t> rgb_bottom_up;
};

/// The size of a PNG file as its header has it. Throws Error{usage} if it is damaged; `file` is
/// named in the message.
[[nodiscard]] Size size_of_png(std::span<const std::byte> png, std::string_view file);

/// Decodes a PNG file. Throws Error{usage} if it is damaged or has more than 1 GiB. Takes no memory
/// for more pixels than the header says.
[[nodiscard]] Image decode_png(std::span<const std::byte> png, std::string_view file);

/// XXH3 over the rows of pixels, top row first, as in the PNG.
[[nodiscard]] std::uint64_t hash_top_down(Size size, std::span<const std::uint8_t> rgb_bottom_up);

}  // namespace oiler
