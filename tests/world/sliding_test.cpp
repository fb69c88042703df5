// SPDX-License-Identifier: MIT
// Bodies that slide along planes. How they come to rest is in resting_test.cpp.
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

// A box pushed at 2 m/s over a floor with μ = 0.4 stops after u/(μg), at u²/(2μg).
TEST(Sliding, StopsWhereCoulombSays) {
    const double mu = 0.4;
    for (const char* method : exact_flights) {
        World world = world_of(method, 7, 2, {0, -g}, {{.normal = {0, 1}, .friction = mu}});
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
    for (const char* method : exact_flights) {
        World world = world_of(method, 50, 2, {0, -g},
                               {{.normal = {-std::sin(angle), std::cos(angle)}, .friction = mu}});
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
        for (const char* method : exact_flights)
            for (const int rate : {20, 25, 100}) {
                World world =
                    world_of(method, rate, axes, {0, -g},
                             {{.normal = {-std::sin(angle), std::cos(angle)}, .friction = mu}});
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
    World world = world_of("exact", 20, 2, {0, -g}, {{.normal = {0, 1}, .friction = mu}});
    const Entity block = world.spawn({.position = {0.95, 0}, .contact = Contact{}},
                                     Spring{.anchor = {0, 0}, .stiffness = omega * omega});
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
    for (const char* method : exact_flights)
        for (const int rate : {3, 20, 60, 240}) {
            World world = world_of(method, rate, 2, {0, -g},
                                   {{.normal = {0, 1}, .restitution = e, .friction = mu}});
            const Entity ball =
                world.spawn({.position = {0, h}, .velocity = {8}, .contact = Contact{}});
            const auto rests = impacts(world, 6 * rate, Meeting::rest);
            ASSERT_EQ(rests.size(), 1U) << method << rate;
            EXPECT_NEAR(rests[0].time, tail_ends, 1e-12) << method << rate;
            EXPECT_NEAR(rests[0].point[0], rests_at, 1e-10) << method << rate;
            EXPECT_NEAR(world.position(ball)[0], x, 1e-10) << method << rate;
            EXPECT_EQ(world.velocity(ball)[0], 0) << method << rate;
        }
}

// A slope of tan w = 0.1 with μ = 0.4; the slide has order 2, and stops at every rate.
// In three axes a stop has a closed form: 9/(2·0.5·g) m in all, of which 0.3 m to the wall.
TEST(Sliding, BouncesOffAWallBeforeItStops) {
    for (const char* method : {"exact", "velocity_verlet", "rk4"}) {
        World world =
            world_of(method, 1, 3, {0, -g},
                     {{.normal = {0, 1}, .friction = 0.5}, {.normal = {1}, .restitution = 1}});
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
        World world = world_of("exact", rate, 2, {0, -g},
                               {{.normal = {-std::sin(angle), std::cos(angle)},
                                 .restitution = e,
                                 .friction = friction}});
        const Entity body = world.spawn({.velocity = {2.02898}, .contact = Contact{}});
        world.step(rate);
        EXPECT_NEAR(length(world.velocity(body)), std::abs(v), 1e-12) << rate;
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

// A circle holds a ball up to v² = g·L at its top, so that a faster belt with much friction gives
// it that speed at once, in the belt's direction. Friction beyond 2²⁰ of what stops it in the step
// is taken as that, in which the reaction is resolved to some thousandths.
TEST(Sliding, ABeltGivesNoMoreSpeedThanTheCurveHolds) {
    for (const double friction : {1e3, 1e5, 1e10, 1e20, 1e300})
        for (const double belt : {-3.0, 3.0}) {
            World world = world_of("velocity_verlet", 30, 2, {0, -g});
            world.add_obstacle({.shape = CircleShape{{}, 0.5}, .friction = friction, .belt = belt});
            const Entity ball = world.spawn({.position = {0, 0.501}, .contact = Contact{0.001}});
            world.step(3);
            const double held = std::sqrt(g * 0.501);
            EXPECT_NEAR(std::abs(world.velocity(ball)[0]), held, 0.003 * held) << friction;
            EXPECT_GT(belt * world.velocity(ball)[0], 0) << friction;
        }
}

// Friction stops a ball on a circle: the square w of its angular speed obeys
// dw/dθ = 2 g/R (sin θ − μ cos θ) + 2 μ w, which A cos θ + B sin θ + C exp(2 μ θ) solves. A step on
// a curve has order 2; wherever in a step the stop falls, the ball rests there from then on.
TEST(Sliding, StopsOnACircleWhereFrictionEndsIt) {
    constexpr double radius = 0.625;
    constexpr double mu = 0.9806;
    constexpr double speed = 0.98;
    const double a = g / radius * (4 * mu * mu - 2) / (1 + 4 * mu * mu);
    const double b = 2 * mu * (a - g / radius);
    const double c = speed * speed / (radius * radius) - a;
    double end = 0;
    double beyond = 0.5;
    for (int i = 0; i < 60; ++i) {
        const double angle = (end + beyond) / 2;
        const double w = a * std::cos(angle) + b * std::sin(angle) + c * std::exp(2 * mu * angle);
        (w > 0 ? end : beyond) = angle;
    }
    EXPECT_NEAR(radius * std::sin(end), 0.05711567027634, 1e-13) << "an integration in 40 digits";
    for (const int rate : {60, 100, 120, 150, 180, 200, 240, 300, 480, 720, 960, 1440})
        for (const double sense : {-1.0, 1.0}) {
            World world = world_of("velocity_verlet", rate, 2, {0, -g});
            world.add_obstacle({.shape = CircleShape{{}, 0.5}, .friction = mu});
            const Entity ball = world.spawn({.position = {0, radius},
                                             .velocity = {sense * speed, 0},
                                             .contact = Contact{radius - 0.5}});
            world.step(rate / 5);
            EXPECT_NEAR(world.position(ball)[0], sense * radius * std::sin(end), 1.0 / rate / rate)
                << rate;
            EXPECT_EQ(world.velocity(ball), Vec3{}) << rate;
        }
}

TEST(Sliding, AcrossASlopeStops) {
    const double w = std::atan(0.1);
    const double pull = g * std::sin(w);
    const double grip = 0.4 * g * std::cos(w);
    // Across at 3 m/s, and uphill at 1 m/s. Downhill is (−cos w, −sin w, 0).
    const std::array stop = stop_of_puck(3, -1, pull, grip);
    const double across = stop[0];
    const double down = stop[1];
    const auto error = [&](const char* method, int rate) {
        World world =
            world_of(method, rate, 3, {0, -g, 0}, {{.normal = {-0.1, 1, 0}, .friction = 0.4}});
        const Entity puck =
            world.spawn({.velocity = {std::cos(w), std::sin(w), 3}, .contact = Contact{}});
        world.step(2 * rate);
        EXPECT_EQ(length(world.velocity(puck)), 0) << method << rate;
        const Vec3 end = world.position(puck);
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
    Dice dice(1);
    for (const char* method : {"implicit_euler", "implicit_midpoint"})
        for (int i = 0; i < 100; ++i) {
            World world = world_of(method, i % 2 == 0 ? 60 : 5, 3);
            world.set_gravity({0, -10, 0});
            const double slope = i == 0 ? 0.2 : dice.uniform(0, 0.4);
            world.add_plane({.normal = {slope, 1, 0},
                             .friction = i == 0 ? 0.3 : slope * 1.2 + dice.uniform(0.1, 0.3)});
            const Entity body = world.spawn({.velocity = {i == 0 ? 1 : dice.uniform(-1, 1), 0,
                                                          i == 0 ? 1 : dice.uniform(-1, 1)},
                                             .contact = Contact{}});
            world.step(5 * world.settings().stepping.rate.steps);
            EXPECT_EQ(length(world.velocity(body)), 0) << method << i;
        }
}

}  // namespace
}  // namespace oiler::test
