// SPDX-License-Identifier: MIT
// Obstacles that move, carry, are met from one side, or are asked for.
#include <unordered_map>

#include "oiler/sim/bodies.hpp"
#include "support/reference.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

// Seen from the circle, the ball is thrown at a standing one: the closed form of the reference.
TEST(MovingObstacles, AreMetAsInTheirOwnFrame) {
    for (const int rate : {20, 60}) {
        World world = world_of("velocity_verlet", rate, 2, {0, -g});
        world.add_obstacle({.shape = CircleShape{{}, 1}, .restitution = 0.8, .velocity = {1, 0.5}});
        const Entity ball = world.spawn({.position = {0.3, 3}, .contact = Contact{0.25}});
        world.step(17 * rate / 20);
        EXPECT_NEAR(world.position(ball)[0], -0.30579556297851409, 1e-14);
        EXPECT_NEAR(world.position(ball)[1], 2.3885653071508761, 1e-14);
    }
}

/// The times of bounces of a ball on a platform that swings, s.
std::vector<Impact> bounces_on_swing(int rate, int steps) {
    World world = world_of("velocity_verlet", rate, 2, {0, -g});
    world.add_obstacle(
        {.shape = BoxShape{{0, -0.5}, {2, 1}}, .restitution = 0.8, .swing = Swing{{0, 0.3}, 1.5}});
    world.spawn({.position = {0, 2.25}, .contact = Contact{0.25}});
    return impacts(world, steps, Meeting::bounce);
}

// The place of the platform is known at all times: no error but round-off, which a bounce on the
// moving platform multiplies by less than 30.
TEST(MovingObstacles, SwingExactlyBetweenSteps) {
    const nlohmann::json all = ::reference("obstacles");
    const auto swing = *std::ranges::find_if(
        all["extras"], [](const auto& one) { return one["name"] == "swinging_platform"; });
    for (const int rate : {20, 80}) {
        const auto met = bounces_on_swing(rate, 3 * rate);
        ASSERT_GE(met.size(), 4U);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(met[i].time, number(swing["impacts"][i]["t"]), 1e-10);
            EXPECT_NEAR(met[i].after[1], number(swing["impacts"][i]["after"]), 1e-9);
        }
    }
}

// A belt accelerates a body by μg up to its speed: the time and the way are closed forms.
TEST(MovingObstacles, CarryOnABelt) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    world.add_obstacle({.shape = BoxShape{{0, -1}, {40, 2}}, .friction = 0.4, .belt = 3});
    const Entity box = world.spawn({.position = {0, 0.5}, .contact = Contact{0.5}});
    world.step(60);
    const double time = 3 / (0.4 * g);
    EXPECT_NEAR(world.velocity(box)[0], 3, 1e-15);
    EXPECT_NEAR(world.position(box)[0], 9 / (0.8 * g) + 3 * (1 - time), 1e-13);
    EXPECT_EQ(world.position(box)[1], 0.5);
}

// A lift that accelerates by less than g keeps its rider: exactly at its height, always on ground.
TEST(MovingObstacles, CarryARider) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    const auto lift = world.add_obstacle({.shape = BoxShape{{0, -0.5}, {2, 1}}, .friction = 1});
    const Entity rider = world.spawn({.position = {0, 0.5}, .contact = Contact{0.5}});
    const double frequency = std::sqrt(4.4 / 2);  // 4.4 m/s² with an amplitude of 2 m
    for (int i = 1; i <= 600; ++i) {
        const double phase = frequency * i / 60;
        const Vec3 to{1 - std::cos(phase), -0.5 + 2 * (std::cos(phase) - 1)};
        world.move_obstacle(lift, to,
                            Vec3{frequency * std::sin(phase), -2 * frequency * std::sin(phase)});
        world.step();
        ASSERT_TRUE(world.ground(rider)) << i;
        ASSERT_EQ(world.ground(rider)->obstacle, lift);
        ASSERT_NEAR(world.position(rider)[1], to[1] + 1, 1e-14) << i;
        ASSERT_NEAR(world.position(rider)[0], to[0], 1e-12) << i;
    }
}

