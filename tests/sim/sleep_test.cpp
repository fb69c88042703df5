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
