// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oiler/core/size.hpp"

namespace oiler {

/// Parses a width and a height in pixels such as "1280x720". Throws Error{usage}.
[[nodiscard]] Size parse_size(const std::string& words);

}  // namespace oiler
