// SPDX-License-Identifier: MIT
// Areas, layers, and many obstacles. Times are those of free falls and straight ways.
#include <random>

#include "oiler/sim/bodies.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

Obstacle box(const Vec3& centre, const Vec3& size) { return {.shape = BoxShape{centre, size}}; }

// A fall from 5 m touches the top of an area at 2 m + 0.1 m after √(2·2.9/g), and is out of it,
// 1 m lower and another diameter, after √(2·4.1/g). Velocity Verlet steps falls exactly.
TEST(Areas, ListWhereBodiesEnterAndLeave) {
    for (const int rate : {7, 20, 60}) {
        World world = world_of("velocity_verlet", rate, 2, {0, -g});
        Obstacle area = box({0, 1.5}, {4, 1});
        area.solid = false;
        const ObstacleHandle handle = world.add_obstacle(area);
        const Entity ball = world.spawn({.position = {0, 5}, .contact = Contact{0.1}});
        const auto found = impacts(world, rate);
        ASSERT_EQ(found.size(), 2U);
        EXPECT_EQ(found[0].kind, Meeting::entered);
        EXPECT_EQ(found[1].kind, Meeting::left);
        EXPECT_EQ(found[0].obstacle, handle);
        EXPECT_NEAR(found[0].time, std::sqrt(2 * 2.9 / g), 1e-13);
        EXPECT_NEAR(found[1].time, std::sqrt(2 * 4.1 / g), 1e-13);
        EXPECT_NEAR(found[0].normal[1], 1, 1e-13);
        EXPECT_NEAR(world.position(ball)[1], 5 - g / 2, 1e-12);
    }
}

// A body that crosses a thin area within a step, one that bounces back out of it, and one that
// starts in it.
TEST(Areas, AreFoundWithinAStep) {
    World world = world_of("velocity_verlet", 10, 2);
    Obstacle area = box({50, 0}, {0.01, 10});
    area.solid = false;
    world.add_obstacle(area);
    world.spawn({.position = {0, 3}, .velocity = {1000, 0}, .contact = Contact{0.1}});
    world.spawn({.position = {50, -3}, .contact = Contact{0.1}});
    world.add_obstacle({.shape = BoxShape{{50, 0}, {0.002, 1}}, .restitution = 1});
    world.spawn({.position = {48, 0}, .velocity = {100, 0}, .contact = Contact{0.1}});
    const auto found = impacts(world, 1);
    std::vector<Meeting> kinds;
    std::vector<double> times;
    for (const Impact& one : found) {
        kinds.push_back(one.kind);
        times.push_back(one.time);
    }
    using enum Meeting;
    ASSERT_EQ(kinds, (std::vector{entered, bounce, left, entered, left}));
    const std::vector right{0.01895, 0.01899, 0.01903, 0.049895, 0.050105};
    for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(times[i], right[i], 1e-13) << i;
}

// The side of an upright area is 0.1 m from the ball, which flies on or falls with 3 m/s along x:
// the gap has no acceleration.
TEST(Areas, AreEnteredWhereTheGapFallsEvenly) {
    for (const double pull : {0.0, -g})
        for (const double gap : {0.01, 0.1, 0.12, 0.2}) {
            World world = world_of("velocity_verlet", 60, 2, {0, pull});
            Obstacle area = box({2, 0}, {2, 50});
            area.solid = false;
            world.add_obstacle(area);
            world.spawn({.position = {0.5 - gap, 1}, .velocity = {3, 0}, .contact = Contact{0.5}});
            const auto found = impacts(world, 10);
            ASSERT_EQ(found.size(), 1U);
            EXPECT_NEAR(found[0].time, gap / 3, 1e-15) << gap;
            EXPECT_NEAR(found[0].point[0], 1, 1e-14) << gap;
        }
}

// The ball of the second row is in the area first.
TEST(Areas, ListLinkedBodiesInTheOrderOfTime) {
    World world = world_of("velocity_verlet", 10, 2, {0, -g});
    Obstacle area = box({}, {10, 2});
    area.solid = false;
    world.add_obstacle(area);
    const Entity high =
        world.spawn({.position = {0, 1.95}, .velocity = {0, -5}, .contact = Contact{0.5}});
    const Entity low =
        world.spawn({.position = {2, 1.6}, .velocity = {0, -5}, .contact = Contact{0.5}});
    world.link(high, low, {.stiffness = 10, .rest_length = 20, .pulls_only = true});
    const auto found = impacts(world, 1);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].entity, low);
    EXPECT_EQ(found[1].entity, high);
}

