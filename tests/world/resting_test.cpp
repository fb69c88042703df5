// SPDX-License-Identifier: MIT
// Bodies that come to rest on planes, and slide along them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "oiler/world/world.hpp"

namespace {

using oiler::Contact;
using oiler::Entity;
using oiler::Impact;
using oiler::Meeting;
using oiler::Vec3;
using oiler::World;

constexpr double g = 9.81;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
const char* const methods[] = {"semi_implicit_euler", "velocity_verlet", "rk4",
                               "implicit_midpoint",   "implicit_euler",  "exact"};

World world_of(const char* method, int rate, int axes = 2) {
    return World(axes, {.method = &oiler::find_method(method), .rate = {rate}});
}

// A ball thrown up at u lands at u again; n bounces later it leaves at u·eⁿ, and the flights of
// 2·u·eⁿ/g add up to 2u/(g(1 − e)).
TEST(Resting, BeginsWhenAllBouncesAreOver) {
    for (const double e : {0.0, 0.5, 0.9, 0.99})
        for (const int rate : {20, 60, 240}) {
            World world = world_of("velocity_verlet", rate, 1);
            world.set_gravity({-g});
            world.add_plane({.normal = {1}, .restitution = e});
            const Entity ball = world.spawn({.velocity = {3}, .contact = Contact{}});
            double rest = 0;
            while (rest == 0 && world.time() < 100) {
                world.step();
                for (const Impact& impact : world.impacts())
                    if (impact.kind == Meeting::rest) rest = impact.time;
            }
            const double expected = 2 * 3 / (g * (1 - e));
            // Each flight adds the round-off of a time to it.
            EXPECT_NEAR(rest, expected, 1e-11 * expected) << e << " " << rate;
            world.step(rate);
            EXPECT_EQ(world.position(ball)[0], 0);
            EXPECT_EQ(world.velocity(ball)[0], 0);
            EXPECT_TRUE(world.impacts().empty());
        }
}

TEST(Resting, OnAFloorChangesNoBit) {
    for (const char* method : methods) {
        World world = world_of(method, 60);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .offset = 0.3, .restitution = 0.5, .friction = 0.5});
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
    for (const char* method : methods)
        for (const double surplus : {-1e-6, 1e-6}) {
            World world = world_of(method, 60);
            world.set_gravity({0, -g});
            world.add_plane({.normal = normal, .friction = std::tan(angle) + surplus});
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

// A box pushed at 2 m/s over a floor with μ = 0.4 stops after u/(μg), at u²/(2μg).
TEST(Sliding, StopsWhereCoulombSays) {
    const double mu = 0.4;
    for (const char* method : {"velocity_verlet", "rk4", "implicit_midpoint", "exact"}) {
        World world = world_of(method, 7);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .friction = mu});
        const Entity box = world.spawn({.velocity = {2, 0}, .contact = Contact{}});
        world.step(7);
        EXPECT_NEAR(world.position(box)[0], 4 / (2 * mu * g), 1e-14) << method;
        EXPECT_EQ(world.position(box)[1], 0) << method;
        EXPECT_EQ(world.velocity(box), Vec3{}) << method;
    }
}

// Down a slope with friction: a = g·(sin w − μ·cos w), from rest.
TEST(Sliding, AcceleratesDownASlope) {
    const double angle = 0.6;
    const double mu = 0.25;
    for (const char* method : {"velocity_verlet", "rk4", "implicit_midpoint", "exact"}) {
        World world = world_of(method, 50);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {-std::sin(angle), std::cos(angle)}, .friction = mu});
        const Entity box = world.spawn({.contact = Contact{}});
        world.step(50);
        const double a = g * (std::sin(angle) - mu * std::cos(angle));
        EXPECT_NEAR(world.position(box)[0], -a / 2 * std::cos(angle), 1e-13) << method;
        EXPECT_NEAR(world.position(box)[1], -a / 2 * std::sin(angle), 1e-13) << method;
    }
}

