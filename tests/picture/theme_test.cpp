// SPDX-License-Identifier: MIT
#include "oiler/picture/theme.hpp"

#include "oiler/picture/palette.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

// WCAG's examples: black on white is 21, #777777 on white 4.48, #767676 the first grey above 4.5.
TEST(Contrast, IsThatOfTheGuidelines) {
    EXPECT_NEAR(contrast(palette::black, palette::paper), 21, 1e-9);
    EXPECT_NEAR(contrast({0x77, 0x77, 0x77}, palette::paper), 4.478, 5e-4);
    EXPECT_NEAR(contrast(palette::paper, {0x76, 0x76, 0x76}), 4.542, 5e-4);
    EXPECT_EQ(contrast(palette::green, palette::green), 1);
}

// The contrast of Okabe and Ito's orange with white is 2.25, that of their blue 5.19; white on a
// grey of 118 has 4.54.
TEST(Contrast, ReadableColoursChangeOnlyAsFarAsTheyMust) {
    constexpr double least = 4.5, slightly_more = 4.75;
    EXPECT_NEAR(contrast(palette::orange, palette::paper), 2.25, 5e-3);
    EXPECT_EQ(readable(palette::blue), palette::blue);
    for (const Colour colour : {palette::orange, palette::sky_blue, palette::green,
                                palette::vermilion, palette::purple, palette::grey}) {
        EXPECT_GE(contrast(readable(colour), palette::paper), least);
        EXPECT_LE(contrast(readable(colour), palette::paper), slightly_more);
        for (const Colour ground :
             {palette::black, palette::pale, Colour{117, 117, 117}, Colour{118, 118, 118}, colour})
            EXPECT_GE(contrast(readable(colour, ground), ground), least) << int{ground.g};
    }
}

TEST(Theme, HasInkThatCanBeReadOnEachGround) {
    constexpr double least = 4.5;
    constexpr std::uint8_t sheet = 232;  // the opacity of sheets over a picture
    for (const Colour background : {palette::paper, palette::black}) {
        const Theme& theme = theme_of(background);
        std::vector<Colour> grounds{theme.paper,  theme.panel,   theme.field, theme.heading,
                                    theme.button, theme.pressed, theme.knob};
        for (const Colour below : {palette::paper, palette::black})
            grounds.push_back(palette::mix(below, theme.paper, sheet / 255.0F));
        for (const Colour ground : grounds) {
            const bool is_control = ground == theme.pressed || ground == theme.knob;
            EXPECT_GE(contrast(theme.ink, ground), least) << int{ground.g};
            if (!is_control) {
                EXPECT_GE(contrast(theme.faint, ground), least) << int{ground.g};
            }
        }
    }
}

TEST(Theme, FollowsTheBackground) {
    const Theme& light = theme_of(palette::paper);
    const Theme& dark = theme_of(palette::black);
    EXPECT_GT(light.paper.g, light.ink.g);
    EXPECT_LT(dark.paper.g, dark.ink.g);
    // A grey of 117 has the same contrast, 4.58, with black and white.
    EXPECT_EQ(&theme_of({117, 117, 117}), &dark);
    EXPECT_EQ(&theme_of({118, 118, 118}), &light);
    EXPECT_EQ(&theme_of({214, 236, 250}), &light) << "a sky";
    EXPECT_EQ(&theme_of({20, 24, 82}), &dark) << "a night";
}

}  // namespace
}  // namespace oiler::test
