// SPDX-License-Identifier: MIT
// Bodies that come to rest on planes. How they slide is in sliding_test.cpp.
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

// A ball thrown up at u lands at u again; n bounces later it leaves at u·eⁿ, and the flights of
// 2·u·eⁿ/g add up to 2u/(g(1 − e)).
TEST(Resting, BeginsWhenAllBouncesAreOver) {
    for (const double e : {0.0, 0.5, 0.9, 0.99})
        for (const int rate : {20, 60, 240}) {
            World world =
                world_of("velocity_verlet", rate, 1, {-g}, {{.normal = {1}, .restitution = e}});
            const Entity ball = world.spawn({.velocity = {3}, .contact = Contact{}});
            const auto rests = impacts(world, 70 * rate, Meeting::rest);
            ASSERT_EQ(rests.size(), 1U) << e << " " << rate;
            const double expected = 2 * 3 / (g * (1 - e));
            // Each flight adds the round-off of a time to it.
            EXPECT_NEAR(rests[0].time, expected, 1e-11 * expected) << e << " " << rate;
            world.step(rate);
            EXPECT_EQ(world.position(ball)[0], 0);
            EXPECT_EQ(world.velocity(ball)[0], 0);
            EXPECT_TRUE(world.impacts().empty());
        }
}

TEST(Resting, OnAFloorChangesNoBit) {
    for (const char* method : contact_methods) {
        World world =
            world_of(method, 60, 2, {0, -g},
                     {{.normal = {0, 1}, .offset = 0.3, .restitution = 0.5, .friction = 0.5}});
        const Entity box = world.spawn({.position = {0.7, 0.3 + 0.1}, .contact = Contact{0.1}});
        world.step(10);
        const Vec3 at = world.position(box);
        EXPECT_NEAR(at[1], 0.4, epsilon) << method;
        world.step(1000);
        EXPECT_EQ(world.position(box), at) << method;
        EXPECT_EQ(world.velocity(box), Vec3{}) << method;
    }
}

// Coulomb: a box at rest on a slope of angle w begins to slide if tan w > μ.
TEST(Resting, OnASlopeEndsAtTheFrictionAngle) {
    const double angle = 0.5;
    const Vec3 normal{-std::sin(angle), std::cos(angle)};
    for (const char* method : contact_methods)
        for (const double surplus : {-1e-6, 1e-6}) {
            World world = world_of(method, 60, 2, {0, -g},
                                   {{.normal = normal, .friction = std::tan(angle) + surplus}});
            const Entity box = world.spawn({.contact = Contact{}});
            world.step(60);
            const double speed = length(world.velocity(box));
            if (surplus > 0) {
                EXPECT_EQ(speed, 0) << method;
                EXPECT_LE(length(world.position(box)), 8 * epsilon) << method;
            } else {
                // g·(sin w − μ·cos w) over 1 s; the difference has six digits less.
                EXPECT_NEAR(speed, g * std::cos(angle) * 1e-6, 1e-13) << method;
            }
        }
}

// Between a floor and a slope of 45°, gravity presses into both; no friction, no motion.
TEST(Resting, InACorner) {
    for (const char* method : contact_methods) {
        World world = world_of(
            method, 30, 2, {0, -g},
            {{.normal = {1, 1}, .restitution = 0.3}, {.normal = {-1, 1}, .restitution = 0.3}});
        const Entity ball =
            world.spawn({.position = {0.1, 0.5}, .velocity = {0.3, -0.2}, .contact = Contact{}});
        world.step(30 * 20);
        EXPECT_NEAR(world.position(ball)[0], 0, 1e-12) << method;
        EXPECT_NEAR(world.position(ball)[1], 0, 1e-12) << method;
        const Vec3 at = world.position(ball);
        world.step(100);
        EXPECT_EQ(world.position(ball), at) << method;
    }
}