// Straight up a slope that is too steep to rest on: it slows by g·(sin w + μ·cos w), and comes back
// with g·(sin w − μ·cos w). The velocity does not turn, in three axes neither.
TEST(Sliding, StraightUphillComesBack) {
    const double angle = 0.6;
    const double mu = 0.35;
    const double up = g * (std::sin(angle) + mu * std::cos(angle));
    const double down = g * (std::sin(angle) - mu * std::cos(angle));
    const double u = 4;
    const double back = 1.2 - u / up;
    const double way = u * u / (2 * up) - down / 2 * back * back;
    for (const int axes : {2, 3})
        for (const char* method : {"velocity_verlet", "rk4", "implicit_midpoint", "exact"})
            for (const int rate : {20, 25, 100}) {
                World world = world_of(method, rate, axes);
                world.set_gravity({0, -g});
                world.add_plane({.normal = {-std::sin(angle), std::cos(angle)}, .friction = mu});
                const Entity box = world.spawn(
                    {.velocity = {u * std::cos(angle), u * std::sin(angle)}, .contact = Contact{}});
                world.step(rate * 6 / 5);
                EXPECT_NEAR(world.position(box)[0], way * std::cos(angle), 1e-13)
                    << method << axes << rate;
                EXPECT_NEAR(world.position(box)[1], way * std::sin(angle), 1e-13)
                    << method << axes << rate;
            }
}

// A block on a spring with dry friction: each half-swing of amplitude A about ±μg/ω² loses
// 2μg/ω², until the spring is too weak: with ω = 2 /s, μg/ω² = 0.1 m and A = 0.95 m it stops at
// the fifth turn, at 0.95 − 5·0.2 = −0.05 m after five half-periods. The turns are within steps.
TEST(Sliding, OnASpringLosesTheSameAtEachTurn) {
    const double omega = 2;
    const double mu = 0.1 * omega * omega / g;
    World world = world_of("exact", 20);
    world.set_gravity({0, -g});
    world.add_plane({.normal = {0, 1}, .friction = mu});
    const Entity block = world.spawn({.position = {0.95, 0}, .contact = Contact{}},
                                     oiler::Spring{.anchor = {0, 0}, .stiffness = omega * omega});
    const double half_period = std::acos(-1.0) / omega;
    for (int half = 1; half <= 5; ++half) {
        while (world.time() + 1.0 / 20 <= half * half_period) world.step();
        // The position between turns, from the closed form.
        const double from = std::abs(0.95 - 0.2 * (half - 1)) * (half % 2 == 1 ? 1 : -1);
        const double centre = half % 2 == 1 ? 0.1 : -0.1;
        const double t = world.time() - (half - 1) * half_period;
        EXPECT_NEAR(world.position(block)[0], centre + (from - centre) * std::cos(omega * t), 1e-13)
            << half;
    }
    world.step(100);
    EXPECT_NEAR(std::abs(world.position(block)[0]), 0.05, 1e-13);
    EXPECT_EQ(world.velocity(block), Vec3{});
}

// Between a floor and a slope of 45°, gravity presses into both; no friction, no motion.
TEST(Resting, InACorner) {
    for (const char* method : methods) {
        World world = world_of(method, 30);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {1, 1}, .restitution = 0.3});
        world.add_plane({.normal = {-1, 1}, .restitution = 0.3});
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
    World world = world_of("velocity_verlet", 100, 3);
    world.set_gravity({0, -g, 3});
    world.add_plane({.normal = {1, 1, 0}});
    world.add_plane({.normal = {-1, 1, 0}});
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
        World world = world_of("rk4", rate, 1);
        world.set_gravity({-g});
        world.add_plane({.normal = {1}});
        const Entity ball =
            world.spawn({.contact = Contact{}}, oiler::Drive{.amplitude = {2 * g}, .frequency = 1});
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
    World world = world_of("velocity_verlet", 60);
    world.set_gravity({0, -g});
    world.add_plane({.normal = {0, 1}, .friction = 1});
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
    world.attach(box, oiler::Spring{.anchor = {0, 10}, .stiffness = 40});
    world.step();
    EXPECT_GT(world.velocity(box)[1], 0);
    world.detach<oiler::Spring>(box);
    rest();
    world.clear_planes();
    world.step();
    EXPECT_LT(world.velocity(box)[1], 0);
}

// The row that moves to the place of a removed one brings its own state of rest.
TEST(Resting, IsThatOfTheBody) {
    World world = world_of("velocity_verlet", 60);
    world.set_gravity({0, -g});
    world.add_plane({.normal = {0, 1}});
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
        World world = world_of(method, 60);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .friction = 0.5});
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
    World world = world_of("velocity_verlet", 60);
    world.set_gravity({0, -g});
    world.add_plane({.normal = {0, 1}, .restitution = 0.5, .friction = 0.1});
    world.add_plane({.normal = {-1, -0.6}, .restitution = 0.5, .friction = 0.1});
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
        World world = world_of("velocity_verlet", 600);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .restitution = e, .friction = 0.5});
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