// The area moves over a body at rest, and away: gaps of 1 − 0.1 − 0.5 and 1 + 0.1 + 0.5 m at 1 m/s.
TEST(Areas, MoveOverBodiesAtRest) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g}, {{{0, 1}, 0}});
    world.spawn({.position = {1, 0.1}, .contact = Contact{0.1}});
    world.step(10);
    Obstacle area = box({0, 0}, {1, 1});
    area.solid = false;
    area.velocity = {1, 0};
    world.add_obstacle(area);
    const auto found = impacts(world, 120);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].time, 10 / 60.0 + 0.4, 1e-12);
    EXPECT_NEAR(found[1].time, 10 / 60.0 + 1.6, 1e-12);
}

TEST(Areas, ChangeNoBits) {
    const auto hash = [](bool with_areas) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g}, {{{0, 1}, 0, 0.7, 0.2}});
        std::vector<Entity> balls;
        for (int i = 0; i < 200; ++i)
            balls.push_back(world.spawn({.position = {0.05 * i, 1 + 0.01 * i},
                                         .velocity = {0.3, 0},
                                         .contact = Contact{0.02}}));
        for (int i = 0; with_areas && i < 20; ++i) {
            Obstacle area = box({0.5 * i, 0.3}, {0.3, 0.4});
            area.solid = false;
            world.add_obstacle(area);
        }
        StateHash all;
        for (int i = 0; i < 120; ++i) {
            world.step();
            for (const Entity ball : balls)
                for (const double x : world.position(ball).axis) all.add(x);
        }
        return all.value();
    };
    EXPECT_EQ(hash(false), hash(true));
}

TEST(Layers, AreMetByTheBodiesThatNameThem) {
    for (const bool bounded : {false, true}) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g});
        Obstacle floor = box({0, -0.5}, {10, 1});
        if (!bounded) floor.shape = HalfSpaceShape{{0, 1}, 0};
        floor.layers = 2;
        world.add_obstacle(floor);
        const Entity meets = world.spawn({.position = {0, 1}, .contact = Contact{0.1, 2 | 4}});
        const Entity falls = world.spawn({.position = {1, 1}, .contact = Contact{0.1, 1 | 4}});
        world.step(60);
        EXPECT_NEAR(world.position(meets)[1], 0.1, 1e-14);
        EXPECT_NEAR(world.position(falls)[1], 1 - g / 2, 1e-13);
        EXPECT_TRUE(world.ground(meets));
        EXPECT_FALSE(world.ground(falls));
        EXPECT_TRUE(world.raycast({0, 1}, {0, -1}, {0, 2}));
        EXPECT_FALSE(world.raycast({0, 1}, {0, -1}, {0, 1}));
        world.set_contact(meets, Contact{0.1, 1});
        world.step();
        EXPECT_LT(world.position(meets)[1], 0.1);
        EXPECT_EQ(world.bodies().contact(0)->meets, 1U);
    }
    World world(2);
    Obstacle none = box({}, {1, 1});
    none.layers = 0;
    EXPECT_THROW(world.add_obstacle(none), Error);
}

/// A level of tiles with gaps and unlike sizes, and far more obstacles beside it.
std::vector<Obstacle> level(bool crowded) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-20, 20);
    std::vector<Obstacle> all;
    for (int i = 0; i < 60; ++i) {
        all.push_back(box({place(random), place(random) / 4}, {1 + place(random) / 25, 0.5}));
        all.back().restitution = 0.8;
    }
    all.push_back({.shape = CircleShape{{0, -1020}, 1000}, .restitution = 0.8});
    for (int i = 0; crowded && i < 5000; ++i)
        all.push_back(box({100.0 + i % 70, -8.0 + i / 70}, {0.9, 0.9}));
    return all;
}
std::vector<Vec3> places_after(World& world, const std::vector<Entity>& balls, int steps) {
    std::vector<Vec3> places;
    for (int i = 0; i < steps; ++i) {
        world.step();
        for (const Entity ball : balls) places.push_back(world.position(ball));
    }
    return places;
}
std::vector<Entity> throw_balls(World& world) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-15, 15);
    std::vector<Entity> balls;
    for (int i = 0; i < 150; ++i)
        balls.push_back(world.spawn({.position = {place(random), 7},
                                     .velocity = {place(random), place(random)},
                                     .contact = Contact{0.1}}));
    return balls;
}

