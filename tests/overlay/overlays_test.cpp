// SPDX-License-Identifier: MIT
// Where the loop writes over a window, and in which size.
#include "oiler/overlay/overlays.hpp"

#include <algorithm>

#include "oiler/overlay/game_inspector.hpp"
#include "oiler/overlay/help.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/render/renderer.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr float rounding = 1e-3F;

void expect_corners(const OverlayArea& area, Point low, Point high) {
    EXPECT_NEAR(area.low.x, low.x, rounding);
    EXPECT_NEAR(area.low.y, low.y, rounding);
    EXPECT_NEAR(area.high.x, high.x, rounding);
    EXPECT_NEAR(area.high.y, high.y, rounding);
}

// The canvas is 640 by 360 units. A window of 4:3 has 640 by 480, one of 20:9 has 800 by 360.
TEST(OverlayArea, ReachesBeyondTheCanvas) {
    const OverlayArea usual({1280, 720});
    EXPECT_NEAR(usual.pixels, 2, rounding);
    expect_corners(usual, {0, 0}, {640, 360});
    const OverlayArea small({400, 300});
    EXPECT_NEAR(small.pixels, 0.625, rounding);
    expect_corners(small, {0, -60}, {640, 420});
    expect_corners(OverlayArea({1600, 720}), {-80, 0}, {720, 360});
}

TEST(OverlayArea, HasLettersOf11PixelsAtLeast) {
    EXPECT_EQ(OverlayArea({1280, 720}).legible(7), 7) << "14 pixels";
    EXPECT_NEAR(OverlayArea({400, 300}).legible(7) * 0.625F, 11, rounding);
    EXPECT_GT(OverlayArea({0, 0}).legible(7), 0) << "a minimised window";
}

Verdict of_letters(std::size_t letters) {
    std::string text;
    while (text.size() < letters) text += "word ";
    text.resize(letters, 'x');
    return {.grade = Verdict::Grade::good, .text = text};
}

float width_of(const Label& label) {
    return 0.55F * label.size * static_cast<float>(label.text.size());
}

/// All letters of a verdict are in its band, and none is under the hint at the right.
void expect_in_band(Size size, std::size_t letters) {
    SCOPED_TRACE(std::to_string(size.width) + " pixels, letters: " + std::to_string(letters));
    const OverlayArea area(size);
    Picture overlay;
    add_verdict(overlay, area, of_letters(letters));
    const float low = area.high.y - static_cast<float>(verdict_height(area)) / area.pixels;
    const Label& hint = *std::ranges::find(overlay.labels, Align::right, &Label::align);
    for (const Point corner : overlay.polygons.back().points)
        EXPECT_GE(corner.x, area.low.x + 1) << "the mark is cut";
    for (const Label& label : overlay.labels) {
        EXPECT_GE(label.at.y, low - 0.5F / area.pixels) << label.text;
        EXPECT_LE(label.at.y + 0.8F * label.size, area.high.y) << label.text;
        if (label.align == Align::right) continue;
        const bool is_beside = label.at.y < hint.at.y + 0.8F * hint.size;
        EXPECT_LE(label.at.x + width_of(label), is_beside ? hint.at.x - width_of(hint) : hint.at.x)
            << label.text;
    }
}

TEST(Verdict, StaysInItsBand) {
    for (const Size size : {Size{1280, 720}, {640, 360}, {400, 300}, {1600, 400}})
        for (const std::size_t letters : {0U, 60U, 130U, 300U}) expect_in_band(size, letters);
}

// 150 letters of 11 pixels and 0.55 of that are 908 pixels: three lines of 384.
TEST(Verdict, HasMoreLinesInASmallWindow) {
    EXPECT_EQ(verdict_height(OverlayArea({400, 300})), 47) << "3 * 1.43 * 11 pixels";
    EXPECT_EQ(verdict_height(OverlayArea({1280, 720})), 20) << "a line of 1.43 * 14 pixels";
    Picture overlay;
    add_verdict(overlay, OverlayArea({400, 300}), of_letters(130));
    for (const Label& label : overlay.labels)
        EXPECT_NEAR(label.size * 0.625F, 11, rounding) << label.text;
}

TEST(Verdict, HasTheStateInItsSizeBesideIt) {
    for (const Size size : {Size{1280, 720}, {400, 300}}) {
        Picture overlay;
        add_verdict(overlay, OverlayArea(size), of_letters(60), "paused: F3 resumes");
        const Label& state = *std::ranges::find(overlay.labels, Align::right, &Label::align);
        EXPECT_EQ(state.text, "paused: F3 resumes");
        for (const Label& label : overlay.labels) EXPECT_EQ(label.size, state.size);
        Picture alone;
        add_status(alone, OverlayArea(size), "paused: F3 resumes");
        EXPECT_EQ(alone.labels.at(0).size, state.size);
    }
}