// A ball falls from rest over h and slides on: with u = √(2gh), each impact takes μ(1 + e)·u·eᵏ of
// the speed along the floor, and the flights last 2u·eᵏ⁺¹/g. When the bounces are over, it slides
// w²/(2μg). Friction during the bounces that a step passes over must count once.
TEST(Sliding, AfterBouncesEndsWhereTheClosedFormDoes) {
    constexpr double h = 1;
    constexpr double e = 0.6;
    constexpr double mu = 0.2;
    const double u = std::sqrt(2 * g * h);
    double x = 8 * u / g;
    double along = 8;
    for (double speed = u; speed > 1e-12; speed *= e) {
        along -= mu * (1 + e) * speed;
        x += along * 2 * e * speed / g;
    }
    x += along * along / (2 * mu * g);
    const double tail_ends = u / g + 2 * u * e / (g * (1 - e));
    const double rests_at = x - along * along / (2 * mu * g);
    for (const char* method : {"velocity_verlet", "rk4", "exact", "implicit_midpoint"})
        for (const int rate : {3, 20, 60, 240}) {
            World world = world_of(method, rate, 2);
            world.set_gravity({0, -g});
            world.add_plane({.normal = {0, 1}, .restitution = e, .friction = mu});
            const Entity ball =
                world.spawn({.position = {0, h}, .velocity = {8}, .contact = Contact{}});
            int rests = 0;
            while (world.time() < 6) {
                world.step();
                for (const oiler::Impact& impact : world.impacts()) {
                    if (impact.kind != oiler::Meeting::rest) continue;
                    ++rests;
                    EXPECT_NEAR(impact.time, tail_ends, 1e-12) << method << rate;
                    EXPECT_NEAR(impact.point[0], rests_at, 1e-10) << method << rate;
                }
            }
            EXPECT_EQ(rests, 1) << method << rate;
            EXPECT_NEAR(world.position(ball)[0], x, 1e-10) << method << rate;
            EXPECT_EQ(world.velocity(ball)[0], 0) << method << rate;
        }
}

/// Where a puck stops that is thrown across a slope, from many small steps of its law in the plane:
/// pull p downhill, friction g against the velocity.
std::array<double, 2> stop_of_puck(double vx, double vy, double pull, double grip) {
    double x = 0;
    double y = 0;
    constexpr double dt = 1e-6;
    while (std::hypot(vx, vy) > 2 * grip * dt) {
        const double speed = std::hypot(vx, vy);
        const double ax = -grip * vx / speed;
        const double ay = pull - grip * vy / speed;
        x += vx * dt + ax * dt * dt / 2;
        y += vy * dt + ay * dt * dt / 2;
        vx += ax * dt;
        vy += ay * dt;
    }
    return {x, y};
}

// A slope of tan w = 0.1 with μ = 0.4; the slide has order 2, and stops at every rate.
// In three axes a stop has a closed form: 9/(2·0.5·g) m in all, of which 0.3 m to the wall.
TEST(Sliding, BouncesOffAWallBeforeItStops) {
    for (const char* method : {"exact", "velocity_verlet", "rk4"}) {
        World world = world_of(method, 1, 3);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .friction = 0.5});
        world.add_plane({.normal = {1}, .restitution = 1});
        const Entity body =
            world.spawn({.position = {0.3}, .velocity = {-3}, .contact = Contact{}});
        world.step();
        EXPECT_NEAR(world.position(body)[0], 9 / g - 0.3, 16 * epsilon) << method;
        for (const Impact& impact : world.impacts()) EXPECT_EQ(impact.kind, Meeting::bounce);
        world.step();
        EXPECT_EQ(world.velocity(body), Vec3{});
    }
}

