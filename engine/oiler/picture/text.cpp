// SPDX-License-Identifier: MIT
#include "oiler/picture/text.hpp"

#include <utility>

#include "oiler/picture/theme.hpp"

namespace oiler {
namespace {

/// Width of a letter in ems, rounded from DejaVu Sans. Continuation bytes of UTF-8 have width 0.
float width_of(char letter) {
    const auto is_in = [&](std::string_view set) { return set.find(letter) != set.npos; };
    if ((letter & 0xC0) == 0x80) return 0;
    if (is_in("ijlI.,:;'!- ")) return 0.32F;
    if (is_in("frt()/")) return 0.4F;
    if (letter == '_') return 0.5F;
    if (is_in("mMwW%")) return 1;
    if ((letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z')) return 0.66F;
    return 0.6F;
}

}  // namespace

Label& add_text(Picture& picture, Point at, std::string words, float size, Colour colour,
                Align align) {
    return picture.labels.emplace_back(Label{.at = at,
                                             .text = std::move(words),
                                             .size = size,
                                             .colour = readable(colour, picture.background),
                                             .align = align});
}

float text_width(std::string_view words, float size) {
    float width = 0;
    for (const char letter : words) width += size * width_of(letter);
    return width;
}

}  // namespace oiler
