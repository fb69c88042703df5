// SPDX-License-Identifier: MIT
// The rings that show where bodies truly are.
#include "oiler/overlay/ghosts.hpp"

#include "oiler/game/look.hpp"
#include "oiler/world/world.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

const Entity one{1, 1};
const Entity two{2, 1};
const Entity three{3, 1};

Moment moment(std::vector<Moment::Placed> bodies) { return {.bodies = std::move(bodies)}; }

TEST(Ghosts, AreTheBodiesThatBothHave) {
    const Moment run = moment({{one, 0, {1}}, {two, 1, {9}}, {three, 0, {3}}});
    const std::vector<Ghost> ghosts =
        ghosts_of(run, moment({{one, 0, {1.5}}, {two, 0, {2}}, {{4, 1}, 0, {4}}}));
    ASSERT_EQ(ghosts.size(), 1U);
    EXPECT_EQ(ghosts[0].body, one);
    EXPECT_EQ(ghosts[0].at[0], 1);
    EXPECT_EQ(ghosts[0].truth[0], 1.5);
    EXPECT_EQ(ghosts_of(run, moment({{one, 0, {1.5}}, {two, 1, {8}}})).size(), 2U)
        << "thrown in both";
    EXPECT_TRUE(ghosts_of(run, moment({{{1, 2}, 0, {1.5}}})).empty())
        << "another body in its place";
}

TEST(Ghosts, OfManyBodiesAreThoseFurthestOff) {
    Moment run;
    Moment reference;
    for (std::uint32_t i = 0; i < 150; ++i) {
        run.bodies.push_back({{i, 1}, 0, {}});
        reference.bodies.push_back({{i, 1}, 0, {i % 2 == 0 ? 0.5 * i : -0.5 * i}});
    }
    const std::vector<Ghost> ghosts = ghosts_of(run, reference);
    EXPECT_EQ(ghosts.size(), 100U);
    for (const Ghost& ghost : ghosts) EXPECT_GE(std::abs(ghost.truth[0]), 25) << "the 50 nearest";
}

// At 3.6 m of height, a metre is 100 units of the canvas, and 3 units are seen.
TEST(Ghosts, HaveARingAndADistanceThatCanBeSeen) {
    const auto drawn = [](double off, double factor) {
        Picture picture{.camera = {.height = 3.6F}};
        add_ghosts(picture, {{{1, 1}, {0.5, 0}, {0.5, off}}}, factor);
        return picture;
    };
    const auto centre = [](const Polyline& ring) {
        const auto [low, high] = std::ranges::minmax(ring.points, {}, &Point::y);
        return Point{(std::ranges::min(ring.points, {}, &Point::x).x +
                      std::ranges::max(ring.points, {}, &Point::x).x) /
                         2,
                     (low.y + high.y) / 2};
    };
    const Picture small = drawn(0.02, 1);
    ASSERT_EQ(small.polylines.size(), 1U);
    EXPECT_TRUE(small.labels.empty());
    const Picture seen = drawn(0.1, 1);
    ASSERT_EQ(seen.polylines.size(), 2U);
    EXPECT_NEAR(centre(seen.polylines[0]).x, 320 + 50, 1e-3);
    EXPECT_NEAR(centre(seen.polylines[0]).y, 180 + 10, 1e-3);
    EXPECT_NEAR(seen.polylines[1].points.front().y, 180, 1e-3);
    EXPECT_NEAR(seen.polylines[1].points.back().y, 190, 1e-3);
    EXPECT_EQ(seen.labels.at(0).text, "10 cm");
    const Picture large = drawn(0.1, 10);
    EXPECT_NEAR(centre(large.polylines[0]).y, 180 + 100, 1e-3);
    EXPECT_EQ(large.labels.at(0).text, "10 cm") << "the true distance";
}

// The body is drawn 0.9 m to the left of where it is, and its second disc further up.
TEST(Ghosts, AreBesideTheDiscOfTheBody) {
    World world(2);
    const Entity body = world.spawn(Body{.position = {0.5, 0}});
    Picture picture{.camera = {.height = 3.6F}};
    picture.discs = {{.key = key_of(world, body, 1), .centre = {-0.4F, 1}},
                     {.key = key_of(world, body), .centre = {-0.4F, 0}}};
    add_ghosts(picture, {{body, {0.5, 0}, {0.5, 0.1}}}, 1);
    const auto& line = picture.polylines.at(1).points;
    EXPECT_NEAR(line.front().x, 320 - 40, 1e-3);
    EXPECT_NEAR(line.back().x, 320 - 40, 1e-3);
    EXPECT_NEAR(line.front().y, 180, 1e-3);
    EXPECT_NEAR(line.back().y, 190, 1e-3);
}

TEST(Ghosts, AreAsLargeAsTheirDiscs) {
    World world(2);
    const Entity body = world.spawn(Body{});
    Picture picture{.camera = {.height = 3.6F}};
    picture.discs = {{.key = key_of(world, body), .centre = {0.4F, 0}, .radius = 0.2F}};
    add_ghosts(picture, {{body, {}, {0.5, 0}}}, 1);
    EXPECT_NEAR(std::ranges::max(picture.polylines.at(0).points, {}, &Point::x).x, 320 + 90 + 20,
                1e-3);
}

TEST(Ghosts, TheFurthestHaveTheirDistancesBesideTheirRings) {
    Picture picture{.camera = {.height = 3.6F}};
    std::vector<Ghost> ghosts;
    for (std::uint32_t i = 0; i < 20; ++i)
        ghosts.push_back({{i, 1}, {}, {i % 2 == 0 ? 0.1 * i : -0.1 * i}});
    add_ghosts(picture, ghosts, 1);
    ASSERT_EQ(picture.labels.size(), 5U);
    EXPECT_EQ(picture.labels.back().text, "1.9 m");
    EXPECT_EQ(picture.labels.back().align, Align::right);
    EXPECT_LT(picture.labels.back().at.x, 320 - 190);
    EXPECT_EQ(picture.labels.front().text, "1.5 m");
    EXPECT_EQ(picture.labels[1].align, Align::left);
    EXPECT_GT(picture.labels[1].at.x, 320 + 160);
}

}  // namespace
}  // namespace oiler::test
