// SPDX-License-Identifier: MIT
#include "lab/motions.hpp"
#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/lab/reference/path.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A reference of these motions that is meaningful up to its last sample.
Reference reference_of(const Motions& motions, const SampleTimes& samples) {
    Reference reference;
    reference.motion = std::make_shared<ExactMotions>(motions);
    reference.samples = samples;
    reference.meaningful_until = samples.time(samples.count - 1);
    return reference;
}

// The error of Hermite's cubic is at most (ω/60)⁴/384 of the amplitude. A crossing's error is that
// times 1/ω over the cosine of the phase there; the period's is two of these over their number.
TEST(FindOscillation, HasTheSpringsPeriod) {
    const SampleTimes samples{.per_second = 60, .count = 20 * 60 + 1};
    const double omega = std::sqrt(15.0);
    const auto oscillation = find_oscillation(reference_of({article_motion(0)}, samples));
    ASSERT_TRUE(oscillation);
    ASSERT_EQ(oscillation->crossings.size(), 12U);
    EXPECT_EQ(oscillation->row, 0U);
    EXPECT_EQ(oscillation->axis, 0);
    // The part of the last period shifts the mean, as does one more sample.
    EXPECT_LE(std::abs(oscillation->level), 1000 * (1 / omega / 20 + 1 / 1201.0));
    const double phase = std::asin(oscillation->level / 1000);
    const double bound = std::pow(omega / 60, 4) / 384 / std::cos(phase) / omega;
    EXPECT_NEAR(oscillation->period, 2 * std::numbers::pi / omega, 2 * bound / 11);
    // Upward crossings: sin(ωt − π/2) = level/1000, the first after a quarter period.
    for (std::size_t i = 0; i < 12; ++i)
        EXPECT_NEAR(oscillation->crossings[i],
                    (std::numbers::pi * (2 * static_cast<double>(i) + 1.5) + phase) / omega, bound)
            << i;
}

// With damping the level becomes a larger fraction of the amplitude; crossings shift by its
// arcsine.
TEST(FindOscillation, HasTheDampedSpringsPeriod) {
    const SampleTimes samples{.per_second = 50, .count = 10 * 50 + 1};
    const double omega = std::sqrt(15 - 0.0025);
    const auto oscillation = find_oscillation(reference_of({article_motion(0.1L)}, samples));
    ASSERT_TRUE(oscillation);
    const double amplitude = 1000 * std::exp(-0.05 * 10);
    const double shift = std::asin(std::abs(oscillation->level) / amplitude) / omega;
    EXPECT_NEAR(oscillation->period, 2 * std::numbers::pi / omega,
                shift / static_cast<double>(oscillation->crossings.size() - 1));
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

TEST(FindOscillation, IsOfTheCoordinateWithTheLargestRange) {
    const SampleTimes samples{.per_second = 60, .count = 601};
    const Reference reference =
        reference_of({turned_to(0, 1, 2), turned_to(2, 3, 4), turned_to(1, 2, 3)}, samples);
    const auto widest = find_oscillation(reference);
    ASSERT_TRUE(widest);
    EXPECT_EQ(widest->row, 1U);
    EXPECT_EQ(widest->axis, 2);
    EXPECT_NEAR(widest->period, std::numbers::pi / 2, 1e-5);
    const auto only = find_oscillation(reference, 2);
    ASSERT_TRUE(only);
    EXPECT_EQ(only->row, 2U);
    EXPECT_EQ(only->axis, 1);
    EXPECT_NEAR(only->period, 2 * std::numbers::pi / 3, 1e-5);
}

TEST(FindOscillation, IsNoneOfAProjectile) {
    const SampleTimes samples{.per_second = 60, .count = 301};
    const ExactMotion thrown = [](Real t) {
        return State3{{20 * t, 20 * t - 5 * t * t, 0}, {20, 20 - 10 * t, 0}};
    };
    EXPECT_FALSE(find_oscillation(reference_of({thrown}, samples)));
    const ExactMotion at_rest = [](Real) { return along_x(3, 0); };
    EXPECT_FALSE(find_oscillation(reference_of({at_rest}, samples)));
}

// From the widest point, a cosine crosses 0 downwards and upwards twice in two periods: a cycle of
// each. 7 samples per period are too few, 9 are enough.
TEST(FindOscillation, IsNoneForTooFewPeriodsOrSamples) {
    const SampleTimes samples{.per_second = 60, .count = 601};
    const auto found = [&](Real period) {
        const Real omega = 2 * std::numbers::pi_v<Real> / period;
        return find_oscillation(reference_of({turned_to(0, 1, omega)}, samples)).has_value();
    };
    EXPECT_TRUE(found(4.9L));
    EXPECT_FALSE(found(5.8L));
    EXPECT_TRUE(found(9 / 60.0L));
    EXPECT_FALSE(found(7 / 60.0L));
}

}  // namespace
}  // namespace oiler::test
