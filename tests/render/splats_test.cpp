// SPDX-License-Identifier: MIT
#include "oiler/render/splats.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "oiler/core/random.hpp"
#include "render/drawing.hpp"

namespace oiler::test {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t many = 14'000;  // enough of them are splatted
constexpr Size frame{640, 360};       // a pixel is a unit of the canvas

/// Coverage of a pixel by a disc of at least half a pixel: 1 inside, 0 outside, falling over one
/// pixel around the radius at which the ramp holds π·r².
double ramp(double dx, double dy, double radius) {
    const double edge = std::sqrt(radius * radius - 1.0 / 12);
    return std::clamp(edge + 0.5 - std::hypot(dx, dy), 0.0, 1.0);
}

Picture of_discs(std::vector<Disc> discs) {
    Picture picture;
    picture.discs = std::move(discs);
    return picture;
}

Disc disc(Point at, float radius, Colour colour = {}) {
    return {{}, at, radius, colour, Space::canvas};
}

/// Adds discs outside of the picture's corner that fill up a run without being seen.
void fill_up(std::vector<Disc>& discs) {
    for (std::size_t i = 0; i < many; ++i) discs.push_back(disc({0.5F, 0.5F}, 0.6F));
}

TEST_F(Drawing, ASplatHasTheCoverageOfADiscAtAnyPositionAndRadius) {
    Random random(7);
    std::vector<Disc> discs;
    fill_up(discs);
    const std::size_t first = discs.size();
    for (float x = 20; x < 630; x += 14)
        for (float y = 20; y < 350; y += 14) {
            const bool whole = discs.size() % 4 == 0;  // on a pixel's corner
            const auto shift = [&] { return whole ? 0 : static_cast<float>(random.fraction()); };
            const float radius = 0.6F + 3.4F * static_cast<float>(random.fraction());
            discs.push_back(disc({x + shift(), y + shift()}, radius));
        }
    const Pixels splatted = draw(of_discs(discs));
    const Pixels quads =
        draw(of_discs({discs.begin() + static_cast<std::ptrdiff_t>(first), discs.end()}));
    double area = 0;
    double expected_area = 0;
    for (std::size_t i = first; i < discs.size(); ++i) {
        const Disc& one = discs[i];
        expected_area += pi * double{one.radius} * one.radius;
        for (int y = int(one.centre.y) - 6; y <= int(one.centre.y) + 6; ++y)
            for (int x = int(one.centre.x) - 6; x <= int(one.centre.x) + 6; ++x) {
                const double expected =
                    255 - 255 * ramp(x + 0.5 - one.centre.x, y + 0.5 - one.centre.y, one.radius);
                ASSERT_NEAR(red(splatted, x, y), expected, 1) << one.centre.x << ' ' << one.radius;
                ASSERT_NEAR(red(splatted, x, y), red(quads, x, y), 2) << one.centre.x;
                area += (255 - red(splatted, x, y)) / 255.0;
            }
    }
    // A thousand discs at random: rounding (0.3 of a level for each of 30 pixels) is 0.01 px², and
    // the ramp misses up to 0.1 px² at one position, 0.01 px² in the mean.
    const auto count = static_cast<double>(discs.size() - first);
    EXPECT_NEAR(area / count, expected_area / count, 0.02);
}

TEST_F(Drawing, ASplatBelowAPixelFades) {
    for (const float radius : {0.05F, 0.2F, 0.4F}) {
        std::vector<Disc> discs;
        fill_up(discs);
        for (int i = 0; i < 100; ++i)
            discs.push_back(disc({100.3F + 4 * static_cast<float>(i), 200.7F}, radius));
        const Pixels pixels = draw(of_discs(discs));
        double area = 0;
        for (int y = 190; y < 210; ++y)
            for (int x = 90; x < 520; ++x) area += (255 - red(pixels, x, y)) / 255.0;
        // Nine pixels round by up to half a level; the ramp of one position misses up to 6 %.
        EXPECT_NEAR(area / 100, pi * radius * radius, 9 * 0.5 / 255 + 0.06 * pi * radius * radius);
    }
}

TEST_F(Drawing, SplatsQuadsAndLaterKindsKeepTheirOrder) {
    const Colour blue{0, 0, 255, 255};
    const Colour red_half{255, 0, 0, 128};
    std::vector<Disc> discs;
    fill_up(discs);
    discs.push_back(disc({100, 100}, 3, red_half));
    discs.push_back(disc({200, 100}, 3, red_half));
    discs.push_back(disc({200, 100}, 20, blue));  // too large for a splat
    discs.push_back(disc({300, 100}, 20, blue));
    fill_up(discs);
    discs.push_back(disc({300, 100}, 3, red_half));
    discs.push_back(disc({400, 100}, 3, blue));
    discs.push_back(disc({400, 100}, 3, red_half));
    ASSERT_EQ(discs.size(), 2 * many + 7);
    Picture picture = of_discs(discs);
    picture.polylines.push_back({{}, {{90, 100}, {110, 100}}, 4, {0, 255, 0, 255}, Space::canvas});
    const Pixels pixels = draw(picture);
    const auto expect = [&](int x, double r, double g, double b) {
        const std::size_t at = (std::size_t{100} * 640 + static_cast<std::size_t>(x)) * 3;
        EXPECT_NEAR(pixels.rgb[at], r, 1) << x;
        EXPECT_NEAR(pixels.rgb[at + 1], g, 1) << x;
        EXPECT_NEAR(pixels.rgb[at + 2], b, 1) << x;
    };
    expect(100, 128, 127, 0);    // half red over the green line
    expect(200, 0, 0, 255);      // under the large disc
    expect(300, 128, 0, 127);    // over it
    expect(400, 128, 0, 127);    // over a splat
    expect(500, 255, 255, 255);  // untouched
}

TEST_F(Drawing, AHeapOfSplatsCoversAsItsDiscsDo) {
    std::vector<Disc> discs;
    double left = 1;  // of the background
    for (std::size_t i = 0; i < many; ++i) {
        discs.push_back(disc({320.5F, 180.5F}, 1, {0, 0, 0, 1}));
        if (i < 300) left *= 1 - 1.0 / 255;
    }
    for (std::size_t i = 300; i < many; ++i) discs[i].centre = {100, 100};
    // Each of 300 blends rounds by half of 1/65536.
    EXPECT_NEAR(red(draw(of_discs(discs)), 320, 180), 255 * left, 1 + 300 * 0.5 / 256);
}

TEST_F(Drawing, SplatsThatBeginInDifferentRowsKeepTheirOrder) {
    constexpr std::size_t places = 100;
    static_assert(many % (2 * places) == 0);
    std::vector<Disc> discs;
    for (std::size_t i = 0; i < many; ++i) {
        const std::size_t round = i / places;
        const Colour colour = round % 2 == 0 ? Colour{255, 0, 0, 255} : Colour{0, 0, 255, 255};
        const auto x = 20.5F + 6 * static_cast<float>(i % places);
        discs.push_back(disc({x, 100.5F + static_cast<float>(round % 2)}, 3, colour));
    }
    const Pixels pixels = draw(of_discs(discs));
    for (int i = 0; i < static_cast<int>(places); ++i)
        for (int y = 99; y <= 103; ++y) ASSERT_EQ(red(pixels, 20 + 6 * i, y), 0) << i << ' ' << y;
}

TEST(DiscRuns, HoldEachDiscOnceInOrder) {
    std::vector<PlacedDisc> discs(3 * many, PlacedDisc{{}, 1, 1, {}});
    for (std::size_t i = 0; i < discs.size(); ++i) discs[i].centre.x = static_cast<float>(i);
    discs[0].radius = 40;                                              // alone
    for (std::size_t i = 2; i < many; i += 2) discs[i].radius = 4.5F;  // too short a run
    discs[2 * many].radius = 5;
    const std::vector<DiscRun> runs = runs_of(discs, frame, false);
    std::vector<std::size_t> splatted;
    std::size_t next = 0;
    for (const DiscRun& run : runs) {
        ASSERT_FALSE(run.discs.empty());
        EXPECT_EQ(run.discs.data(), discs.data() + next);
        next += run.discs.size();
        if (run.is_splatted) splatted.push_back(run.discs.size());
    }
    EXPECT_EQ(next, discs.size());
    EXPECT_EQ(splatted, (std::vector<std::size_t>{many + 1, many - 1}));
    EXPECT_TRUE(runs_of({}, frame, false).empty());
    EXPECT_TRUE(runs_of(std::span(discs).subspan(2 * many + 1, 500), frame, true)[0].is_splatted);
    EXPECT_FALSE(runs_of(std::span(discs).subspan(2 * many + 1, 499), frame, true)[0].is_splatted);
    // A large frame needs more discs for an image to pay.
    EXPECT_EQ(runs_of(std::span(discs).subspan(2 * many + 1), {3840, 2160}, false).size(), 1U);
    EXPECT_FALSE(
        runs_of(std::span(discs).subspan(2 * many + 1), {3840, 2160}, false)[0].is_splatted);
}

TEST(Splats, AreCutByTheEdgesOfTheFrame) {
    Splats splats;
    const std::vector<PlacedDisc> discs{
        {{-3, 4.5F}, 3.4F, 1, {}}, {{8, 30}, 4, 1, {}}, {{16.5F, -4.4F}, 4, 1, {}}};
    splats.draw(discs, {16, 8});
    ASSERT_EQ(splats.texels().size(), 16U * 8);
    // 3.4 + 0.5 − |−3 − 0.5| = 0.4 of 65535
    const auto alpha = [&](std::size_t x, std::size_t y) {
        return splats.texels()[16 * y + x] >> 48;
    };
    EXPECT_NEAR(static_cast<double>(alpha(0, 4)), 26214, 1);
    EXPECT_EQ(alpha(1, 4), 0U);
    EXPECT_EQ(alpha(8, 7), 0U);
}

}  // namespace
}  // namespace oiler::test
