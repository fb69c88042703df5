// SPDX-License-Identifier: MIT
// Draws shapes, and frames at their edges, at their largest size, and after a change of size.

#include <cstdio>
#include <numbers>

#include "oiler/core/utf8.hpp"
#include "oiler/render/mesh.hpp"
#include "oiler/render/renderer.hpp"
#include "render/drawing.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST_F(Drawing, ADiscCoversItsArea) {
    for (const float radius : {0.2F, 0.5F, 0.7F, 1.0F, 2.5F, 10.0F, 61.3F}) {
        const double area = mean_coverage([&](Point shift) {
            return of_disc({300 + shift.x, 170 + shift.y}, radius);
        });
        // The edge is a ring one pixel wide. The finer grid misses up to 1 % of a pixel.
        const double rounding = 2 * pi * (radius + 1.0) * blend_rounding;
        EXPECT_NEAR(area, pi * radius * radius, rounding + 0.01) << "radius " << radius;
    }
}

TEST_F(Drawing, ALineCoversLengthTimesWidth) {
    for (const float width : {0.25F, 0.5F, 1.0F, 1.5F, 3.0F, 8.0F}) {
        for (const double degrees : {0.0, 17.0, 45.0, 71.0, 90.0}) {
            const auto dx = static_cast<float>(100 * std::cos(degrees * pi / 180));
            const auto dy = static_cast<float>(100 * std::sin(degrees * pi / 180));
            const double area = mean_coverage([&](Point shift) {
                const Point from{200 + shift.x, 100 + shift.y};
                return of_line({from, {from.x + dx, from.y + dy}}, width);
            });
            // The ends are two half discs with soft edges: π(R² + 1/12).
            const double half = std::fmax(width, 1) / 2;
            const double ends = std::fmin(width, 1) * pi * (half * half + 1.0 / 12);
            const double rounding = 2 * 102 * blend_rounding;
            EXPECT_NEAR(area, 100.0 * width + ends, rounding) << width << " at " << degrees;
        }
    }
}

TEST_F(Drawing, ALineOfOnePixelIsAsDarkAsItsColour) {
    const Pixels level = draw(of_line({{100, 100.5F}, {200, 100.5F}}, 1));
    const Pixels upright = draw(of_line({{100.5F, 100}, {100.5F, 200}}, 1));
    const Pixels diagonal = draw(of_line({{100, 100}, {200, 200}}, 1));
    for (int i = 101; i < 199; ++i) {
        EXPECT_EQ(red(level, i, 100), 0);
        EXPECT_EQ(red(level, i, 101), 255);
        EXPECT_EQ(red(level, i, 99), 255);
        EXPECT_EQ(red(upright, 100, i), 0);
        EXPECT_EQ(red(upright, 101, i), 255);
        EXPECT_LE(red(diagonal, i, i), 1);
    }
}

TEST_F(Drawing, AnAxisBetweenTwoRowsIsSharp) {
    const Pixels pixels = draw(of_line({{100, 100}, {200, 100}}, 1));
    EXPECT_EQ(red(pixels, 150, 100), 0);
    EXPECT_EQ(red(pixels, 150, 99), 255);
}

TEST_F(Drawing, ADiagonalIsItsOwnMirrorImage) {
    const Pixels pixels = draw(of_line({{50, 50}, {300, 300}}, 3.3F));
    for (int y = 40; y < 310; ++y) {
        for (int x = 40; x < y; ++x) {
            ASSERT_NEAR(red(pixels, x, y), red(pixels, y, x), 1) << x << ' ' << y;
        }
    }
}

