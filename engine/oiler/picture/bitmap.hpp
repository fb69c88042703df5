// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/size.hpp"

namespace oiler {

/// The texels of an image. Copies of a game share it, because it never changes.
struct Bitmap {
    Size size;
    std::vector<std::uint8_t> rgba;  ///< top row first, alpha not premultiplied
    std::uint64_t hash = 0;          ///< of size and texels
};

/// Makes a bitmap of width × height × 4 bytes, top row first. Throws Error{usage} if their number
/// is wrong, or a side is longer than 8192 texels.
[[nodiscard]] std::shared_ptr<const Bitmap> make_bitmap(Size size, std::vector<std::uint8_t> rgba);

/// Decodes a PNG or JPEG. Throws Error{usage}; `name` is named in the message.
[[nodiscard]] std::shared_ptr<const Bitmap> decode_bitmap(std::span<const std::byte> file,
                                                          std::string_view name);

/// Reads a PNG or JPEG file. A relative path is looked for beside the program, then beside the
/// source file that calls this, then in the working directory. Throws Error{usage}, or Error{io} if
/// the machine cannot read it.
[[nodiscard]] std::shared_ptr<const Bitmap> load_bitmap(const std::string& path,
                                                        const char* source = __builtin_FILE());

}  // namespace oiler
