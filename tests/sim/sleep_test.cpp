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
constexpr double damping = 0.8;  // ω = 6.3/s; it fades as e^(−0.4·t)

/// Bodies fall asleep after ticks that are multiples of this.
constexpr std::int64_t interval = 64;

/// The limit that the engine states: 2²⁶ times the smallest normal number.
double limit_of(Precision precision) {
    return std::ldexp(precision == Precision::single ? double{std::numeric_limits<float>::min()}
                                                     : std::numeric_limits<double>::min(),
                      26);
}

double size_of(const Bodies& bodies) {
    return std::max(std::abs(static_cast<double>(x_of(bodies))),
                    std::abs(static_cast<double>(v_of(bodies))));
}

/// Bodies that are not asleep have a distance, a speed or an acceleration of at least the limit,
/// and |a| ≤ k·|x| + b·|v| ≤ (k + b)·size for 1 kg: 1/40.8 of the limit, 2²⁰ times the smallest
/// normal number. One part in a thousand is for roundings.
double smallest_awake(Precision precision) {
    return 0.999 * limit_of(precision) / (stiffness + damping);
}

// From 1 m the float limit is ln(1/7.9e-31)/0.4 = 173 s away, that of double 1726 s; twice that is
// enough for any method.
TEST(Rest, ComesBeforeTheSubnormalNumbers) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "exact"})
        for (const Precision precision : precisions) {
            Bodies bodies = oscillator(precision, stiffness, damping, 1);
            const double fades = -std::log(limit_of(precision)) / (damping / 2);
            for (std::int64_t tick = 0; rate.time(tick) < 2 * fades; tick += interval) {
                bodies.step(find_method(name), {rate, tick, interval});
                const double size = size_of(bodies);
                ASSERT_TRUE(size == 0 || size > smallest_awake(precision)) << name << ", " << tick;
            }
            EXPECT_EQ(size_of(bodies), 0) << name << ", " << name_of(precision);
        }
}

TEST(Rest, IsOnTheAnchor) {
    Bodies bodies(1, Precision::single);
    bodies.add({.position = {1.5}},
               Spring{.anchor = {0.375}, .stiffness = stiffness, .damping = damping});
    bodies.step(find_method("semi_implicit_euler"), {rate, 0, 100'000});
    EXPECT_EQ(x_of(bodies), 0.375L);
    EXPECT_EQ(v_of(bodies), 0);
}

// Tiny motions are possible where nothing damps them, and above the limit where something does.
TEST(Rest, LeavesTinyMotionsAlone) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies undamped = oscillator(Precision::single, stiffness, 0, std::ldexp(1, -110));
    undamped.step(method, {rate, 0, 10'000});
    EXPECT_GT(size_of(undamped), std::ldexp(1, -112));
    Bodies damped = oscillator(Precision::single, stiffness, damping, 1e-25);
    damped.step(method, {rate, 0, interval});
    EXPECT_GT(size_of(damped), 1e-26);
}

// Another force that still pulls keeps a body that turns around from being at rest.
TEST(Rest, NeedsThatNothingPulls) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -9.81, 0});
    bodies.add({}, LinearDrag{0.5});
    bodies.step(find_method("semi_implicit_euler"), {rate, interval - 1, 1});
    EXPECT_LT(bodies.velocity(0)[1], -0.1);
}

TEST(Rest, ComesAtTheSameTickInAnyNumberOfCalls) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies at_once = oscillator(Precision::single, stiffness, damping, 1e-29);
    Bodies one_by_one = at_once;
    bool moved = false;
    for (std::int64_t tick = 0; tick < 2000; ++tick) {
        one_by_one.step(method, {rate, tick, 1});
        moved = moved || size_of(one_by_one) > 0;
    }
    at_once.step(method, {rate, 0, 2000});
    EXPECT_TRUE(moved);
    EXPECT_EQ(x_of(at_once), x_of(one_by_one));
    EXPECT_EQ(v_of(at_once), v_of(one_by_one));
    EXPECT_EQ(size_of(at_once), 0);
}

}  // namespace
}  // namespace oiler::test
