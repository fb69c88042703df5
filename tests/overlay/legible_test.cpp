// SPDX-License-Identifier: MIT
// Labels of games in small windows: large enough to read, and none in another one.
#include "oiler/overlay/legible.hpp"

#include <algorithm>
#include <limits>

#include "oiler/picture/text.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr float rounding = 1e-3F;

float width_of(const Label& label) { return text_width(label.text, label.size); }

/// The ends of a label along x.
std::pair<float, float> ends_of(const Label& label) {
    const float width = width_of(label);
    const float left = label.at.x - (label.align == Align::left     ? 0
                                     : label.align == Align::centre ? width / 2
                                                                    : width);
    return {left, left + width};
}

bool touch(const Label& a, const Label& b) {
    const auto [a_left, a_right] = ends_of(a);
    const auto [b_left, b_right] = ends_of(b);
    const float a_low = a.at.y - 0.24F * a.size, a_high = a.at.y + 0.76F * a.size;
    const float b_low = b.at.y - 0.24F * b.size, b_high = b.at.y + 0.76F * b.size;
    return a_left < b_right && b_left < a_right && a_low < b_high && b_low < a_high;
}

TEST(Legible, LabelsHave9PixelsAtLeast) {
    Picture picture;
    picture.labels = {{.at = {10, 10}, .text = "small", .size = 8},
                      {.at = {10, 100}, .text = "large", .size = 20},
                      {.at = {10, 200}, .text = "metres", .size = 0.5F, .size_in = Space::world}};
    Picture large = picture;
    keep_legible(picture, OverlayArea({400, 300}));
    EXPECT_NEAR(picture.labels[0].size * 0.625F, 9, rounding);
    EXPECT_EQ(picture.labels[1].size, 20);
    EXPECT_EQ(picture.labels[2].size, 0.5F);
    keep_legible(large, OverlayArea({1280, 720}));
    EXPECT_EQ(large.labels[0].size, 8);
    keep_legible(large, OverlayArea({64, 36}));
    EXPECT_EQ(large.labels[0].size, 16) << "twice as large";
}

// A letter x is 0.6 of its size wide: 30 letters of 8 units are 144 units.
TEST(Legible, LabelsStayWithinTheEdges) {
    Picture picture{
        .labels = {
            {.at = {440, 0}, .text = std::string(30, 'x'), .size = 8},
            {.at = {200, 50}, .text = std::string(30, 'x'), .size = 8, .align = Align::right},
            {.at = {540, 90}, .text = std::string(30, 'x'), .size = 8, .align = Align::centre}}};
    keep_legible(picture, OverlayArea({400, 300}));
    for (const Label& label : picture.labels) {
        EXPECT_GT(label.size, 8);
        EXPECT_GE(ends_of(label).first, -rounding);
        EXPECT_LE(ends_of(label).second, 640 + rounding);
    }
}

// A window of 800 by 225 pixels is 1280 by 360 units: 320 beside the canvas on each side. From 440
// on, a label has 200 units of the canvas and those at the right: 320, or 640 in the left corner.
TEST(Legible, LabelsHaveTheRoomOfTheirCorner) {
    const auto legible = [](Space space, bool has_bars) {
        Picture picture{
            .labels = {{.at = {440, 0}, .text = std::string(119, 'x'), .size = 8, .space = space}},
            .has_bars = has_bars};
        keep_legible(picture, OverlayArea({800, 225}));
        return picture.labels[0].size;
    };
    EXPECT_EQ(legible(Space::canvas, false), 8);
    EXPECT_EQ(legible(Space::upper_right, false), 8);
    // 840 units for 119 letters of 0.6 of the size, with 6 % more and a space of 0.15.
    EXPECT_NEAR(legible(Space::upper_left, false), 840 / (1.06F * 0.6F * 119 + 0.15F), rounding);
    EXPECT_EQ(legible(Space::upper_left, true), 8) << "between bars it does not move";
}