std::vector<std::vector<Point>> awkward_lines() {
    std::vector<std::vector<Point>> lines{
        {{100, 100}, {200, 100}, {200, 200}},               // a right angle
        {{100, 100}, {300, 110}, {100, 120}},               // nearly back
        {{100, 100}, {300, 100}, {150, 100}},               // exactly back
        {{100, 100}, {103, 104}, {101, 108}, {300, 200}},   // shorter than wide
        {{100, 100}, {200, 100}, {150, 180}, {100, 100}}};  // closed
    std::vector<Point> zigzag;
    std::vector<Point> stairs{{100, 100}};  // steps smaller than the line is wide
    std::vector<Point> tight;               // turns that a mitre of their width would fold over
    for (int i = 0; i < 40; ++i) {
        const auto s = static_cast<float>(i);
        const Point last = stairs.back();
        stairs.push_back(i % 2 == 0 ? Point{last.x + 3, last.y} : Point{last.x, last.y + 3});
        tight.push_back({120 + s * 2.1F, i % 2 == 0 ? 150.0F : 153.0F});
    }
    lines.push_back(stairs);
    lines.push_back(tight);
    std::vector<Point> spiral;
    for (int i = 0; i < 100; ++i) {
        const auto s = static_cast<float>(i);
        zigzag.push_back({100 + s * 2, i % 2 == 0 ? 150.0F : 220.0F});
        spiral.push_back(
            {200 + s * 0.5F * std::cos(s * 0.2F), 160 + s * 0.5F * std::sin(s * 0.2F)});
    }
    lines.push_back(zigzag);
    lines.push_back(spiral);
    return lines;
}

TEST_F(Drawing, TurnsHaveNeitherGapsNorSpikes) {
    for (const std::vector<Point>& line : awkward_lines()) {
        for (const float width : {2.5F, 10.0F}) {
            const Pixels pixels = draw(of_line(line, width));
            for (int y = 80; y < 250; ++y) {
                for (int x = 80; x < 350; ++x) {
                    const double d = distance_to_line(x + 0.5, y + 0.5, line);
                    // Axis-aligned lines are snapped by up to half a pixel. Omitted points move a
                    // curve by less.
                    if (d < width / 2 - 1.3) {
                        ASSERT_LE(red(pixels, x, y), 1) << x << ' ' << y << " width " << width;
                    }
                    // A mitre at 120° is as long as the line is wide.
                    if (d > width + 1.6) {
                        ASSERT_EQ(red(pixels, x, y), 255) << x << ' ' << y << " width " << width;
                    }
                }
            }
        }
    }
}

TEST_F(Drawing, ARightAngleIsMitredToItsCorner) {
    const Pixels pixels = draw(of_line({{100, 100}, {200, 100}, {200, 200}}, 10));
    EXPECT_EQ(red(pixels, 204, 95), 0);
    EXPECT_EQ(red(pixels, 205, 95), 255);
    EXPECT_EQ(red(pixels, 204, 94), 255);
    const Pixels box =
        draw(of_line({{100, 100}, {200, 100}, {200, 200}, {100, 200}, {100, 100}}, 10));
    EXPECT_EQ(red(box, 95, 95), 0);
    EXPECT_NEAR(total_coverage(box), 110 * 110 - 90 * 90, 1);
}

TEST_F(Drawing, ALineSurvivesPointsThatAreNotFinite) {
    const Pixels all = draw(of_line({{100, 50}, {200, 60}, {nan, 70}, {300, 80}, {400, 99}}, 2));
    Picture parts = of_line({{100, 50}, {200, 60}}, 2);
    parts.polylines.push_back(of_line({{300, 80}, {400, 99}}, 2).polylines[0]);
    EXPECT_EQ(all.rgb, draw(parts).rgb);
    for (const float far : {1e9F, 1e20F, 3e38F}) {
        const Pixels away = draw(of_line({{320, 180.5F}, {far, 180.5F}}, 1));
        EXPECT_EQ(away.rgb, draw(of_line({{320, 180.5F}, {700, 180.5F}}, 1)).rgb) << far;
    }
    const Pixels back = draw(of_line({{1e20F, 3e20F}, {320, 180}}, 1));
    EXPECT_EQ(back.rgb, draw(of_line({{320 + 1000, 180 + 3000}, {320, 180}}, 1)).rgb);
    draw(of_line({{-3e38F, -3e38F}, {3e38F, 3e38F}, {infinity, 0}, {-infinity, nan}}, 3e38F));
    draw(of_line({{1, 1}}, 1));
    draw(of_line({}, 1));
    EXPECT_EQ(total_coverage(draw(of_line({{10, 10}, {99, 99}}, nan))), 0);
}

