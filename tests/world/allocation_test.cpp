// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"
#include "oiler/world/collisions.hpp"
#include "oiler/world/neighbours.hpp"
#include "support/counting_new.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

World busy_world(const Method& method, Precision precision) {
    World world(2, {.method = &method, .rate = {100}, .precision = precision});
    world.set_gravity({0, -9.81, 0});
    for (int i = 0; i < 100; ++i) {
        const double place = i;
        const Entity entity =
            world.spawn({.mass = 1 + place, .position = {place, 1, 0}},
                        Spring{.stiffness = 2 + place, .damping = 1}, LinearDrag{0.1});
        if (method.order != exact_order)
            world.attach(entity, QuadraticDrag{0.001 * place},
                         CoilSpring{.stiffness = 3, .damping = 1, .rest_length = 1});
    }
    return world;
}

TEST(Allocations, AreCounted) {
    const long before = allocations;
    busy_world(methods().front(), Precision::single);
    EXPECT_GT(allocations, before);
}

TEST(Allocations, StepsMakeNone) {
    for (const Method& method : methods())
        for (const Precision precision : {Precision::single, Precision::double_})
            for (const int per_call : {1, 10}) {
                World world = busy_world(method, precision);
                world.step(per_call);
                const long before = allocations;
                for (int i = 0; i < 1000; ++i) world.step(per_call);
                EXPECT_EQ(allocations, before) << method.name << ", " << name_of(precision);
            }
}

// Implicit methods solve equations of all linked bodies, for which Eigen allocates.
TEST(Allocations, PushesAndLinksMakeNone) {
    for (const Method& method : methods()) {
        if (method.order == exact_order || std::holds_alternative<ImplicitStage>(method.rule))
            continue;
        World world = busy_world(method, Precision::single);
        const Entity first = world.entity_of_row(3);
        const Entity second = world.entity_of_row(4);
        world.link(first, second, {.stiffness = 2, .damping = 1, .rest_length = 1});
        const auto push = [&] {
            world.apply_force(first, {1, 2});
            world.apply_impulse(second, {0.5, 0});
            world.step();
        };
        push();
        const long before = allocations;
        for (int i = 0; i < 1000; ++i) push();
        EXPECT_EQ(allocations, before) << method.name;
    }
}

TEST(Allocations, ImpactsMakeNone) {
    for (const int threads : {1, 2}) {
        World world(2, Settings{.stepping = {.method = &find_method("velocity_verlet")},
                                .threads = threads});
        world.set_gravity({0, -9.81});
        world.add_plane({.normal = {0, 1}, .restitution = 1});
        for (int i = 0; i < 2000; ++i)
            world.spawn({.position = {0, 0.01 * (i % 7)}, .contact = Contact{}});
        const Entity a = world.spawn({.position = {0, 1}, .contact = Contact{}});
        world.link(a, world.spawn({.position = {0, 2}}), {.stiffness = 9, .rest_length = 1});
        for (int i = 0; i < 1000; ++i) world.step();
        const long before = allocations;
        std::size_t met = 0;
        for (int i = 0; i < 1000; ++i) {
            world.step();
            met += world.impacts().size();
        }
        EXPECT_EQ(allocations, before) << threads;
        EXPECT_GT(met, 50000U);
    }
}

/// Obstacles of all kinds: a level of tiles, a moving and an oscillating one, a ledge, a belt and
/// an area, and balls on ropes.
World world_of_obstacles(int threads) {
    World world(
        2, Settings{.stepping = {.method = &find_method("velocity_verlet")}, .threads = threads});
    world.set_gravity({0, -9.81});
    for (int i = 0; i < 400; ++i)
        world.add_obstacle({.shape = BoxShape{{i - 200.0, -0.5}, {1, 1}}, .restitution = 0.9});
    for (const double x : {-201.0, 201.0})
        world.add_obstacle({.shape = BoxShape{{x, 20}, {1, 60}}, .restitution = 0.9});
    world.add_obstacle(
        {.shape = CircleShape{{0, 3}, 1}, .restitution = 1, .swing = Swing{{50, 0}, 9}});
    world.add_obstacle({.shape = BoxShape{{0, 2}, {40, 0.2}}, .one_way = Vec3{0, 1}});
    world.add_obstacle({.shape = SegmentShape{{-90, 1}, {-30, 4}}, .friction = 0.3, .belt = 2});
    world.add_obstacle({.shape = CircleShape{{30, 2}, 2}, .solid = false});
    Entity last;
    for (int i = 0; i < 1500; ++i) {
        const Entity ball = world.spawn({.position = {(i - 750) / 4.0, 5.0 + i % 17},
                                         .velocity = {i % 5 - 2.0, 0},
                                         .contact = Contact{0.1}});
        if (i % 50 == 1)
            world.link(last, ball, {.stiffness = 9, .rest_length = 2, .pulls_only = true});
        last = ball;
    }
    return world;
}

TEST(Allocations, ObstaclesAndRopesMakeNone) {
    for (const int threads : {1, 2}) {
        World world = world_of_obstacles(threads);
        world.step(300);
        const long before = allocations;
        for (int i = 0; i < 150; ++i) world.step();
        EXPECT_EQ(allocations, before) << threads;
    }
}

TEST(Allocations, ReadingAWorldMakesNone) {
    const World world = busy_world(methods().front(), Precision::single);
    const long before = allocations;
    const std::uint64_t hash = world.state_hash();
    const double energy = world.bodies().energy().total();
    EXPECT_EQ(allocations, before) << hash << energy;
}

TEST(Allocations, UpdatesOfQueriesMakeNone) {
    World world(2, {.rate = {60}});
    for (int i = 0; i < 100; ++i) {
        const Vec3 position{0.7 * (i % 10), 0.7 * (i / 10)};
        const double radius = i % 10 == 0 ? 2 : 0.4;
        static_cast<void>(world.spawn({.position = position, .contact = Contact{radius}},
                                      Spring{.anchor = position * 1.1, .stiffness = 1}));
    }
    Collisions collisions;
    Neighbours neighbours;
    const auto step = [&](int steps) {
        for (int i = 0; i < steps; ++i) {
            world.step();
            collisions.update(world);
            neighbours.update(world);
        }
    };
    step(1000);
    EXPECT_GT(collisions.pairs().size(), 50U);
    const long before = allocations;
    step(1000);
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace oiler::test
