// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace oiler {

/// Width of a line of text in the units of its font size, estimated from DejaVu Sans: a picture
/// does not know its font.
[[nodiscard]] float text_width(std::string_view words, float size);

}  // namespace oiler
