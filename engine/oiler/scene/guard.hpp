// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace oiler {

/// Largest size of a scene file, in bytes.
inline constexpr std::size_t most_scene_bytes = std::size_t{64} * 1024;

/// Reads a file, but at most `most_scene_bytes` + 1 bytes. Throws Error{usage} before reading if
/// the path is not a regular file, such as a folder or a device. Throws Error{io} if reading fails.
[[nodiscard]] std::string read_scene_text(const std::string& path);

/// Refuses texts that may crash the TOML parser: more than `most_scene_bytes` bytes, bytes other
/// than ASCII text, keys of more than 32 parts, brackets nested deeper than 64. Throws Error{usage}
/// with the line.
void guard_scene_text(std::string_view text, std::string_view file);

}  // namespace oiler
