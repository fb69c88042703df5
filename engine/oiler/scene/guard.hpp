// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace oiler {

/// The most bytes of a scene file.
inline constexpr std::size_t most_scene_bytes = std::size_t{64} * 1024;

/// The bytes of a file, of which at most one more is read than a scene may have. Throws
/// Error{usage} for what is no file, such as a folder or a device, before anything is read of it,
/// and Error{io} where reading fails.
[[nodiscard]] std::string read_scene_text(const std::string& path);

/// Refuses what the TOML parser is known to crash of, or not known to survive: more bytes than
/// that, bytes that are no ASCII text, keys of more than 32 parts, brackets deeper than 64. Throws
/// Error{usage} that names the line.
void guard_scene_text(std::string_view text, std::string_view file);

}  // namespace oiler
