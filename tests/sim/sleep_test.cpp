// SPDX-License-Identifier: MIT
// Damped bodies fall asleep before their numbers become subnormal. Undamped motion never sleeps.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/oscillator.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{60};
constexpr double stiffness = 40;
constexpr double damping = 0.8;  // ω = 6.3/s; the amplitude fades as e^(−0.4·t)

/// Bodies fall asleep after ticks that are multiples of this.
constexpr std::int64_t interval = 64;

/// The threshold of sleep: 2²⁶ times the smallest normal number.
double threshold_of(Precision precision) {
    return std::ldexp(precision == Precision::single ? double{std::numeric_limits<float>::min()}
                                                     : std::numeric_limits<double>::min(),
                      26);
}

double size_of(const Bodies& bodies) {
    return std::max(std::abs(static_cast<double>(x_of(bodies))),
                    std::abs(static_cast<double>(v_of(bodies))));
}

/// The smallest size of a body that is awake: 1/40.8 of the threshold, 2²⁰ times the smallest
/// normal number. Its distance, speed or acceleration is at least the threshold, and |a| ≤ k·|x| +
/// b·|v| ≤ (k + b)·size for 1 kg. The factor 0.999 allows for roundings.
double smallest_awake(Precision precision) {
    return 0.999 * threshold_of(precision) / (stiffness + damping);
}

// From 1 m a body reaches the threshold of float after ln(1/7.9e-31)/0.4 = 173 s, and that of
// double after 1726 s. Twice that is enough for any method.
TEST(Sleep, ComesBeforeTheSubnormalNumbers) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "exact"})
        for (const Precision precision : precisions) {
            Bodies bodies = oscillator(precision, stiffness, damping, 1);
            const double fades = -std::log(threshold_of(precision)) / (damping / 2);
            for (std::int64_t tick = 0; rate.time(tick) < 2 * fades; tick += interval) {
                bodies.step(find_method(name), {rate, tick, interval});
                const double size = size_of(bodies);
                ASSERT_TRUE(size == 0 || size > smallest_awake(precision)) << name << ", " << tick;
            }
            EXPECT_EQ(size_of(bodies), 0) << name << ", " << name_of(precision);
        }
}

TEST(Sleep, PutsTheBodyOnItsAnchor) {
    Bodies bodies(1, Precision::single);
    bodies.add({.position = {1.5}},
               Spring{.anchor = {0.375}, .stiffness = stiffness, .damping = damping});
    bodies.step(find_method("semi_implicit_euler"), {rate, 0, 100'000});
    EXPECT_EQ(x_of(bodies), 0.375L);
    EXPECT_EQ(v_of(bodies), 0);
}

// Undamped motion may be tiny, and damped motion continues above the threshold.
TEST(Sleep, DoesNotEndTinyMotions) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies undamped = oscillator(Precision::single, stiffness, 0, std::ldexp(1, -110));
    undamped.step(method, {rate, 0, 10'000});
    EXPECT_GT(size_of(undamped), std::ldexp(1, -112));
    Bodies damped = oscillator(Precision::single, stiffness, damping, 1e-25);
    damped.step(method, {rate, 0, interval});
    EXPECT_GT(size_of(damped), 1e-26);
}

// A body at a turning point has no speed, but another force still accelerates it.
TEST(Sleep, NeedsASmallAcceleration) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -9.81, 0});
    bodies.add({}, LinearDrag{0.5});
    bodies.step(find_method("semi_implicit_euler"), {rate, interval - 1, 1});
    EXPECT_LT(bodies.velocity(0)[1], -0.1);
}

TEST(Sleep, IsTheSameBesideLinkedBodies) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4"}) {
        Bodies alone = oscillator(Precision::single, stiffness, damping, 1e-29);
        Bodies beside = alone;
        beside.add({.position = {3}, .velocity = {1}});
        beside.add({.position = {5}});
        beside.link(1, 2, {.stiffness = 5, .rest_length = 1});
        bool moved = false;
        for (std::int64_t tick = 0; tick < 2000; ++tick) {
            for (Bodies* bodies : {&alone, &beside})
                bodies->step(find_method(name), {rate, tick, 1});
            moved = moved || size_of(alone) > 0;
            ASSERT_EQ(x_of(beside), x_of(alone)) << name << ", " << tick;
            ASSERT_EQ(v_of(beside), v_of(alone)) << name << ", " << tick;
        }
        EXPECT_TRUE(moved) << name;
        EXPECT_EQ(size_of(alone), 0) << name;
    }
}

// The speed of both bodies fades as e^(−b·t/m). From 1 m/s it is subnormal in float after 109 s.
// Their positions stay between 4 and 8 m, where floats have one spacing, so the link exerts no
// force.
TEST(Sleep, ComesToLinkedBodiesWithDrag) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4"}) {
        Bodies bodies(1, Precision::single);
        for (const double x : {5, 6})
            bodies.add({.position = {x}, .velocity = {1}}, LinearDrag{damping});
        bodies.link(0, 1, {.stiffness = stiffness, .rest_length = 1});
        for (std::int64_t tick = 0; rate.time(tick) < 120; ++tick) {
            bodies.step(find_method(name), {rate, tick, 1});
            for (std::size_t row : {0, 1}) {
                const auto speed = static_cast<double>(std::abs(v_of(bodies, row)));
                ASSERT_TRUE(speed == 0 || speed > std::numeric_limits<float>::min())
                    << name << ", " << tick;
            }
        }
        EXPECT_EQ(v_of(bodies, 0), 0) << name;
        EXPECT_EQ(v_of(bodies, 1), 0) << name;
    }
}

TEST(Sleep, DoesNotDependOnTheStepsPerCall) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies one_call = oscillator(Precision::single, stiffness, damping, 1e-29);
    Bodies one_by_one = one_call;
    bool moved = false;
    for (std::int64_t tick = 0; tick < 2000; ++tick) {
        one_by_one.step(method, {rate, tick, 1});
        moved = moved || size_of(one_by_one) > 0;
    }
    one_call.step(method, {rate, 0, 2000});
    EXPECT_TRUE(moved);
    EXPECT_EQ(x_of(one_call), x_of(one_by_one));
    EXPECT_EQ(v_of(one_call), v_of(one_by_one));
    EXPECT_EQ(size_of(one_call), 0);
}

}  // namespace
}  // namespace oiler::test