TEST_F(Drawing, ADiscSurvivesAnyNumber) {
    for (const float bad : {nan, infinity, -infinity, -1.0F}) {
        EXPECT_EQ(total_coverage(draw(of_disc({320, 180}, bad))), 0) << bad;
        EXPECT_EQ(total_coverage(draw(of_disc({bad * 1e9F, 180}, 5))), 0) << bad;
    }
    EXPECT_EQ(total_coverage(draw(of_disc({320, 180}, 1e6F))), 640 * 360);
}

TEST_F(Drawing, LettersHaveTheFontsMeasures) {
    // DejaVu Sans has 2048 units per em. H has height 1493, bearing 201 and advance 1540.
    const Ink one = ink(draw(of_text("H", {100, 100}, 100)));
    EXPECT_EQ(one.bottom, 100);
    EXPECT_NEAR(one.top, 100 + 100 * 1493 / 2048.0, 1);
    EXPECT_NEAR(one.left, 100 + 100 * 201 / 2048.0, 1);
    EXPECT_NEAR(one.right, 100 + 100 * (1540 - 201) / 2048.0, 1);
    const Pixels upright = draw(of_text("L", {100, 100}, 100));
    EXPECT_EQ(red(upright, 140, 104), 0);
    EXPECT_EQ(red(upright, 140, 168), 255);
    const Ink two = ink(draw(of_text("HH", {100, 100}, 100)));
    EXPECT_NEAR(two.right - one.right, 100 * 1540 / 2048.0, 1);
    // Kerning moves the second letter of AV closer than that of AH, by about 1/8 em.
    const Ink kerned = ink(draw(of_text("AV", {100, 100}, 100)));
    EXPECT_LT(kerned.right, 100 + 100 * (1401 + 1401) / 2048.0 - 5);
}

TEST_F(Drawing, TextIsAlignedAndItsBaselineWhole) {
    const Ink left = ink(draw(of_text("HH", {300, 100}, 20)));
    const Ink right = ink(draw(of_text("HH", {300, 100}, 20, Align::right)));
    const Ink centre = ink(draw(of_text("HH", {300, 100}, 20, Align::centre)));
    EXPECT_GE(left.left, 300);
    EXPECT_LE(right.right, 300);
    EXPECT_NEAR(centre.left + centre.right, 600, 2);
    EXPECT_EQ(draw(of_text("x", {300, 100.4F}, 12)).rgb, draw(of_text("x", {300, 100}, 12)).rgb);
}

TEST_F(Drawing, SmallTextIsLegible) {
    for (const float size : {10.0F, 12.0F}) {
        const Ink text = ink(draw(of_text("ζ = 0.05", {100, 100}, size)));
        EXPECT_LT(text.darkest, 64) << size;
        EXPECT_GT(text.right - text.left, 4 * size);
    }
    // In a frame of twice the size the text is twice as large.
    const Ink large = ink(draw(of_text("H", {100, 100}, 50), {1280, 720}));
    EXPECT_EQ(large.bottom, 200);
    EXPECT_NEAR(large.top, 200 + 100 * 1493 / 2048.0, 1);
}

TEST_F(Drawing, TheFontHasTheSignsOfFormulas) {
    const Pixels missing = draw(of_text("\U0010FFFD", {100, 100}, 20));
    for (const char* sign : {"ω", "ζ", "Δ", "²", "·", "−", "√", "₀", "≤"}) {
        const Pixels pixels = draw(of_text(sign, {100, 100}, 20));
        EXPECT_GT(total_coverage(pixels), 1) << sign;
        EXPECT_NE(pixels.rgb, missing.rgb) << sign;
    }
    draw(of_text("\xFF\xC0 broken \xE2\x82", {nan, 100}, 20));
    draw(of_text(std::string(5000, 'W'), {-4000, 100}, 4000));
}