// Friction stops the body at its first impact on a steep slope, then it hops down: what an impact
// takes at most is the whole speed along the slope. Each hop of 2u/(g·cos) is followed here in
// closed form.
TEST(Sliding, IsNotBrakedBetweenImpacts) {
    const double angle = 0.995814;
    const double e = 0.025257;
    const double friction = 1.11459;
    const double along = g * std::sin(angle);
    const double into = g * std::cos(angle);
    double t = 0;
    double v = 2.02898 * std::cos(angle);
    double u = 2.02898 * std::sin(angle);
    while (u > 1e-17) {
        v = std::max(v - friction * (1 + e) * u, 0.0);
        u *= e;
        v += along * 2 * u / into;
        t += 2 * u / into;
    }
    v += (along - friction * into) * (1 - t);
    for (const int rate : {1, 60, 240}) {
        World world = world_of("exact", rate);
        world.set_gravity({0, -g});
        world.add_plane({.normal = {-std::sin(angle), std::cos(angle)},
                         .restitution = e,
                         .friction = friction});
        const Entity body = world.spawn({.velocity = {2.02898}, .contact = Contact{}});
        world.step(rate);
        EXPECT_NEAR(length(world.velocity(body)), std::abs(v), 1e-12) << rate;
    }
}

TEST(Sliding, AcrossASlopeStops) {
    const double w = std::atan(0.1);
    const double pull = g * std::sin(w);
    const double grip = 0.4 * g * std::cos(w);
    // Across at 3 m/s, and uphill at 1 m/s. Downhill is (−cos w, −sin w, 0).
    const auto [across, down] = stop_of_puck(3, -1, pull, grip);
    const auto error = [&](const char* method, int rate) {
        World world = world_of(method, rate, 3);
        world.set_gravity({0, -g, 0});
        world.add_plane({.normal = {-0.1, 1, 0}, .friction = 0.4});
        const Entity puck =
            world.spawn({.velocity = {std::cos(w), std::sin(w), 3}, .contact = Contact{}});
        world.step(2 * rate);
        EXPECT_EQ(length(world.velocity(puck)), 0) << method << rate;
        const oiler::Vec3 end = world.position(puck);
        return std::hypot(end[0] + down * std::cos(w), end[1] + down * std::sin(w),
                          end[2] - across);
    };
    for (const char* method :
         {"semi_implicit_euler", "velocity_verlet", "rk4", "exact", "implicit_midpoint", "pefrl"})
        for (const int rate : {30, 50, 60, 100, 240}) (void)error(method, rate);
    // The errors at a stop depend on its place in a step: their bound falls by 4.
    for (const char* method : {"velocity_verlet", "exact", "rk4"}) {
        EXPECT_LT(error(method, 60), 1e-3) << method;
        EXPECT_LT(error(method, 480), 1e-3 / 64 + 3e-6) << method;
    }
}

// Near its stop, friction turns with the velocity at any rate: an implicit method that solved for
// it would find no solution. Friction is larger than the slope, so that each body stops within 5 s.
TEST(Sliding, StopsByImplicitMethods) {
    std::mt19937_64 random(1);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    for (const char* method : {"implicit_euler", "implicit_midpoint"})
        for (int i = 0; i < 100; ++i) {
            World world = world_of(method, i % 2 == 0 ? 60 : 5, 3);
            world.set_gravity({0, -10, 0});
            const double slope = i == 0 ? 0.2 : uniform(0, 0.4);
            world.add_plane({.normal = {slope, 1, 0},
                             .friction = i == 0 ? 0.3 : slope * 1.2 + uniform(0.1, 0.3)});
            const Entity body = world.spawn(
                {.velocity = {i == 0 ? 1 : uniform(-1, 1), 0, i == 0 ? 1 : uniform(-1, 1)},
                 .contact = Contact{}});
            world.step(5 * world.settings().stepping.rate.steps);
            EXPECT_EQ(length(world.velocity(body)), 0) << method << i;
        }
}

