// SPDX-License-Identifier: MIT
#include "oiler/picture/text.hpp"

#include "oiler/picture/palette.hpp"
#include "oiler/picture/theme.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

// The contrast of orange with white is 2.25, with black 9.3.
TEST(AddText, CanBeReadOnTheBackground) {
    for (const Colour background : {palette::paper, palette::black, palette::pale}) {
        Picture picture{.background = background};
        const Label label = add_text(picture, {3, 4}, "60 Hz", 9, palette::orange, Align::right);
        EXPECT_GE(contrast(label.colour, background), 4.5);
        EXPECT_EQ(label.at, (Point{3, 4}));
        EXPECT_EQ(label.text, "60 Hz");
        EXPECT_EQ(label.size, 9);
        EXPECT_EQ(label.align, Align::right);
        EXPECT_EQ(label.space, Space::canvas);
    }
    Picture dark{.background = palette::black};
    EXPECT_EQ(add_text(dark, {}, "kept", 9, palette::orange).colour, palette::orange);
}

// Advance widths of DejaVu Sans, in 1/2048 em: 6 and 0 1303, space 651, H 1540, z 1075; ω 1715.
TEST(TextWidth, IsAboutThatOfTheFont) {
    EXPECT_NEAR(text_width("60 Hz", 2048), 1303 + 1303 + 651 + 1540 + 1075, 0.1 * 5872);
    EXPECT_EQ(text_width("ω", 10), text_width("w", 10) * 0.6F) << "one letter of two bytes";
    EXPECT_EQ(text_width("", 10), 0);
}

}  // namespace
}  // namespace oiler::test