TEST_F(Drawing, LaterKindsCoverEarlierOnesAndAlphaMixes) {
    Picture picture = of_line({{100, 100}, {200, 100}}, 20);
    picture.discs.push_back({{}, {150, 100}, 8, {200, 0, 0, 255}, Space::canvas});
    picture.discs.push_back({{}, {300, 100}, 8, {0, 0, 0, 128}, Space::canvas});
    const Pixels pixels = draw(picture);
    EXPECT_EQ(red(pixels, 150, 100), 200);
    EXPECT_EQ(red(pixels, 170, 100), 0);
    EXPECT_NEAR(red(pixels, 300, 100), 127, 1);
}

TEST_F(Drawing, TheCameraLooksAtTheMiddleOfAnyFrame) {
    Picture picture;
    picture.camera = {{10, 20}, 36};  // ten canvas units per metre
    picture.discs.push_back({{}, {10, 20}, 0.5F, {}, Space::world});
    picture.discs.push_back({{}, {-30, 20}, 0.5F, {}, Space::world});  // left of the canvas
    for (const Size size : {Size{640, 360}, Size{1000, 360}, Size{640, 500}}) {
        const Pixels pixels = draw(picture, size);
        EXPECT_EQ(coverage(pixels, size.width / 2, size.height / 2), 1);
        const int left = size.width / 2 - 400;
        EXPECT_EQ(left >= 0 && coverage(pixels, std::max(left, 0), size.height / 2) == 1,
                  size.width == 1000);
    }
}

/// A disc of 10 units whose centre is 20 units from the corner, or from the edge, of the canvas.
Picture of_disc_at(Space space, Point side) {
    Picture picture = of_disc({320 + side.x * 300, 180 + side.y * 160}, 10);
    picture.discs[0].space = space;
    return picture;
}

// One unit is a pixel in each of these frames: a disc is 10 to 30 pixels from the edge it holds to,
// and beside the middle otherwise.
TEST_F(Drawing, CornersAndEdgesOfAFrameKeepWhatHoldsToThem) {
    const std::pair<Space, Point> spaces[] = {
        {Space::upper_left, {-1, 1}},  {Space::top, {0, 1}},     {Space::upper_right, {1, 1}},
        {Space::lower_left, {-1, -1}}, {Space::bottom, {0, -1}}, {Space::lower_right, {1, -1}}};
    const auto low = [](float side, int length) {
        return side < 0 ? 10 : side > 0 ? length - 30 : length / 2 - 10;
    };
    for (const Size size : {Size{640, 360}, Size{1000, 360}, Size{640, 500}})
        for (const auto& [space, side] : spaces) {
            const Ink box = ink(draw(of_disc_at(space, side), size));
            EXPECT_EQ(box.left, low(side.x, size.width)) << int(space) << " in " << size.width;
            EXPECT_EQ(box.right, low(side.x, size.width) + 20);
            EXPECT_EQ(box.bottom, low(side.y, size.height)) << int(space) << " in " << size.height;
            EXPECT_EQ(box.top, low(side.y, size.height) + 20);
        }
}

TEST_F(Drawing, ACornerIsThatOfTheCanvasBetweenBars) {
    for (const Size size : {Size{640, 360}, Size{1000, 360}, Size{640, 500}}) {
        Picture held = of_disc_at(Space::upper_right, {1, 1});
        Picture still = of_disc_at(Space::canvas, {1, 1});
        held.has_bars = still.has_bars = true;
        EXPECT_EQ(draw(held, size).rgb, draw(still, size).rgb);
    }
}

