// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/scene/scene.hpp"

namespace oiler {

/// Reads a scene file, but at most `most_toml_bytes` + 1 bytes. Throws Error{usage} before reading
/// if the path is not a regular file, such as a folder or a device. Throws Error{io} if reading
/// fails.
[[nodiscard]] std::string read_scene_text(const std::string& path);

/// Reads a scene file. Throws Error{usage} if it is not a valid scene, in one line with file, line,
/// key and remedy. Throws Error{io} if reading fails.
[[nodiscard]] Scene read_scene(const std::string& path);

/// Reads a scene from a text; messages name `file`. Throws Error{usage} like read_scene.
[[nodiscard]] Scene parse_scene(std::string_view text, std::string_view file);

/// Returns the text of a scene file with the rate, method, precision and damping of `stepping`. All
/// other bytes stay, comments and spacing included, and so do values that already agree. Throws
/// Error{usage} if the text is not a valid scene, or if its forces do not suit the method.
[[nodiscard]] std::string apply(std::string_view text, std::string_view file,
                                const Stepping& stepping);

}  // namespace oiler