// A point is borne as a disc is, though its depth by round-off is more than a part of its radius.
// On a belt of 1 m/s, on a box with 0.4 m/s, it comes to rest after 1.4/(μg) s, and on 1.4²/(2μg)
// m.
TEST(MovingObstacles, CarryPoints) {
    constexpr double mu = 0.5;
    for (const auto precision : {Precision::single, Precision::double_})
        for (const int axes : {2, 3})
            for (const double radius : {0.0, 1e-3}) {
                World world = world_of("velocity_verlet", 60, axes, {0, -g}, {}, precision);
                const double belt = axes == 2 ? 1 : 0;
                Obstacle box{.shape = BoxShape{{0, -1}, {40, 2, axes == 3 ? 40.0 : 0}},
                             .friction = mu};
                box.belt = belt;
                box.velocity = {0.4, 0};
                world.add_obstacle(box);
                const Entity rider =
                    world.spawn({.position = {0, radius}, .contact = Contact{radius}});
                world.step(120);
                const double speed = 0.4 + belt;
                const double way = speed * 2 - speed * speed / (2 * mu * g);
                const double noise = precision == Precision::single ? 1e-4 : 1e-12;
                EXPECT_NEAR(world.position(rider)[0], way, noise) << radius << axes;
                EXPECT_NEAR(world.position(rider)[1], radius, noise) << radius << axes;
            }
}

// A rider lands on a platform that swings up and down, or sideways beneath him if it has no
// friction. Upwards the reaction is 9.81 − 0.3·(2π/1.5)² = 4.5 m/s² at least.
// Round-off at some 1 m is below 1e-15 m, over few operations per step that do not add up.
TEST(MovingObstacles, CarryOneWhoLandsOnASwing) {
    for (const int rate : {20, 60, 120})
        for (const double friction : {0.0, 1.0})
            for (const Vec3& way : {Vec3{0, 0.3}, Vec3{0.3}}) {
                World world = world_of("velocity_verlet", rate, 2, {0, -g});
                world.add_obstacle({.shape = BoxShape{{0, -0.5}, {4, 1}},
                                    .friction = friction,
                                    .swing = Swing{way, 1.5}});
                const Entity rider = world.spawn({.position = {0, 1.5}, .contact = Contact{0.5}});
                world.step(rate);
                const double from = world.position(rider)[0];
                for (int i = 0; i < 3 * rate; ++i) {
                    world.step();
                    const double phase = std::sin(2 * std::numbers::pi * world.time() / 1.5);
                    ASSERT_TRUE(world.ground(rider)) << rate << " " << friction;
                    ASSERT_NEAR(world.position(rider)[1], 0.5 + way[1] * phase, 1e-14);
                    if (friction == 0) {
                        ASSERT_NEAR(world.position(rider)[0], from, 1e-15);
                    }
                }
            }
}

// Velocities that change between steps are accelerations over the step: below g the rider stays.
TEST(MovingObstacles, CarryARiderOverChangesOfVelocity) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    const auto lift =
        world.add_obstacle({.shape = BoxShape{{0, -0.5}, {2, 1}}, .restitution = 0.5});
    const Entity rider = world.spawn({.position = {0, 0.5}, .contact = Contact{0.5}});
    world.step(2);
    for (int i = 1; i <= 300; ++i) {
        world.set_obstacle_velocity(lift, {0, 2 * std::sin(2.2 * i / 60)});
        world.step();
        for (const Impact& impact : world.impacts()) ASSERT_NE(impact.kind, Meeting::bounce) << i;
        ASSERT_TRUE(world.ground(rider)) << i;
        const auto box = std::get<BoxShape>(world.obstacle(lift).shape);
        ASSERT_NEAR(world.position(rider)[1], box.centre[1] + 1, 1e-13) << i;
    }
}