// A game that changes `Space::canvas` to a corner keeps its golden frames of 16:9.
TEST_F(Drawing, ACornerIsThatOfTheCanvasIn16To9) {
    for (const Size size : {Size{320, 180}, Size{640, 360}, Size{1280, 720}}) {
        Picture still = of_text("Score 7", {12.3F, 331.7F}, 11.1F);
        Picture held = still;
        held.labels[0].space = Space::upper_left;
        EXPECT_EQ(draw(held, size).rgb, draw(still, size).rgb);
    }
}

TEST_F(Drawing, TheSamePictureGivesTheSameBytes) {
    const Picture picture = rich_picture();
    const Pixels first = draw(picture);
    EXPECT_GT(total_coverage(first), 1000);
    for (const Size size : {Size{641, 359}, Size{1, 1}, Size{4096, 16}, Size{16, 2048}}) {
        const Pixels other = draw(picture, size);
        EXPECT_EQ(other.size, size);
        EXPECT_EQ(other.rgb.size(), std::size_t{3} * size.width * size.height);
        EXPECT_EQ(other.rgb, draw(picture, size).rgb);
    }
    EXPECT_EQ(draw(picture).rgb, first.rgb);
}

TEST_F(Drawing, RefusesImpossibleFrameSizes) {
    for (const Size size : {Size{0, 360}, Size{640, -1}, Size{1 << 20, 4}, Size{4, 1 << 20}}) {
        EXPECT_NE(line_of_error(Exit::usage, [&] { draw(Picture{}, size); }).find("from 1x1 to"),
                  std::string::npos);
    }
}

TEST(Providers, ShowTheSamePixels) {
    std::vector<Pixels> seen;
    for (const Offscreen which : {Offscreen::osmesa, Offscreen::egl}) {
        const auto studio = open_studio(which);
        if (!studio) GTEST_SKIP() << "only one of OSMesa and EGL is installed";
        seen.push_back(studio->draw(rich_picture(), {1280, 720}));
    }
    EXPECT_EQ(seen[0].rgb, seen[1].rgb);
}

TEST(PolylineMesh, OmitsInvisibleParts) {
    std::vector<Point> dense;
    for (int i = 0; i <= 100000; ++i) {
        dense.push_back({static_cast<float>(i) / 1000, 50});
    }
    LineMesh mesh;
    append_polyline(dense, {1, {}}, {640, 360}, mesh);
    // 100 pixels at 0.75 pixels per point, two vertices each, and the ends.
    EXPECT_LE(mesh.vertices.size(), 2U * 134 + 4);
    EXPECT_EQ(mesh.vertices.back().position.y, 49 - 0.5F);
    mesh.clear();
    append_polyline(std::vector<Point>{{-500, 1000}, {900, 1000}}, {1, {}}, {640, 360}, mesh);
    EXPECT_TRUE(mesh.indices.empty());
}

TEST(PolylineMesh, NeverFoldsOver) {
    for (const std::vector<Point>& line : awkward_lines()) {
        LineMesh mesh;
        append_polyline(line, {10, {}}, {640, 360}, mesh);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const Point a = mesh.vertices[mesh.indices[i]].position;
            const Point b = mesh.vertices[mesh.indices[i + 1]].position;
            const Point c = mesh.vertices[mesh.indices[i + 2]].position;
            const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            EXPECT_GE(area, -0.01F) << "triangle " << i / 3;
        }
    }
}

TEST(Utf8, DecodesAndMarksInvalidBytes) {
    EXPECT_EQ(decode_utf8("aω√\U0001F600"), U"aω√\U0001F600");
    EXPECT_EQ(decode_utf8("\xFF"), U"\uFFFD");
    EXPECT_EQ(decode_utf8("\xC0\x80"), U"\uFFFD\uFFFD");              // overlong
    EXPECT_EQ(decode_utf8("\xED\xA0\x80x"), U"\uFFFD\uFFFD\uFFFDx");  // a surrogate
    EXPECT_EQ(decode_utf8("\xE2\x82"), U"\uFFFD\uFFFD");              // cut short
}

