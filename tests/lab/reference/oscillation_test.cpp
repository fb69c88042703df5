// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "lab/motions.hpp"
#include "oiler/lab/reference/parts.hpp"

namespace {

using oiler::lab::ExactMotion;
using oiler::lab::find_swing;
using oiler::lab::Looks;
using oiler::lab::Track;
using oiler::test::along_x;
using oiler::test::article_motion;
using oiler::test::Motions;
using oiler::test::Real;
using oiler::test::State3;

Track track_of(const Motions& motions, const Looks& looks) {
    Track track{.bodies = motions.size()};
    for (std::int64_t look = 0; look < looks.count; ++look)
        for (const ExactMotion& motion : motions)
            track.states.push_back(
                motion(static_cast<Real>(look) / static_cast<Real>(looks.per_second)));
    return track;
}

// Hermite's cubic is off by (ω/60)⁴/384 of the amplitude, at most; a crossing of the level by as
// much of 1/ω over the cosine of the phase there, and the period by two of these over their number.
TEST(FindSwing, HasTheSpringsPeriod) {
    const Looks looks{.per_second = 60, .count = 20 * 60 + 1};
    const double omega = std::sqrt(15.0);
    const auto swing = find_swing(track_of({article_motion(0)}, looks), looks);
    ASSERT_TRUE(swing);
    ASSERT_EQ(swing->crossings.size(), 12U);
    EXPECT_EQ(swing->row, 0U);
    EXPECT_EQ(swing->axis, 0);
    // What the part of the last period adds to the mean, and a look more than there are.
    EXPECT_LE(std::abs(swing->level), 1000 * (1 / omega / 20 + 1 / 1201.0));
    const double phase = std::asin(swing->level / 1000);
    const double bound = std::pow(omega / 60, 4) / 384 / std::cos(phase) / omega;
    EXPECT_NEAR(swing->period, 2 * std::numbers::pi / omega, 2 * bound / 11);
    // Upwards: sin(ωt − π/2) = level/1000, first after half a period less a quarter.
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_NEAR(swing->crossings[i],
                    (std::numbers::pi * (2 * static_cast<double>(i) + 1.5) + phase) / omega, bound)
            << i;
}

// Damping makes the level a growing part of the amplitude: crossings shift by its arc sine.
TEST(FindSwing, HasTheDampedSpringsPeriod) {
    const Looks looks{.per_second = 50, .count = 10 * 50 + 1};
    const double omega = std::sqrt(15 - 0.0025);
    const auto swing = find_swing(track_of({article_motion(0.1L)}, looks), looks);
    ASSERT_TRUE(swing);
    const double amplitude = 1000 * std::exp(-0.05 * 10);
    const double shift = std::asin(std::abs(swing->level) / amplitude) / omega;
    EXPECT_NEAR(swing->period, 2 * std::numbers::pi / omega,
                shift / static_cast<double>(swing->crossings.size() - 1));
    EXPECT_LE(shift, 0.02);
}

ExactMotion turned_to(int axis, Real size, Real omega) {
    return [=](Real t) {
        State3 state{};
        state.x[axis] = 5 - size * std::cos(omega * t);
        state.v[axis] = size * omega * std::sin(omega * t);
        return state;
    };
}

TEST(FindSwing, IsOfWhatMovesMost) {
    const Looks looks{.per_second = 60, .count = 601};
    const Track track =
        track_of({turned_to(0, 1, 2), turned_to(2, 3, 4), turned_to(1, 2, 3)}, looks);
    const auto widest = find_swing(track, looks);
    ASSERT_TRUE(widest);
    EXPECT_EQ(widest->row, 1U);
    EXPECT_EQ(widest->axis, 2);
    EXPECT_NEAR(widest->period, std::numbers::pi / 2, 1e-5);
    const auto only = find_swing(track, looks, 2);
    ASSERT_TRUE(only);
    EXPECT_EQ(only->row, 2U);
    EXPECT_EQ(only->axis, 1);
    EXPECT_NEAR(only->period, 2 * std::numbers::pi / 3, 1e-5);
}

TEST(FindSwing, IsNoneOfAProjectile) {
    const Looks looks{.per_second = 60, .count = 301};
    const ExactMotion thrown = [](Real t) {
        return State3{{20 * t, 20 * t - 5 * t * t, 0}, {20, 20 - 10 * t, 0}};
    };
    EXPECT_FALSE(find_swing(track_of({thrown}, looks), looks));
    const ExactMotion at_rest = [](Real) { return along_x(3, 0); };
    EXPECT_FALSE(find_swing(track_of({at_rest}, looks), looks));
}

// Two swings have two crossings; 7 looks to a swing are too few, 9 are enough.
TEST(FindSwing, IsNoneOfWhatSwingsTooSeldomOrTooFast) {
    const Looks looks{.per_second = 60, .count = 601};
    const auto found = [&](Real period) {
        const Real omega = 2 * std::numbers::pi_v<Real> / period;
        return find_swing(track_of({turned_to(0, 1, omega)}, looks), looks).has_value();
    };
    EXPECT_TRUE(found(3.1L));
    EXPECT_FALSE(found(5.0L));
    EXPECT_TRUE(found(9 / 60.0L));
    EXPECT_FALSE(found(7 / 60.0L));
}

}  // namespace