// A ceiling that sinks at 0.5 m/s leaves a ball of 0.6 m no room after (2 − 0.6)/0.5 s.
TEST(MovingObstacles, CrushABodyOnceAndThrowItNowhere) {
    for (const int rate : {20, 60}) {
        World world = world_of("velocity_verlet", rate, 2, {0, -g});
        world.add_plane({.normal = {0, 1}});
        const auto ceiling =
            world.add_obstacle({.shape = BoxShape{{0, 2.5}, {10, 1}}, .velocity = {0, -0.5}});
        const Entity ball = world.spawn({.position = {0.1, 0.3}, .contact = Contact{0.3}});
        world.step();
        const auto met = impacts(world, 3 * rate);
        ASSERT_EQ(met.size(), 1U);
        EXPECT_EQ(met[0].kind, Meeting::crushed);
        EXPECT_EQ(met[0].obstacle, ceiling);
        EXPECT_NEAR(met[0].time, 2.8, 1e-14);
        EXPECT_EQ(world.position(ball), (Vec3{0.1, 0.3}));
        world.set_obstacle_velocity(ceiling, {0, 2});
        EXPECT_EQ(count(world, 3 * rate), 0);
        EXPECT_EQ(world.position(ball), (Vec3{0.1, 0.3}));
    }
}

World ledge_world(int rate) {
    World world = world_of("velocity_verlet", rate, 2, {0, -g});
    world.add_plane({.normal = {0, 1}});
    world.add_obstacle({.shape = BoxShape{{0, 2}, {6, 0.2}}, .one_way = Vec3{0, 1}});
    return world;
}

// Jumps through a ledge end at the same place at any rate: on it if the feet get above it.
TEST(OneWayObstacles, AreMetFromTheirSideOnly) {
    for (const int rate : {20, 60, 240})
        for (const double speed : {6.0, 6.6, 7.5, 9.0}) {
            World world = ledge_world(rate);
            const Entity hero = world.spawn(
                {.position = {0, 0.25}, .velocity = {0, speed}, .contact = Contact{0.25}});
            world.step(3 * rate);
            const double apex = speed * speed / (2 * g);
            EXPECT_NEAR(world.position(hero)[1], apex > 2.1 ? 2.35 : 0.25, 1e-14) << speed;
        }
}

TEST(OneWayObstacles, AreLeftDownwards) {
    World world = ledge_world(60);
    const Entity hero = world.spawn({.position = {0, 2.35}, .contact = Contact{0.25}});
    world.step(30);
    ASSERT_TRUE(world.ground(hero));
    world.drop_through(hero);
    EXPECT_FALSE(world.ground(hero));
    world.step(120);
    EXPECT_NEAR(world.position(hero)[1], 0.25, 1e-14);
}

TEST(Ground, IsWhatBearsTheBodyMostAgainstThePull) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    const auto floor = world.add_plane({.normal = {0, 1}});
    const auto wall = world.add_obstacle({.shape = BoxShape{{2, 1}, {1, 2}}});
    const Entity hero =
        world.spawn({.position = {1, 0.5}, .velocity = {0, 0}, .contact = Contact{0.5}});
    world.step();
    ASSERT_TRUE(world.ground(hero));
    EXPECT_EQ(world.ground(hero)->obstacle, floor);
    EXPECT_EQ(world.ground(hero)->normal, (Vec3{0, 1}));
    ASSERT_EQ(world.touches(hero).size(), 2U);
    EXPECT_EQ(world.touches(hero)[1].obstacle, wall);
    EXPECT_FALSE(world.touches(hero)[1].bears);
    world.set_velocity(hero, {0, 3});
    EXPECT_FALSE(world.ground(hero));
    world.step();
    EXPECT_FALSE(world.ground(hero));
}