class Frame : public testing::Test {
protected:
    void SetUp() override {
        if (!studio_) GTEST_SKIP() << "neither OSMesa nor EGL is installed";
    }
    Pixels draw(const Picture& picture, Size size = {640, 360}) {
        return studio_->draw(picture, size);
    }

    std::unique_ptr<Studio> studio_ = open_studio(Offscreen::automatic);
};

/// Area of the part of a disc beyond a line at a distance from its centre.
double segment(double radius, double distance) {
    return radius * radius * std::acos(distance / radius) -
           distance * std::sqrt(radius * radius - distance * distance);
}

// The rim within the frame is 42 pixels long. Each of its pixels samples a ramp at its centre and
// is rounded to 1/255.
TEST_F(Frame, ShowsTheRimOfADiscWhoseCentreIsOutside) {
    const double area = segment(20, 10);
    for (const Point centre : {Point{-10, 180}, {650, 180}, {320, -10}, {320, 370}})
        EXPECT_NEAR(total_coverage(draw(of_disc(centre, 20))), area, 1)
            << centre.x << ", " << centre.y;
    EXPECT_EQ(red(draw(of_disc({-10, 180.5F}, 20)), 8, 180), 0);
}

// A corner is 10·√2 = 14.1 pixels from the centre: the rim reaches 5.9 pixels into the frame.
TEST_F(Frame, ShowsTheRimOfADiscBeyondACorner) {
    for (const Point centre : {Point{-10, -10}, {650, -10}, {-10, 370}, {650, 370}})
        EXPECT_GT(total_coverage(draw(of_disc(centre, 20))), 20) << centre.x << ", " << centre.y;
}

TEST_F(Frame, DoesNotShowADiscOutside) {
    for (const Point centre : {Point{-21, 180}, {661, 180}, {320, -21}, {320, 381}})
        EXPECT_EQ(total_coverage(draw(of_disc(centre, 20))), 0) << centre.x << ", " << centre.y;
}

/// A disc that covers a frame of any size.
const Picture black = of_disc({320, 180}, 1e5F);

TEST_F(Frame, HasItsSizeAfterAChangeOfOneSide) {
    for (const Size size :
         {Size{320, 180}, {320, 200}, {320, 90}, {300, 90}, {400, 90}, {400, 91}}) {
        const Pixels pixels = draw(black, size);
        EXPECT_EQ(pixels.size, size);
        ASSERT_EQ(pixels.rgb.size(), std::size_t{3} * size.width * size.height);
        EXPECT_EQ(total_coverage(pixels), size.width * size.height)
            << size.width << 'x' << size.height;
    }
}

/// The largest size, from the message for a larger one: "… choose a --size from 1x1 to WxH".
Size largest_frame(Studio& studio) {
    try {
        (void)studio.draw({}, {1 << 20, 1});
    } catch (const Error& error) {
        const std::string line = error.what();
        Size size;
        const std::string size_named = line.substr(line.rfind(' ') + 1);
        if (std::sscanf(size_named.c_str(), "%dx%d", &size.width, &size.height) == 2) return size;
    }
    ADD_FAILURE() << "the message names no largest size";
    return {1, 1};
}

TEST_F(Frame, HasTheLargestSizeThatTheMessageNames) {
    const Size largest = largest_frame(*studio_);
    EXPECT_EQ(draw({}, {largest.width, 1}).size.width, largest.width);
    EXPECT_EQ(draw({}, {1, largest.height}).size.height, largest.height);
    EXPECT_THROW((void)draw({}, {largest.width + 1, 1}), Error);
    EXPECT_THROW((void)draw({}, {1, largest.height + 1}), Error);
}

TEST_F(Frame, IsDrawnAnewInTheSameSize) {
    EXPECT_EQ(total_coverage(draw(black)), 640 * 360);
    EXPECT_EQ(total_coverage(draw(Picture{})), 0);
}

}  // namespace
}  // namespace oiler::test
