// SPDX-License-Identifier: MIT
// The paths of bodies as drawn. The oracle is the path itself: a body that moves along x = t.
#include "oiler/overlay/trails.hpp"

#include "oiler/game/look.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Colour body_colour = palette::blue;

/// A body that is drawn at (t, 1), half a metre to the left of the truth.
struct Drawn {
    World world{2};
    Entity body = world.spawn({});
    Trails trails;

    [[nodiscard]] Picture picture_at(double time) const {
        return {.discs = {{.key = key_of(world, body),
                           .centre = {static_cast<float>(time), 1},
                           .colour = body_colour,
                           .layer = 3}}};
    }
    void add(double time, bool with_truth = false) {
        std::vector<Ghost> ghosts;
        if (with_truth) ghosts = {{body, {7, 7}, {7.5, 7}}};
        trails.add(DrawnBodies(picture_at(time)), world, {body}, ghosts, time);
    }
    void play(double from, double to, double frame, bool with_truth = false) {
        for (int i = 0; from + i * frame <= to; ++i) add(from + i * frame, with_truth);
    }
    [[nodiscard]] std::vector<Polyline> lines(double factor = 1) const {
        Picture picture;
        trails.draw(picture, factor);
        return picture.polylines;
    }
};

std::vector<Point> points_of(const std::vector<Polyline>& lines) {
    std::vector<Point> points;
    for (const Polyline& line : lines)
        points.insert(points.end(), line.points.begin(), line.points.end());
    return points;
}

TEST(Trails, AreTheLastSecondsOfThePath) {
    Drawn drawn;
    drawn.play(0, 5, 1.0 / 64);
    const std::vector<Polyline> lines = drawn.lines();
    ASSERT_GT(lines.size(), 3U) << "shades";
    const std::vector<Point> points = points_of(lines);
    EXPECT_EQ(points.back(), (Point{5, 1})) << "the body";
    EXPECT_NEAR(points.front().x, 5 - Trails::duration, 1.0 / 64);
    EXPECT_TRUE(std::ranges::is_sorted(points, {}, &Point::x));
    EXPECT_EQ(lines.back().colour, body_colour);
    EXPECT_EQ(lines.back().layer, 3) << "under the body: discs of a layer come after polylines";
    for (std::size_t i = 1; i < lines.size(); ++i) {
        EXPECT_LT(lines[i].colour.r, lines[i - 1].colour.r) << "fades to white";
        EXPECT_EQ(lines[i].points.front(), lines[i - 1].points.back()) << "no gap";
    }
}

TEST(Trails, HaveFewPointsInSlowMotion) {
    Drawn drawn;
    drawn.play(0, 3, 1.0 / 4096);
    const std::size_t points = points_of(drawn.lines()).size();
    EXPECT_LT(points, 140U) << "at most 121 and one for each shade";
    EXPECT_GT(points, 100U);
    EXPECT_NEAR(points_of(drawn.lines()).back().x, 3, 1e-3) << "it does not lag behind the body";
}

TEST(Trails, ShowWhereTheBodyTrulyWas) {
    Drawn drawn;
    drawn.play(0, 1, 1.0 / 64, true);
    for (const double factor : {1.0, 10.0}) {
        const std::vector<Polyline> lines = drawn.lines(factor);
        const auto is_thin = [](const Polyline& line) { return line.width < 2; };
        std::vector<Polyline> thin;
        std::ranges::copy_if(lines, std::back_inserter(thin), is_thin);
        ASSERT_FALSE(thin.empty());
        EXPECT_NEAR(points_of(thin).back().x, 1 + factor * 0.5, 1e-6);
        EXPECT_NEAR(points_of(thin).back().y, 1, 1e-6);
    }
    drawn.add(1.1);
    for (const Polyline& line : drawn.lines()) {
        if (line.width >= 2) continue;
        for (const Point point : line.points) EXPECT_LE(point.x, 1.5F + 1e-6F) << "not known since";
    }
}

TEST(Trails, ForgetWhatWasUndone) {
    Drawn drawn;
    drawn.play(0, 1.5, 1.0 / 64);
    drawn.add(1);
    EXPECT_EQ(points_of(drawn.lines()).back(), (Point{1, 1}));
    drawn.add(0);
    EXPECT_TRUE(drawn.lines().empty()) << "a restart";
}

TEST(Trails, AreCutWhereTimeLeaps) {
    Drawn drawn;
    drawn.play(0, 0.5, 1.0 / 64);
    drawn.play(1.5, 2, 1.0 / 64);
    for (const Polyline& line : drawn.lines()) {
        const auto [low, high] = std::ranges::minmax(line.points, {}, &Point::x);
        EXPECT_TRUE(high.x <= 0.5F || low.x >= 1.5F);
    }
}

TEST(Trails, AreCutByATeleportAndEndWithTheBody) {
    Drawn drawn;
    drawn.play(0, 0.5, 1.0 / 64);
    drawn.world.teleport(drawn.body, {9, 9});
    drawn.play(0.6, 1, 1.0 / 64);
    for (const Polyline& line : drawn.lines()) {
        const auto [low, high] = std::ranges::minmax(line.points, {}, &Point::x);
        EXPECT_TRUE(high.x <= 0.5F || low.x >= 0.6F);
    }
    drawn.trails.add(DrawnBodies(Picture{}), drawn.world, {}, {}, 10);
    EXPECT_TRUE(drawn.lines().empty());
}

}  // namespace
}  // namespace oiler::test
