// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// Adds a line of text on the canvas, in its colour or the nearest one that can be read on the
/// background of the picture: see readable().
Label& add_text(Picture& picture, Point at, std::string words, float size, Colour colour,
                Align align = Align::left);

/// Width of a line of text in the units of its font size, estimated from DejaVu Sans: a picture
/// does not know its font.
[[nodiscard]] float text_width(std::string_view words, float size);

}  // namespace oiler
