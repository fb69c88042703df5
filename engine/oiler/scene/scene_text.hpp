// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler {

/// Reads a scene file, but at most `most_toml_bytes` + 1 bytes. Throws Error{usage} before reading
/// if the path is not a regular file, such as a folder or a device. Throws Error{io} if reading
/// fails.
[[nodiscard]] std::string read_scene_text(const std::string& path);

}  // namespace oiler
