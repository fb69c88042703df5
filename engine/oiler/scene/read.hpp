// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/scene/scene.hpp"

namespace oiler {

/// The scene that a file describes. Throws Error{usage} for a file that is none, in one line with
/// file, line, key and remedy, and Error{io} where it cannot be read.
[[nodiscard]] Scene read_scene(const std::string& path);

/// The same of a text; `file` is for the messages.
[[nodiscard]] Scene parse_scene(std::string_view text, std::string_view file);

}  // namespace oiler