TEST(Raycast, FindsTheFirstObstacle) {
    World world(2, Settings{});
    const auto circle = world.add_obstacle({.shape = CircleShape{{5, 0}, 1}});
    const auto box = world.add_obstacle({.shape = BoxShape{{9, 0}, {2, 2}}});
    const auto hit = world.raycast({0, 0}, {10, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->obstacle, circle);
    EXPECT_NEAR(hit->fraction, 0.4, 1e-15);
    EXPECT_NEAR(hit->point[0], 4, 1e-15);
    EXPECT_NEAR(hit->normal[0], -1, 1e-15);
    EXPECT_NEAR(world.raycast({0, 0}, {10, 0}, {0.5})->fraction, 0.35, 1e-15);
    EXPECT_EQ(world.raycast({0, 1.8}, {10, 0.6})->obstacle, box);
    EXPECT_FALSE(world.raycast({0, 3}, {10, 3}));
    EXPECT_FALSE(world.raycast({0, 0}, {-10, 0}));
    EXPECT_EQ(world.raycast({5, 0.5}, {10, 0})->fraction, 0);
    EXPECT_EQ(world.overlaps({7, 0}, {1.5}), (std::vector{circle, box}));
}

// A level part and a slope of 45°. Points that are bodies pass segments.
TEST(Raycast, ARayWithoutAWidthMeetsSegments) {
    for (const Precision precision : {Precision::double_, Precision::single}) {
        World world(2, Settings{.stepping = {.precision = precision}});
        const std::vector<Vec3> points{{-1, 0}, {0, 0}, {1, 1}};
        const auto parts = world.add_chain(points, false, {});
        const auto expect_hit = [&](const Vec3& from, const Vec3& to, std::size_t part,
                                    double fraction, const Vec3& normal) {
            const auto hit = world.raycast(from, to);
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->obstacle, parts.at(part));
            EXPECT_NEAR(hit->fraction, fraction, 1e-6);
            EXPECT_LT(length(hit->normal - normal), 1e-6);
        };
        const double root = std::sqrt(0.5);
        expect_hit({-0.5, 1}, {-0.5, -3}, 0, 0.25, {0, 1});
        expect_hit({-0.5, -3}, {-0.5, 1}, 0, 0.75, {0, -1});
        expect_hit({0.5, 2}, {0.5, 0}, 1, 0.75, {-root, root});
        EXPECT_NEAR(world.raycast({0, 1}, {0, -1})->fraction, 0.5, 1e-6) << "at the joint";
        EXPECT_FALSE(world.raycast({-1.1, 1}, {-1.1, -1})) << "past the end";
        EXPECT_FALSE(world.raycast({-0.5, 1}, {-0.5, 0.1})) << "it ends before";
        EXPECT_FALSE(world.raycast({-0.5, -0.1}, {-0.5, -1})) << "it leads away";
    }
}

// A ledge of 2 m × 0.2 m, the top of a circle, and an edge, each met from above within 60°.
TEST(Raycast, MeetsOneWayObstaclesFromTheirOwnSide) {
    const Shape shapes[] = {BoxShape{{0, -0.1}, {2, 0.2}}, CircleShape{{0, -1}, 1},
                            SegmentShape{{-1, 0}, {1, 0}}};
    for (const Shape& shape : shapes) {
        World world(2, Settings{});
        const auto ledge = world.add_obstacle({.shape = shape, .one_way = Vec3{0, 2}});
        for (const double radius : {0.0, 0.25}) {
            const auto hit = world.raycast({0, 1}, {0, -3}, {radius});
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->obstacle, ledge);
            EXPECT_NEAR(hit->fraction, (1 - radius) / 4, 1e-15);
            EXPECT_TRUE(world.raycast({0.5, 1}, {0, -1}, {radius})) << "obliquely from above";
            EXPECT_FALSE(world.raycast({0, -3}, {0, 1}, {radius})) << "from below";
            EXPECT_FALSE(world.raycast({0, -0.05}, {0, -3}, {radius})) << "from inside, or below";
            const double y = centre_of(shape)[1];
            EXPECT_FALSE(world.raycast({-3, y}, {3, y}, {radius})) << "from a side";
        }
        const auto floor = world.add_plane({.normal = {0, 1}, .offset = -2.5});
        EXPECT_EQ(world.raycast({0, -0.05}, {0, -3})->obstacle, floor) << "behind it";
    }
}