// At the apex of a wedge at the origin, no distance and no speed is left to compare round-off with.
// At rest, nothing happens that could be listed.
TEST(Resting, AtTheApexOfAWedge) {
    for (const double steep : {0.5, 0.2, 0.05, 0.01})
        for (const double e : {0.0, 0.5})
            for (const double from : {0.0, 0.1}) {
                World world = world_of("velocity_verlet", 60, 2);
                world.set_gravity({0, -g});
                world.add_plane({.normal = {1, steep}, .restitution = e});
                world.add_plane({.normal = {-1, steep}, .restitution = e});
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
        World world = world_of("velocity_verlet", rate, 2);
        world.set_gravity({0, -g});
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
    World world = world_of("velocity_verlet", 60, 2);
    world.set_gravity({0, -g});
    for (const oiler::Vec3 normal :
         {oiler::Vec3{0.9, 1.96}, {0.63, -0.64}, {-0.8, -0.63}, {0.21, 0.72}})
        world.add_plane({.normal = normal});
    const Entity ball = world.spawn(
        {.position = {-0.33, -0.17}, .velocity = {1.98, 0.65}, .contact = Contact{0.1}});
    world.step(600);
    EXPECT_LT(length(world.position(ball)), 1);
}

// The bounces would end at √(2·0.001/10)·3 = 0.0424 s, at x = 0.924 m. The body slides from the
// first one on, so it rests on the floor when it meets the wall at 0.75 m, at 0.025 s.
TEST(Resting, IsNotReportedBehindAWall) {
    World world = world_of("velocity_verlet", 10, 2);
    world.set_gravity({0, -10});
    world.add_plane({.normal = {0, 1}, .restitution = 0.5});
    world.add_plane({.normal = {-1, 0}, .offset = -0.75, .restitution = 0.9});
    world.spawn({.position = {0.5, 0.001}, .velocity = {10}, .contact = Contact{}});
    std::vector<Impact> rests;
    for (int i = 0; i < 3; ++i) {
        world.step();
        for (const Impact& impact : world.impacts())
            if (impact.kind == Meeting::rest) rests.push_back(impact);
    }
    ASSERT_EQ(rests.size(), 1U);
    EXPECT_NEAR(rests[0].time, 0.025, 4 * epsilon);
    EXPECT_NEAR(rests[0].point[0], 0.75, 4 * epsilon);
}

// A body that slides on a floor from wall to wall does not leave the floor.
TEST(Resting, IsNotReportedAgainAtAWall) {
    World world = world_of("velocity_verlet", 60);
    world.set_gravity({0, -g});
    world.add_plane({.normal = {0, 1}});
    world.add_plane({.normal = {1, 0}, .restitution = 1});
    world.add_plane({.normal = {-1, 0}, .offset = -1, .restitution = 1});
    world.spawn({.position = {0.5, 0.1}, .velocity = {3}, .contact = Contact{}});
    int rests = 0;
    int bounces = 0;
    for (int i = 0; i < 600; ++i) {
        world.step();
        for (const Impact& impact : world.impacts()) {
            rests += impact.kind == Meeting::rest;
            bounces += impact.kind == Meeting::bounce;
        }
    }
    EXPECT_EQ(rests, 1);
    EXPECT_EQ(bounces, 31) << "30 walls and a floor";
}

// A game that waits for the end of bounces hears of it once, whatever the method, the rate and the
// precision.
TEST(Resting, IsReportedOnce) {
    for (const char* method : methods)
        for (const int rate : {20, 50, 60, 144})
            for (const auto precision : {oiler::Precision::single, oiler::Precision::double_}) {
                World world(2, {.method = &oiler::find_method(method),
                                .rate = {rate},
                                .precision = precision});
                world.set_gravity({0, -g});
                world.add_plane({.normal = {0, 1}, .restitution = 0.8, .friction = 0.1});
                world.spawn({.position = {0, 4}, .velocity = {1}, .contact = Contact{0.2}});
                int rests = 0;
                for (int i = 0; i < 20 * rate; ++i) {
                    world.step();
                    for (const Impact& impact : world.impacts())
                        rests += impact.kind == Meeting::rest;
                }
                EXPECT_EQ(rests, 1) << method << rate << name_of(precision);
            }
}

// In float, the last flights are as low as round-off: they may end between two steps.
TEST(Resting, IsReportedAfterFlightsAsLowAsRoundOff) {
    for (int i = 0; i < 100; ++i) {
        World world(2, {.method = &oiler::find_method("rk3_kutta"),
                        .rate = {240},
                        .precision = oiler::Precision::single});
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .restitution = 0.95});
        world.spawn({.position = {0, 0.5 + 0.03 * i}, .contact = Contact{0.25}});
        int rests = 0;
        for (int step = 0; step < 40 * 240; ++step) {
            world.step();
            for (const Impact& impact : world.impacts()) rests += impact.kind == Meeting::rest;
        }
        EXPECT_EQ(rests, 1) << i;
    }
}

}  // namespace
