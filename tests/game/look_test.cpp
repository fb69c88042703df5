// SPDX-License-Identifier: MIT
#include "oiler/game/look.hpp"

#include "oiler/game/game.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A game that only says how its bodies look.
struct Plain {
    static constexpr About about{.name = "plain", .title = "Plain"};
    World world;
    Camera camera{.centre = {3, 1}, .height = 8};
    explicit Plain(const Settings& settings) : world(2, settings) {
        world.add(world.spawn(Body{.position = {1, 2}}), Look{.size = 0.25F});
        world.add(
            world.spawn(Body{.position = {4, 2}}),
            Look{.shape = Look::Shape::square, .size = 2, .colour = palette::green, .layer = 3});
        (void)world.spawn(Body{.position = {9, 9}});
        world.add(world.create(), Look{});
    }
};

struct Named : Plain {
    Entity planet = world.create(), moon = world.spawn({}), gone = world.spawn({});
    Entity first = world.create(), second = world.create();
    explicit Named(const Settings& settings) : Plain(settings) {
        world.add(planet, Name{"planet"});
        world.add(gone, Name{"comet"});
        for (const Entity comet : {first, second}) world.add(comet, Name{"comet"});
        world.destroy(gone);
    }
};

TEST(Name, IsWhatAnEntityIsCalled) {
    const AnyGameOf<Named> game(Settings{});
    const Named same(Settings{});
    EXPECT_EQ(game.name_of(same.planet), "planet");
    EXPECT_EQ(game.name_of(same.moon), "body " + std::to_string(same.moon.index));
    EXPECT_EQ(game.name_of(same.second), "comet " + std::to_string(same.second.index));
    EXPECT_EQ(game.name_of(same.gone), "body " + std::to_string(same.gone.index));
}

TEST(Look, DrawsAGameWithoutAPicture) {
    const AnyGameOf<Plain> game(Settings{});
    const Picture picture = game.picture();
    EXPECT_EQ(picture.camera, (Camera{{3, 1}, 8}));
    ASSERT_EQ(picture.discs.size(), 1U) << "bodies without a Look, and looks without a body";
    EXPECT_EQ(picture.discs[0].centre, (Point{1, 2}));
    EXPECT_EQ(picture.discs[0].radius, 0.25F);
    EXPECT_EQ(picture.discs[0].colour, palette::blue);
    EXPECT_EQ(picture.discs[0].key.object, game.world().entity_of_row(0).id());
    ASSERT_EQ(picture.polygons.size(), 1U);
    const Polygon& square = picture.polygons[0];
    EXPECT_EQ(square.points, (std::vector<Point>{{2, 0}, {6, 0}, {6, 4}, {2, 4}}));
    EXPECT_EQ(square.colour, palette::green);
    EXPECT_EQ(square.layer, 3);
}

TEST(Look, ObstaclesHaveTheColoursThatAreGiven) {
    World world(2, Settings{});
    const auto disc = world.add_obstacle({.shape = CircleShape{{1, 2}, 0.5}});
    const auto wall = world.add_obstacle({.shape = SegmentShape{{0, 0}, {1, 0}}});
    (void)world.add_obstacle({.shape = CircleShape{{5, 2}, 0.5}});
    const Picture picture =
        draw_looks(world, {}, {{disc, palette::orange}, {wall, palette::green}});
    ASSERT_EQ(picture.discs.size(), 4U) << "two outlines, each below its disc";
    EXPECT_EQ(picture.discs[0].colour, palette::grey);
    EXPECT_EQ(picture.discs[1].colour, palette::orange);
    EXPECT_EQ(picture.discs[3].colour, palette::pale);
    const auto line = std::ranges::find(picture.polylines, 2U,
                                        [](const Polyline& one) { return one.points.size(); });
    ASSERT_NE(line, picture.polylines.end());
    EXPECT_EQ(line->colour, palette::green);
}

struct Unframed {
    static constexpr About about{.name = "unframed", .title = "Unframed"};
    World world;
    explicit Unframed(const Settings& settings) : world(1, settings) {}
};

TEST(Look, HasTheUsualCameraWithoutOne) {
    const AnyGameOf<Unframed> game(Settings{});
    EXPECT_EQ(game.picture().camera, Camera{});
}

TEST(Look, OfATriangleReachesItsCorners) {
    World world(2, Settings{});
    world.add(world.spawn(Body{.position = {1, 2}}),
              Look{.shape = Look::Shape::triangle, .size = 2});
    const Polygon triangle = draw_looks(world, {}).polygons.at(0);
    ASSERT_EQ(triangle.points.size(), 3U);
    EXPECT_EQ(triangle.points[0], (Point{1, 4}));
    for (const Point corner : triangle.points)
        EXPECT_NEAR(std::hypot(corner.x - 1, corner.y - 2), 2, 1e-6);
}

