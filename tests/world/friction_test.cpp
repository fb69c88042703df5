// SPDX-License-Identifier: MIT
// Friction with pushes that change within a step, and beyond what holds a body.
#include <numbers>

#include "world/contacts.hpp"

namespace oiler::test {
namespace {

/// The speed after 0.3 s of a ball that slides with 3 m/s on a surface of friction 0.5, which rises
/// with `rising` m/s, without gravity.
template <BodyForce Force>
double speed_under(const Force& force, const char* method, int rate, double rising = 0) {
    World world(2, Stepping{.method = &find_method(method), .rate = {rate}});
    world.add_obstacle({.shape = HalfSpaceShape{{0, 1}}, .friction = 0.5, .velocity = {0, rising}});
    const Entity ball = world.spawn(
        Body{.position = {0, 0.3}, .velocity = {3, rising}, .contact = Contact{0.3}}, force);
    world.step(rate * 3 / 10);
    return world.velocity(ball)[0];
}

/// v' = −c·√(v² + w²)·(v + μ·w): drag by a wind of w m/s onto the surface, and friction.
double speed_in_wind(double w) {
    const auto slope = [w](double v) { return -0.5 * std::hypot(v, w) * (v + 0.5 * w); };
    double v = 3;
    const double h = 1e-4;
    for (int i = 0; i < 3000; ++i) v += h * slope(v + h / 2 * slope(v));
    return v;
}

// Damping that presses a ball onto its surface gives friction. Linear, on a surface that rises with
// V: v' = −c·(v + μ·V). The errors of the methods, of order 2, are below h²·c³·v/4, with c the
// largest rate at which the speed falls: 1/s, and 0.5·|v − w| = 2.5/s in the wind.
TEST(Sliding, FrictionFeelsDampingThatPresses) {
    const double linear = 4 * std::exp(-0.3) - 1;
    for (const char* method : {"velocity_verlet", "position_verlet", "yoshida4_kdk", "exact", "rk4",
                               "implicit_midpoint"})
        for (const int rate : {60, 240}) {
            const double h = 1.0 / rate;
            EXPECT_NEAR(speed_under(LinearDrag{1}, method, rate, 2), linear, h * h * 3 / 4)
                << method << ' ' << rate;
            const Spring damped{.anchor = {0, 0.3}, .stiffness = 1e-12, .damping = 1};
            EXPECT_NEAR(speed_under(damped, method, rate, 2), linear, h * h * 3 / 4) << method;
            if (std::string_view(method) == "exact") continue;
            const Wind wind{.velocity = {0, -4}, .coefficient = 0.5};
            EXPECT_NEAR(speed_under(wind, method, rate), speed_in_wind(4), h * h * 2.5 * 2.5 * 2.5)
                << method << ' ' << rate;
        }
}

/// The error after 1 s of a ball that slides down a slope of 0.6 rad with friction 0.5, which
/// swings along its normal n by A·sin(ωt). Along it, u' = f(t) − b·u with drag b, and f = −g·sin w
/// + μ·(g·cos w − A·ω²·sin ωt + b·A·ω·cos ωt).
double error_on_swinging_slope(const char* method, int rate, double drag = 0) {
    const double angle = 0.6, mu = 0.5, amplitude = 0.2, omega = 3.7;
    const Vec3 n{-std::sin(angle), std::cos(angle)};
    const Vec3 up{std::cos(angle), std::sin(angle)};
    World world(2, Stepping{.method = &find_method(method), .rate = {rate}});
    world.set_gravity({0, -g});
    world.add_obstacle({.shape = HalfSpaceShape{n},
                        .friction = mu,
                        .swing = Swing{n * amplitude, 2 * std::numbers::pi / omega}});
    const Entity ball = world.spawn(Body{.position = n * 0.3,
                                         .velocity = n * (amplitude * omega) - up * 0.2,
                                         .contact = Contact{0.3}});
    if (drag > 0) world.attach(ball, LinearDrag{drag});
    world.step(rate);
    const auto pulled = [&](double t) {
        const double push = g * std::cos(angle) - amplitude * omega * omega * std::sin(omega * t) +
                            drag * amplitude * omega * std::cos(omega * t);
        return (mu * push - g * std::sin(angle)) * std::exp(-drag * (1 - t));
    };
    double u = -0.2 * std::exp(-drag);
    constexpr double part = 1.0 / 1000;  // Simpson's rule
    for (int i = 0; i < 1000; ++i)
        u += (pulled(i * part) + 4 * pulled((i + 0.5) * part) + pulled((i + 1) * part)) * part / 6;
    const Vec3 v = world.velocity(ball);
    return std::abs(v[0] * up[0] + v[1] * up[1] - u);
}

// The push of the slope changes within a step. By the rule of the trapezium, u is off by h²/12
// times what the push's derivative changes by in 1 s, 0.1·ω³·(1 − cos ω), by Simpson's, on
// half-steps, by h⁴/2880 times what its third derivative does.
TEST(Sliding, FrictionFeelsHowTheSurfaceAccelerates) {
    for (const int rate : {15, 60, 240}) {
        const double h = 1.0 / rate;
        const double change = 0.1 * std::pow(3.7, 3) * (1 - std::cos(3.7));
        for (const char* method : {"velocity_verlet", "exact", "rk2_heun", "implicit_midpoint"})
            EXPECT_LT(error_on_swinging_slope(method, rate), 1.01 * change * h * h / 12)
                << method << ' ' << rate;
        EXPECT_LT(error_on_swinging_slope("rk4", rate),
                  1.01 * change * 3.7 * 3.7 * std::pow(h, 4) / 2880 + 1e-13)
            << rate;
    }
}

// With drag, which presses the ball onto the slope and off it, half the step divides the error
// by 4.
TEST(Sliding, FrictionOfDragOnAnAcceleratingSurfaceHasOrderTwo) {
    for (const char* method : {"velocity_verlet", "pefrl", "exact", "implicit_midpoint"}) {
        const double coarse = error_on_swinging_slope(method, 60, 1);
        EXPECT_LT(coarse, 1e-3) << method;
        EXPECT_NEAR(coarse / error_on_swinging_slope(method, 120, 1), 4, 0.2) << method;
    }
}

// Friction far beyond what holds the ball neither throws it nor turns it round. It leaves the curve
// where its way is no longer bent enough, with the belt's speed or a little more: its energy is at
// most that on top.
TEST(Sliding, ABeltWithHugeFrictionThrowsNothing) {
    for (const double friction : {30.0, 300.0, 1e6, 1e10, 1e300})
        for (const double belt : {0.7, 1.7, 3.3})
            for (const double place : {0.3, 0.65, 0.9})
                for (const int rate : {30, 60, 240}) {
                    World world(2, Stepping{.method = &find_method("rk4"), .rate = {rate}});
                    world.set_gravity({0, -g});
                    world.add_obstacle(
                        {.shape = CircleShape{{0, 0}, 1}, .friction = friction, .belt = belt});
                    const Vec3 x = Vec3{std::sin(place), std::cos(place)} * 1.1;
                    const Entity ball = world.spawn(Body{.position = x, .contact = Contact{0.1}});
                    for (int i = 0; i < rate; ++i) {
                        world.step();
                        const Vec3 at = world.position(ball);
                        const Vec3 v = world.velocity(ball);
                        const double energy = (v[0] * v[0] + v[1] * v[1]) / 2 + g * at[1];
                        ASSERT_LT(energy, belt * belt / 2 + g * 1.1 + 0.01) << friction << belt;
                        ASSERT_GT(v[0], -0.01) << friction << ' ' << belt << ' ' << rate;
                    }
                }
}

// A wall rises with 1 m/s beside a ball that is pressed onto it with 20 m/s², and onto the floor
// with 5 m/s². Friction lifts it with 20·μ − 5 m/s² off the floor until it is as fast as the wall.
TEST(Sliding, FrictionOfARisingWallLiftsABallOffTheFloor) {
    for (const char* method : {"velocity_verlet", "rk4"})
        for (const double friction : {0.3, 0.5, 2.0}) {
            World world(2, Stepping{.method = &find_method(method), .rate = {60}});
            world.set_gravity({-20, -5});
            world.add_obstacle({.shape = HalfSpaceShape{{0, 1}}});
            world.add_obstacle(
                {.shape = HalfSpaceShape{{1, 0}}, .friction = friction, .velocity = {0, 1}});
            const Entity ball = world.spawn(Body{.position = {0.3, 0.3}, .contact = Contact{0.3}});
            world.step(60);
            const double lag = 1 / (20 * friction - 5);
            EXPECT_NEAR(world.position(ball)[1], 0.3 + 1 - lag / 2, 1e-9) << method << friction;
        }
}

}  // namespace
}  // namespace oiler::test