// Obstacles that a body does not meet change nothing, whatever the grid finds, in any order of
// adding, and added while the bodies fly.
TEST(ManyObstacles, ChangeNothingWhereTheyAreNotMet) {
    World few = world_of("velocity_verlet", 60, 2, {0, -g});
    for (const Obstacle& one : level(false)) few.add_obstacle(one);
    const auto right = places_after(few, throw_balls(few), 180);

    World many = world_of("velocity_verlet", 60, 2, {0, -g});
    for (const Obstacle& one : level(true)) many.add_obstacle(one);
    EXPECT_EQ(places_after(many, throw_balls(many), 180), right);

    World changed = world_of("velocity_verlet", 60, 2, {0, -g});
    for (const Obstacle& one : level(false)) changed.add_obstacle(one);
    const auto balls = throw_balls(changed);
    std::vector<Vec3> places;
    std::vector<ObstacleHandle> added;
    for (int i = 0; i < 180; ++i) {
        for (int k = 0; k < 30; ++k)
            added.push_back(changed.add_obstacle(box({200.0 + k, 1.0 * i}, {0.5, 0.5})));
        if (i % 3 == 2)
            for (int k = 0; k < 45; ++k) {
                changed.remove_obstacle(added.back());
                added.pop_back();
            }
        const auto after = places_after(changed, balls, 1);
        places.insert(places.end(), after.begin(), after.end());
    }
    EXPECT_EQ(places, right);
}

// A tile that is added below falling bodies bears them, and a removed one no longer does.
TEST(ManyObstacles, AreAddedAndRemovedWhileBodiesMove) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    for (int i = 0; i < 1000; ++i) world.add_obstacle(box({i + 0.5, -10.5}, {1, 1}));
    const Entity ball = world.spawn({.position = {500.2, 5}, .contact = Contact{0.1}});
    world.step(30);
    const ObstacleHandle tile = world.add_obstacle(box({500, 0}, {1, 1}));
    world.step(120);
    EXPECT_NEAR(world.position(ball)[1], 0.6, 1e-13);
    world.remove_obstacle(tile);
    world.step(120);
    EXPECT_NEAR(world.position(ball)[1], -9.9, 1e-12);
}

// A ray finds the first of ten thousand tiles, as each of them alone says.
TEST(ManyObstacles, AreHitByRaysInOrder) {
    World world(2);
    for (int i = 0; i < 10000; ++i)
        if (i % 7 != 0) world.add_obstacle(box({i % 100 + 0.5, i / 100 + 0.5}, {0.8, 0.8}));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-10, 110);
    for (int i = 0; i < 200; ++i) {
        const Vec3 from{place(random), place(random)};
        const Vec3 to{place(random), place(random)};
        double first = 2;
        for (const ObstacleHandle one : world.bodies().obstacles()) {
            const auto shape = std::get<BoxShape>(world.obstacle(one).shape);
            double enters = 0;
            double leaves = 1;
            for (int axis = 0; axis < 2; ++axis) {
                const double way = to[axis] - from[axis];
                const double a = (shape.centre[axis] - 0.4 - from[axis]) / way;
                const double b = (shape.centre[axis] + 0.4 - from[axis]) / way;
                enters = std::max(enters, std::min(a, b));
                leaves = std::min(leaves, std::max(a, b));
            }
            if (enters < leaves - 1e-9) first = std::min(first, enters);
        }
        const auto hit = world.raycast(from, to);
        EXPECT_NEAR(hit ? hit->fraction : 2, first, 1e-12) << i;
    }
}

}  // namespace
}  // namespace oiler::test