// A plane fills its side of the picture; its normal may have any length.
TEST(Look, PlanesAreGround) {
    World world(2, Settings{});
    world.add_plane({.normal = {0, 3}, .offset = 6});
    world.add_plane({.normal = {-1, 0}, .offset = -5});
    const std::vector<Polygon> ground = draw_looks(world, {{100, 50}, 10}).polygons;
    ASSERT_EQ(ground.size(), 2U);
    float top = -1e9F;
    for (const Point point : ground[0].points) top = std::max(top, point.y);
    EXPECT_EQ(top, 2);
    EXPECT_EQ(ground[0].points[0].x, 140) << "as far as the camera sees";
    EXPECT_EQ(ground[0].points[1].x, 60);
    float left = 1e9F;
    for (const Point point : ground[1].points) left = std::min(left, point.x);
    EXPECT_EQ(left, 5) << "x ≤ 5 is free";
}

TEST(Look, ObstaclesAreDrawnWhereTheyAre) {
    World world(2, Settings{});
    const Vec3 velocity{3, -4};
    world.add_obstacle({.shape = CircleShape{{1, 2}, 0.5}, .velocity = velocity});
    world.add_obstacle({.shape = BoxShape{{4, 2}, {2, 1}}, .velocity = velocity});
    world.add_obstacle({.shape = SegmentShape{{0, 5}, {2, 6}}, .velocity = velocity});
    const Picture before = draw_looks(world, {});
    world.step(25);  // a quarter of a second
    const Picture after = draw_looks(world, {});
    const Picture half = between(before, after, 0.5F);
    ASSERT_EQ(after.discs.size(), 2U) << "the rim, and inside of it the circle";
    EXPECT_EQ(after.discs[0].radius, 0.5F);
    const float rim = 1.5F / 360 * 10;  // m, of 1.5 units of a picture of 10 m
    EXPECT_NEAR(after.discs[1].radius, 0.5F - rim, 1e-6F);
    for (const std::size_t i : {0, 1}) {
        EXPECT_EQ(after.discs[i].centre, (Point{1.75F, 1}));
        EXPECT_EQ(half.discs[i].centre, (Point{1.375F, 1.5F}));
    }
    ASSERT_EQ(after.polygons.size(), 1U);
    EXPECT_EQ(after.polygons[0].points,
              (std::vector<Point>{{3.75F, 0.5F}, {5.75F, 0.5F}, {5.75F, 1.5F}, {3.75F, 1.5F}}));
    EXPECT_EQ(half.polygons[0].points[0], (Point{3.375F, 1}));
    ASSERT_EQ(after.polylines.size(), 1U);
    EXPECT_EQ(after.polylines[0].points, (std::vector<Point>{{0.75F, 4}, {2.75F, 5}}));
    EXPECT_EQ(half.polylines[0].points[0], (Point{0.375F, 4.5F}));
}

// The line is on the sides within 60° of the direction: of a box two, if it is diagonal.
TEST(Look, OneWayObstaclesHaveALineOnTheirSide) {
    World world(2, Settings{});
    world.add_obstacle({.shape = BoxShape{{0, 0}, {2, 2}}, .one_way = Vec3{1, 1}});
    const Picture picture = draw_looks(world, {});
    ASSERT_EQ(picture.polylines.size(), 2U);
    EXPECT_EQ(picture.polylines[0].points, (std::vector<Point>{{1, -1}, {1, 1}}));
    EXPECT_EQ(picture.polylines[1].points, (std::vector<Point>{{1, 1}, {-1, 1}}));
    EXPECT_LT(picture.polygons.at(0).colour.a, 255);
}

TEST(Look, IsPartOfTheStateHash) {
    const auto hash_with = [](const Look& look) {
        World world(1, Settings{});
        world.add(world.create(), look);
        EXPECT_TRUE(world.unhashed().empty());
        return world.state_hash();
    };
    const std::uint64_t usual = hash_with({});
    EXPECT_NE(hash_with({.shape = Look::Shape::square}), usual);
    EXPECT_NE(hash_with({.size = 0.25F}), usual);
    EXPECT_NE(hash_with({.colour = palette::green}), usual);
    EXPECT_NE(hash_with({.layer = 1}), usual);
}

}  // namespace
}  // namespace oiler::test