TEST(Resting, AlongAnEdgeSlides) {
    // A gutter along z that descends: without friction a ball slides along its edge.
    World world = world_of("velocity_verlet", 100, 3, {0, -g, 3},
                           {{.normal = {1, 1, 0}}, {.normal = {-1, 1, 0}}});
    const Entity ball = world.spawn({.contact = Contact{}});
    world.step(200);
    EXPECT_NEAR(world.position(ball)[0], 0, 1e-14);
    EXPECT_NEAR(world.position(ball)[1], 0, 1e-14);
    EXPECT_NEAR(world.position(ball)[2], 6, 1e-13);
}

// A lift: the force takes the ball off the floor once it exceeds the weight. The drive of 1 Hz and
// amplitude 2 g does so at sin(2πt) = 1/2, t = 1/12 s; from there on u = ∫(2g·sin 2πt − g)dt.
TEST(Resting, EndsWhenAForceLifts) {
    const double omega = 2 * std::acos(-1.0);
    const auto height_after = [&](int rate) {
        World world = world_of("rk4", rate, 1, {-g}, {{.normal = {1}}});
        const Entity ball =
            world.spawn({.contact = Contact{}}, Drive{.amplitude = {2 * g}, .frequency = 1});
        world.step(rate / 4);
        return world.position(ball)[0];
    };
    const double t0 = 1.0 / 12;
    const double s = 0.25 - t0;
    const double expected = 2 * g * std::cos(omega * t0) / omega * s -
                            2 * g * (1 - std::sin(omega * t0)) / (omega * omega) - g * s * s / 2;
    EXPECT_NEAR(height_after(20), expected, 2e-5);
    EXPECT_NEAR(height_after(200), expected, 2e-9);
}

TEST(Resting, EndsWithAPushOrANewForce) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g}, {{.normal = {0, 1}, .friction = 1}});
    const Entity box = world.spawn({.mass = 2, .contact = Contact{}});
    const auto rest = [&] {
        world.teleport(box, {0, 0});
        world.set_velocity(box, {0, 0});
        world.step(3);
        ASSERT_EQ(world.velocity(box), Vec3{});
    };
    rest();
    world.apply_force(box, {0, 60});
    world.step();
    EXPECT_NEAR(world.velocity(box)[1], (30 - g) / 60, 1e-15);
    rest();
    world.apply_impulse(box, {0, 4});
    world.step();
    EXPECT_NEAR(world.velocity(box)[1], 2 - g / 60, 1e-15);
    rest();
    world.set_gravity({0, g});
    world.step();
    EXPECT_NEAR(world.velocity(box)[1], g / 60, 1e-15);
    world.set_gravity({0, -g});
    rest();
    world.attach(box, Spring{.anchor = {0, 10}, .stiffness = 40});
    world.step();
    EXPECT_GT(world.velocity(box)[1], 0);
    world.detach<Spring>(box);
    rest();
    world.clear_planes();
    world.step();
    EXPECT_LT(world.velocity(box)[1], 0);
}

// The row that moves to the place of a removed one brings its own state of rest.
TEST(Resting, IsThatOfTheBody) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g}, {{.normal = {0, 1}}});
    const Entity resting = world.spawn({.contact = Contact{}});
    const Entity falling = world.spawn({.position = {0, 5}, .contact = Contact{}});
    world.step(3);
    const double y = world.position(falling)[1];
    world.destroy(resting);
    world.step();
    EXPECT_LT(world.position(falling)[1], y);
}

// Linked bodies rest without jitter, too. The damper of the link acts on the speed that the body
// below gains in each step, 2·g·dt at most, and shifts the one above by b·2·g·dt/k at most.
// The spring pulls with 3 N, and friction could hold 4.9 N.
TEST(Resting, OfALinkedBodyIsHeldByFriction) {
    for (const char* method :
         {"semi_implicit_euler", "velocity_verlet", "rk4", "implicit_midpoint"}) {
        World world = world_of(method, 60, 2, {0, -g}, {{.normal = {0, 1}, .friction = 0.5}});
        const Entity body = world.spawn({.position = {1, 0}, .contact = Contact{}});
        world.link_to_point(body, {}, {.stiffness = 3});
        world.step(600);
        EXPECT_EQ(world.position(body), (Vec3{1, 0})) << method;
        EXPECT_EQ(world.velocity(body), Vec3{}) << method;
    }
}

