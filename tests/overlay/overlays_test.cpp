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
        add_notice(overlay, area, {"rk4 at 60 Hz", "it diverged", "F9 restarts"});
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
    add_notice(overlay, OverlayArea({400, 300}),
               {"semi_implicit_euler at 60 Hz, double", of_letters(200).text, "F9 restarts"});
    ASSERT_GT(overlay.labels.size(), 2U);
    for (const Label& label : overlay.labels) {
        EXPECT_LE(width_of(label), 640) << label.text;
        EXPECT_GE(label.size * 0.625F, 10.99F);
    }
}

// 1280 x 720: a unit is two pixels.
TEST(Notice, NamesTheSettingInTheLargestLetters) {
    Picture overlay;
    add_notice(overlay, OverlayArea({1280, 720}), {"rk4 at 60 Hz", "it diverged", "F9 restarts"});
    ASSERT_EQ(overlay.labels.size(), 3U);
    EXPECT_EQ(overlay.labels[0].text, "rk4 at 60 Hz");
    EXPECT_GE(2 * overlay.labels[0].size, 22);
    for (const Label& label : overlay.labels) EXPECT_GE(2 * label.size, 18) << label.text;
    for (std::size_t i = 1; i < 3; ++i)
        EXPECT_LE(overlay.labels[i].at.y + overlay.labels[i].size,
                  overlay.labels[i - 1].at.y + 0.1F);
    add_notice(overlay, OverlayArea({1280, 720}), {"", "no such file", "F9 closes this"});
    EXPECT_EQ(overlay.labels.size(), 5U);
}

TEST(Status, FitsASmallWindow) {
    Picture overlay;
    add_status(overlay, OverlayArea({400, 300}), std::string(100, 'x'));
    EXPECT_LE(width_of(overlay.labels.at(0)), 640);
    EXPECT_GE(overlay.labels.at(0).at.y, -60);
    EXPECT_LT(overlay.labels.at(0).at.y, 0) << "at the bottom of the window, not of the canvas";
}

/// A game without bodies.
struct Empty {
    static constexpr About about{.name = "empty", .title = "Empty"};
    World world;
    explicit Empty(const Settings& settings) : world(1, settings) {}
};

// A frame counts as 1/32 of the mean, and a game without bodies says so. The time of steps and
// picture is 224 ms, of which 96 ms are of update and step.
TEST(GameInspector, ShowsThePartsOfAFrame) {
    using namespace std::chrono_literals;
    constexpr Size size{1280, 720};
    AnyGameOf<Empty> game{Settings{}};
    GameInspector inspector(game, {}, Renderer::font());
    inspector.add_times({.update = 32'000'000, .step = 64'000'000}, 224ms, 256ms);
    (void)inspector.show(nullptr, {}, size, size, {});
    Inspector expected(Renderer::font());
    const Inspected run{.stepping = game.world().settings().stepping,
                        .verdict =
                            "The world of this game has no bodies whose error could be "
                            "measured.",
                        .costs = {.update = 1e6, .step = 2e6, .picture = 4e6, .draw = 8e6}};
    (void)expected.show(run, {}, size, 0);
    EXPECT_TRUE(std::ranges::equal(inspector.overlay().vertices, expected.overlay().vertices, {},
                                   &Overlay::Vertex::texel, &Overlay::Vertex::texel))
        << "its letters";
}

}  // namespace
}  // namespace oiler::test