// Swings by 0.5 m, a quarter of its period later; moves by 3 m/s and −4 m/s.
TEST(ObstacleHandles, HaveAPlace) {
    World world(2, Settings{.stepping = {.rate = {100}}});
    const Vec3 velocity{3, -4};
    const auto lift =
        world.add_obstacle({.shape = BoxShape{{1, 2}, {1, 1}, 0.3}, .swing = Swing{{0, 0.5}, 1}});
    const auto peg = world.add_obstacle({.shape = CircleShape{{4, 5}, 1}, .velocity = velocity});
    const auto edge =
        world.add_obstacle({.shape = SegmentShape{{0, 1}, {2, 5}}, .velocity = velocity});
    const auto floor = world.add_obstacle(
        {.shape = HalfSpaceShape{{0, -2}, 6}, .velocity = velocity, .one_way = {}});
    const auto wall = world.add_plane({.normal = {3, 4}, .offset = 10});
    for (const double time : {0.0, 0.25}) {
        const Vec3 way = time * velocity;
        const auto expect_at = [&](ObstacleHandle handle, const Vec3& place) {
            EXPECT_LT(length(world.position(handle) - place), 1e-12);
        };
        expect_at(lift, {1, 2 + 2 * time});
        expect_at(peg, Vec3{4, 5} + way);
        expect_at(edge, Vec3{1, 3} + way);
        expect_at(floor, {0, -3 + way[1]});
        expect_at(wall, {1.2, 1.6});
        world.step(25);
    }
    world.move_obstacle(peg, {7, 8});
    world.step();
    EXPECT_EQ(world.position(peg), (Vec3{7, 8}));
}

TEST(ObstacleHandles, AreKeysOfAMap) {
    World world(2, Settings{});
    std::unordered_map<ObstacleHandle, int> all;
    for (int i = 0; i < 1000; ++i) all[world.add_obstacle({.shape = CircleShape{}})] = i;
    EXPECT_EQ(all.size(), 1000U);
    const ObstacleHandle seventh = world.bodies().obstacles()[7];
    EXPECT_EQ(all.at(seventh), 7);
    world.remove_obstacle(seventh);
    const ObstacleHandle newer = world.add_obstacle({.shape = CircleShape{}});
    EXPECT_EQ(newer.slot, seventh.slot);
    EXPECT_FALSE(all.contains(newer));
}

TEST(ObstacleHandles, KnowWhenTheyAreStale) {
    World world(2, Settings{});
    const auto first = world.add_obstacle({.shape = CircleShape{}});
    world.remove_obstacle(first);
    EXPECT_FALSE(world.alive(first));
    const auto second = world.add_obstacle({.shape = CircleShape{}});
    EXPECT_EQ(second.slot, first.slot);
    EXPECT_FALSE(world.alive(first));
    EXPECT_TRUE(world.alive(second));
    try {
        world.move_obstacle(first, {});
        FAIL();
    } catch (const Mistake& mistake) {
        EXPECT_STREQ(mistake.what(), "move_obstacle of obstacle 0 at tick 0: it is gone");
    }
}

// A removed floor lets the body fall in the next step, a settled one, too.
TEST(ObstacleHandles, WakeBodiesWhenObstaclesGo) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    const auto floor = world.add_obstacle({.shape = BoxShape{{0, -0.5}, {2, 1}}});
    const Entity ball = world.spawn({.position = {0, 0.5}, .contact = Contact{0.5}});
    world.step(60);
    EXPECT_EQ(world.position(ball)[1], 0.5);
    world.remove_obstacle(floor);
    world.step(60);
    EXPECT_NEAR(world.position(ball)[1], 0.5 - g / 2, 1e-13);
}

TEST(Snapshots, HoldWhereObstaclesAre) {
    World world = ledge_world(60);
    const auto platform = world.add_obstacle(
        {.shape = BoxShape{{3, 1}, {1, 0.2}}, .restitution = 0.5, .velocity = {-0.5, 0}});
    world.spawn({.position = {2.5, 4}, .contact = Contact{0.25}});
    world.step(30);
    World copy = world;
    world.move_obstacle(platform, {2, 1.2});
    world.step(90);
    copy.move_obstacle(platform, {2, 1.2});
    copy.step(45);
    copy.step(45);
    StateHash first;
    StateHash second;
    world.bodies().hash_into(first);
    copy.bodies().hash_into(second);
    EXPECT_EQ(first.value(), second.value());
}

}  // namespace
}  // namespace oiler::test