// The spring presses the body into a sharp corner: what one of the planes takes away goes into the
// other.
TEST(Resting, OfALinkedBodyInACorner) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g},
                           {{.normal = {0, 1}, .restitution = 0.5, .friction = 0.1},
                            {.normal = {-1, -0.6}, .restitution = 0.5, .friction = 0.1}});
    const Entity body = world.spawn({.position = {-1, 1}, .contact = Contact{}});
    world.link_to_point(body, {2, 0}, {.stiffness = 20, .damping = 1});
    world.step(1200);
    world.step();
    EXPECT_LE(length(world.position(body)), 16 * epsilon);
    EXPECT_EQ(world.velocity(body), Vec3{});
    EXPECT_TRUE(world.impacts().empty());
}

TEST(Resting, OfALinkedBody) {
    for (const double e : {0.0, 0.5, 0.9}) {
        World world = world_of("velocity_verlet", 600, 2, {0, -g},
                               {{.normal = {0, 1}, .restitution = e, .friction = 0.5}});
        const Entity below = world.spawn({.position = {0, 0.5}, .contact = Contact{0.1}});
        const Entity above = world.spawn({.position = {0, 1}, .contact = Contact{0.1}});
        world.link(below, above, {.stiffness = 500, .damping = 5, .rest_length = 0.5});
        world.step(600 * 60);
        const Vec3 at = world.position(above);
        world.step();
        EXPECT_EQ(world.position(above), at) << e;
        EXPECT_NEAR(at[1], 0.6 - g / 500, 5 * 2 * g / 600 / 500) << e;
        EXPECT_NEAR(world.position(below)[1], 0.1, epsilon) << e;
        EXPECT_EQ(world.velocity(below), Vec3{}) << e;
        EXPECT_TRUE(world.impacts().empty()) << e;
    }
}

// At the apex of a wedge at the origin, no distance and no speed is left to compare round-off with.
// At rest, nothing happens that could be listed.
TEST(Resting, AtTheApexOfAWedge) {
    for (const double steep : {0.5, 0.2, 0.05, 0.01})
        for (const double e : {0.0, 0.5})
            for (const double from : {0.0, 0.1}) {
                World world = world_of("velocity_verlet", 60, 2, {0, -g},
                                       {{.normal = {1, steep}, .restitution = e},
                                        {.normal = {-1, steep}, .restitution = e}});
                const Entity ball = world.spawn({.position = {from, 20}, .contact = Contact{}});
                world.step(1200);
                EXPECT_NEAR(length(world.position(ball)), 0, 1e-12) << steep << e << from;
                world.step();
                EXPECT_EQ(length(world.velocity(ball)), 0) << steep << e << from;
                EXPECT_TRUE(world.impacts().empty()) << steep << e << from;
            }
}

// Between an elastic plane and one that is not, flights become shorter without end, and no sum of
// them is known. The body ends where it touches both planes.
TEST(Resting, InAValleyWithAnElasticSide) {
    for (const int rate : {5, 20, 60}) {
        World world = world_of("velocity_verlet", rate, 2, {0, -g});
        const double slopes[] = {0.3, -0.2};
        const double elastic[] = {1, 0.4};
        for (const int i : {0, 1})
            world.add_plane({.normal = {slopes[i], 1}, .restitution = elastic[i]});
        const double radius = 0.2;
        const Entity ball = world.spawn({.position = {0.1, 1.5}, .contact = Contact{radius}});
        world.step(30 * rate);
        const double left = radius * std::hypot(slopes[0], 1);
        const double right = radius * std::hypot(slopes[1], 1);
        const double x = (left - right) / (slopes[0] - slopes[1]);
        EXPECT_NEAR(world.position(ball)[0], x, 16 * epsilon) << rate;
        EXPECT_NEAR(world.position(ball)[1], left - slopes[0] * x, 16 * epsilon) << rate;
        EXPECT_EQ(length(world.velocity(ball)), 0) << rate;
    }
}