// Every label of the loop can be read on its ground: a dark one over a dark game.
TEST(Overlays, HaveTheContrastOfTheirGame) {
    for (const Colour background : {palette::paper, palette::black, Colour{120, 60, 20}}) {
        Picture overlay{.background = background};
        const OverlayArea area({1280, 720});
        add_verdict(overlay, area, of_letters(60));
        add_status(overlay, area, "paused");
        add_notice(overlay, area, "it diverged", "F9 restarts");
        add_help(overlay, area, "Title", {}, [](Button button) { return name_of(button); },
                 {{"F1", "inspector"}});
        const Colour paper = theme_of(background).paper;
        EXPECT_EQ(overlay.polygons.front().colour, paper);
        for (const Label& label : overlay.labels)
            EXPECT_GE(contrast(label.colour, paper), 4.5) << label.text;
    }
}

TEST(Notice, FitsASmallWindow) {
    Picture overlay;
    add_notice(overlay, OverlayArea({400, 300}), of_letters(200).text, "F9 restarts, Escape quits");
    ASSERT_GT(overlay.labels.size(), 2U);
    for (const Label& label : overlay.labels) {
        EXPECT_LE(width_of(label), 640) << label.text;
        EXPECT_GE(label.size * 0.625F, 10.99F);
    }
}

TEST(Status, FitsASmallWindow) {
    Picture overlay;
    add_status(overlay, OverlayArea({400, 300}), std::string(100, 'x'));
    EXPECT_LE(width_of(overlay.labels.at(0)), 640);
    EXPECT_GE(overlay.labels.at(0).at.y, -60);
    EXPECT_LT(overlay.labels.at(0).at.y, 0) << "at the bottom of the window, not of the canvas";
}

TEST(Labels, OfAGameHave9PixelsAtLeast) {
    Picture picture;
    picture.labels = {{.size = 8}, {.size = 20}, {.size = 0.5F, .size_in = Space::world}};
    Picture large = picture;
    keep_legible(picture, OverlayArea({400, 300}));
    EXPECT_NEAR(picture.labels[0].size * 0.625F, 9, rounding);
    EXPECT_EQ(picture.labels[1].size, 20);
    EXPECT_EQ(picture.labels[2].size, 0.5F) << "metres";
    keep_legible(large, OverlayArea({1280, 720}));
    EXPECT_EQ(large.labels[0].size, 8);
    // 40 letters of 0.55 * 8 units from 440 on have 200 units to the edge, and need 176.
    Picture wide{
        .labels = {
            {.at = {440, 0}, .text = std::string(40, 'x'), .size = 8},
            {.at = {200, 0}, .text = std::string(40, 'x'), .size = 8, .align = Align::right}}};
    keep_legible(wide, OverlayArea({400, 300}));
    for (const Label& label : wide.labels) {
        EXPECT_GT(label.size, 8);
        EXPECT_LE(width_of(label), 200) << "the edge cuts it";
    }
    keep_legible(large, OverlayArea({64, 36}));
    EXPECT_EQ(large.labels[0].size, 16) << "twice as large, or labels cover each other";
}

// A window of 800 by 225 pixels is 1280 by 360 units: 320 beside the canvas on each side. From 440
// on, a label has 200 units of the canvas and those at the right: 320, or 640 in the left corner.
TEST(Labels, HaveTheRoomOfTheirCorner) {
    const auto legible = [](Space space, bool has_bars) {
        Picture picture{
            .labels = {{.at = {440, 0}, .text = std::string(119, 'x'), .size = 8, .space = space}},
            .has_bars = has_bars};
        keep_legible(picture, OverlayArea({800, 225}));
        return picture.labels[0].size;
    };
    const float needed = 9 / 0.625F;  // 120 letters of 0.55 * 14.4 units are 950 units
    EXPECT_EQ(legible(Space::canvas, false), 8);
    EXPECT_EQ(legible(Space::upper_right, false), 8);
    EXPECT_NEAR(legible(Space::upper_left, false), 840 / 0.55F / 120, rounding);
    EXPECT_LT(legible(Space::upper_left, false), needed);
    EXPECT_EQ(legible(Space::upper_left, true), 8) << "between bars it does not move";
}

/// A game without bodies.
struct Empty {
    static constexpr About about{.name = "empty", .title = "Empty"};
    World world;
    explicit Empty(const Settings& settings) : world(1, settings) {}
};

// A frame counts as 1/32 of the mean. The time of steps and picture is 224 ms, of which 96 ms are
// of update and step.
TEST(GameInspector, ShowsThePartsOfAFrame) {
    using namespace std::chrono_literals;
    constexpr Size size{1280, 720};
    AnyGameOf<Empty> game{Settings{}};
    GameInspector inspector(game, "", Renderer::font());
    inspector.add_times({.update = 32'000'000, .step = 64'000'000}, 224ms, 256ms);
    (void)inspector.show(nullptr, {}, size, size, {});
    Inspector expected(Renderer::font());
    const Inspected run{.stepping = game.world().settings().stepping,
                        .costs = {.update = 1e6, .step = 2e6, .picture = 4e6, .draw = 8e6}};
    (void)expected.show(run, {}, size, 0);
    EXPECT_TRUE(std::ranges::equal(inspector.overlay().vertices, expected.overlay().vertices, {},
                                   &Overlay::Vertex::texel, &Overlay::Vertex::texel))
        << "its letters";
}

}  // namespace
}  // namespace oiler::test