// Of two lines of 8 units, 12 units apart, each may have 12 units: 11.4 with a gap between them.
TEST(Legible, LinesGrowUntilTheyMeet) {
    Picture picture{.labels = {{.at = {10, 100}, .text = "the upper line", .size = 8},
                               {.at = {10, 88}, .text = "the lower line", .size = 8}}};
    keep_legible(picture, OverlayArea({272, 360}));
    for (const Label& label : picture.labels) EXPECT_NEAR(label.size, 11.5, 0.5);
    EXPECT_FALSE(touch(picture.labels[0], picture.labels[1]));
}

TEST(Legible, NoLabelGrowsIntoAnother) {
    for (const Align align : {Align::left, Align::centre, Align::right}) {
        Picture picture;
        for (int row = 0; row < 20; ++row)
            for (int column = 0; column < 8; ++column) {
                const auto shift = static_cast<float>((7 * row + 3 * column) % 5);
                picture.labels.push_back({.at = {60 + 70 * static_cast<float>(column) + 4 * shift,
                                                 30 + 13 * static_cast<float>(row) + shift},
                                          .text = std::string(3 + (row + column) % 5, 'n'),
                                          .size = 7 + static_cast<float>((row + column) % 3),
                                          .align = align});
            }
        const std::vector<Label> before = picture.labels;
        keep_legible(picture, OverlayArea({372, 360}));
        std::size_t grown = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_GE(picture.labels[i].size, before[i].size);
            grown += picture.labels[i].size > before[i].size ? 1 : 0;
            for (std::size_t j = i + 1; j < before.size(); ++j)
                if (!touch(before[i], before[j])) {
                    EXPECT_FALSE(touch(picture.labels[i], picture.labels[j])) << i << ' ' << j;
                }
        }
        EXPECT_GT(grown, before.size() / 2);
    }
}

// A swatch is 4 units before the name of a curve, as in legends. A long line is none.
TEST(Legible, NamesOfCurvesLeaveTheirSwatches) {
    const auto legible = [](float length, Space space) {
        Picture picture{
            .labels = {{.at = {600, 100}, .text = "exact", .size = 8, .align = Align::right}}};
        const float end = 600 - text_width("exact", 8) - 4;
        picture.polylines = {{.points = {{end - length, 103}, {end, 103}}, .space = space}};
        keep_legible(picture, OverlayArea({320, 360}));
        return ends_of(picture.labels[0]).first >= end;
    };
    EXPECT_TRUE(legible(16, Space::canvas));
    EXPECT_FALSE(legible(200, Space::canvas));
    EXPECT_FALSE(legible(16, Space::world)) << "metres";
}

// In the upper left corner of a window of 4:3 there are 60 units above the canvas.
TEST(Legible, LabelsMeetWhereTheyAreDrawn) {
    Picture picture{
        .labels = {{.at = {10, 350}, .text = "canvas", .size = 8},
                   {.at = {10, 346}, .text = "corner", .size = 8, .space = Space::upper_left}}};
    keep_legible(picture, OverlayArea({320, 240}));
    for (const Label& label : picture.labels) EXPECT_EQ(label.size, 16) << label.text;
    // (0, 0) m is the middle of the canvas.
    Picture world{.labels = {{.at = {320, 176}, .text = "canvas", .size = 8},
                             {.at = {0, 0}, .text = "world", .size = 8, .space = Space::world}}};
    keep_legible(world, OverlayArea({320, 240}));
    for (const Label& label : world.labels) EXPECT_EQ(label.size, 8) << label.text;
}

TEST(Legible, BearsLabelsOutOfReach) {
    constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
    Picture picture{.labels = {{.at = {nowhere, 10}, .text = "nowhere", .size = 8},
                               {.at = {10, 10}, .text = "here", .size = 8},
                               {.at = {2000, 10}, .text = "outside", .size = 8}}};
    keep_legible(picture, OverlayArea({320, 240}));
    EXPECT_EQ(picture.labels[1].size, 16);
    EXPECT_EQ(picture.labels[2].size, 8);
}

}  // namespace
}  // namespace oiler::test