// Planes that leave no room for a body leave its numbers finite.
TEST(Resting, WhereThereIsNoRoom) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    for (const Vec3 normal : {Vec3{0.9, 1.96}, {0.63, -0.64}, {-0.8, -0.63}, {0.21, 0.72}})
        world.add_plane({.normal = normal});
    const Entity ball = world.spawn(
        {.position = {-0.33, -0.17}, .velocity = {1.98, 0.65}, .contact = Contact{0.1}});
    world.step(600);
    EXPECT_LT(length(world.position(ball)), 1);
}

// The bounces would end at √(2·0.001/10)·3 = 0.0424 s, at x = 0.924 m. The body slides from the
// first one on, so it rests on the floor when it meets the wall at 0.75 m, at 0.025 s.
TEST(Resting, IsNotReportedBehindAWall) {
    World world = world_of("velocity_verlet", 10, 2, {0, -10},
                           {{.normal = {0, 1}, .restitution = 0.5},
                            {.normal = {-1, 0}, .offset = -0.75, .restitution = 0.9}});
    world.spawn({.position = {0.5, 0.001}, .velocity = {10}, .contact = Contact{}});
    const auto rests = impacts(world, 3, Meeting::rest);
    ASSERT_EQ(rests.size(), 1U);
    EXPECT_NEAR(rests[0].time, 0.025, 4 * epsilon);
    EXPECT_NEAR(rests[0].point[0], 0.75, 4 * epsilon);
}

// A body that slides on a floor from wall to wall does not leave the floor.
TEST(Resting, IsNotReportedAgainAtAWall) {
    World world = world_of("velocity_verlet", 60, 2, {0, -g},
                           {{.normal = {0, 1}},
                            {.normal = {1, 0}, .restitution = 1},
                            {.normal = {-1, 0}, .offset = -1, .restitution = 1}});
    world.spawn({.position = {0.5, 0.1}, .velocity = {3}, .contact = Contact{}});
    const auto all = impacts(world, 600);
    EXPECT_EQ(std::ranges::count(all, Meeting::rest, &Impact::kind), 1);
    EXPECT_EQ(std::ranges::count(all, Meeting::bounce, &Impact::kind), 31)
        << "30 walls and a floor";
}

// A game that waits for the end of bounces hears of it once, whatever the method, the rate and the
// precision.
TEST(Resting, IsReportedOnce) {
    for (const char* method : contact_methods)
        for (const int rate : {20, 50, 60, 144})
            for (const auto precision : {Precision::single, Precision::double_}) {
                World world =
                    world_of(method, rate, 2, {0, -g},
                             {{.normal = {0, 1}, .restitution = 0.8, .friction = 0.1}}, precision);
                world.spawn({.position = {0, 4}, .velocity = {1}, .contact = Contact{0.2}});
                const int rests = count(world, 20 * rate, Meeting::rest);
                EXPECT_EQ(rests, 1) << method << rate << name_of(precision);
            }
}

// In float, the last flights are as low as round-off: they may end between two steps.
TEST(Resting, IsReportedAfterFlightsAsLowAsRoundOff) {
    for (int i = 0; i < 100; ++i) {
        World world = world_of("rk3_kutta", 240, 2, {0, -g},
                               {{.normal = {0, 1}, .restitution = 0.95}}, Precision::single);
        world.spawn({.position = {0, 0.5 + 0.03 * i}, .contact = Contact{0.25}});
        const int rests = count(world, 40 * 240, Meeting::rest);
        EXPECT_EQ(rests, 1) << i;
    }
}

}  // namespace
}  // namespace oiler::test
