// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/sampled_motion.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;
using State3 = State<Real, 3>;

constexpr std::int64_t per_second = 10;

/// Samples of cos(ωt) along y over `seconds`, of two bodies, the second at half the amplitude.
Trajectory sampled(Real omega, int seconds) {
    Trajectory trajectory{.bodies = 2};
    for (std::int64_t i = 0; i <= seconds * per_second; ++i)
        for (const Real size : {Real(1), Real(0.5)}) {
            const Real t = static_cast<Real>(i) / per_second;
            trajectory.states.push_back(
                {{0, size * std::cos(omega * t), 0}, {0, -size * omega * std::sin(omega * t), 0}});
        }
    return trajectory;
}

std::vector<State3> one_row(const Trajectory& trajectory, std::size_t row) {
    std::vector<State3> states;
    for (std::int64_t i = 0; i < trajectory.samples(); ++i) states.push_back(trajectory.at(i, row));
    return states;
}

// A polynomial of degree 7 through positions and velocities at 4 nodes is exact for t⁷, also
// between the first and between the last two.
TEST(SampledMotion, IsExactForDegreeSeven) {
    Trajectory trajectory{.bodies = 1};
    for (std::int64_t i = 0; i <= 20; ++i) {
        const Real t = static_cast<Real>(i) / per_second;
        trajectory.states.push_back({{std::pow(t, 7), 0, 0}, {7 * std::pow(t, 6), 0, 0}});
    }
    const SampledMotion motion(trajectory, per_second, 0);
    for (const Real t : {0.0L, 0.03L, 0.1L, 0.77L, 1.0L, 1.91L, 1.99L, 2.0L}) {
        EXPECT_NEAR(static_cast<double>(motion.at(0, t).x[0] - std::pow(t, 7)), 0, 1e-14);
        EXPECT_NEAR(static_cast<double>(motion.at(0, t).v[0] - 7 * std::pow(t, 6)), 0, 1e-12);
    }
}

// Two polynomials of degree 3 meet at a kink between samples: two nodes on each side hold them.
TEST(SampledMotion, KeepsApartWhatAKinkParts) {
    const Real kink = 0.94L;
    const auto state = [&](Real t) -> State3 {
        if (t < kink) return {{t * t * t, 0, 0}, {3 * t * t, 0, 0}};
        const Real s = t - kink;
        return {{kink * kink * kink - 2 * s + s * s * s, 0, 0}, {-2 + 3 * s * s, 0, 0}};
    };
    Trajectory trajectory{.bodies = 2};
    for (std::int64_t i = 0; i <= 20; ++i)
        for (int row = 0; row < 2; ++row)
            trajectory.states.push_back(state(static_cast<Real>(i) / per_second));
    const Real cube = kink * kink * kink;
    trajectory.kinks = {
        {}, {{kink, {{cube, 0, 0}, {3 * kink * kink, 0, 0}}, {{cube, 0, 0}, {-2, 0, 0}}}}};
    const SampledMotion motion(trajectory, per_second, 0);
    std::vector<State3> all(2);
    for (Real t = 0.6L; t < 1.3L; t += 0.0037L) {
        EXPECT_NEAR(static_cast<double>(motion.at(1, t).x[0] - state(t).x[0]), 0, 1e-16);
        EXPECT_NEAR(static_cast<double>(motion.at(1, t).v[0] - state(t).v[0]), 0, 1e-14);
        motion.all_at(t, all);
        EXPECT_EQ(all[1].x, motion.at(1, t).x);
        EXPECT_EQ(all[0].x, motion.at(0, t).x);
    }
    EXPECT_GT(std::abs(static_cast<double>(motion.at(0, kink).x[0] - cube)), 1e-3);
    // Only the body with the kink bends there, by no more than three times its way.
    EXPECT_EQ(motion.cubic_error(0, {}, {}, 0.9L, 1), 0);
    EXPECT_GE(motion.cubic_error(1, {}, {}, 0.9L, 1), 0.3 * 3 * 0.94 * 0.94);
    EXPECT_EQ(motion.cubic_error(1, {}, {}, 0.8L, 0.9L), 0);
    // Leaving a sample out shows no kink.
    EXPECT_LE(
        interpolation_errors({1, one_row(trajectory, 1), {trajectory.kinks[1]}}, per_second).back(),
        1e-15);
}

// The remainder is x⁽⁸⁾/8! times the squares of the distances from the nodes: in the middle
// (3/4·1/4·h²... )² of the four, (9/16)²·h⁸/40320.
TEST(SampledMotion, HasTheRemainderOfDegreeSeven) {
    const Real omega = 5;
    const SampledMotion motion(sampled(omega, 4), per_second, 0);
    const double bound = std::pow(9 / 16.0, 2) * std::pow(0.5, 8) / 40320;
    double most = 0;
    std::vector<State3> all(2);
    for (Real t = 0.2L; t < 3.8L; t += 0.0137L) {
        motion.all_at(t, all);
        const double error = static_cast<double>(std::abs(all[0].x[1] - std::cos(omega * t)));
        most = std::max(most, error);
        EXPECT_EQ(all[1].x, motion.at(1, t).x);
        EXPECT_NEAR(static_cast<double>(all[1].x[1]), 0.5 * std::cos(5 * static_cast<double>(t)),
                    bound);
    }
    EXPECT_LE(most, bound);
    EXPECT_GE(most, 0.8 * bound);
}

// π/4 at 2 1/s is 0.3927 s; at 50 1/s it is less than a sample.
TEST(SampledMotion, IsACubicOverAnEighthOfAPeriodOrASample) {
    const SampledMotion slow(sampled(1, 4), per_second, 2);
    EXPECT_EQ(slow.cubic_error(0, {}, {}, 0.2L, 0.592L), 0);
    EXPECT_TRUE(std::isinf(slow.cubic_error(0, {}, {}, 0.2L, 0.593L)));
    const SampledMotion fast(sampled(1, 4), per_second, 50);
    EXPECT_EQ(fast.cubic_error(0, {}, {}, 0.2L, 0.3L), 0);
    EXPECT_TRUE(std::isinf(fast.cubic_error(0, {}, {}, 0.2L, 0.31L)));
}

// The estimate must not be below the largest error anywhere, and not much above the one at the
// ends.
TEST(InterpolationErrors, BoundTheErrorsBetweenSamples) {
    for (const Real omega : {2.0L, 8.0L, 14.0L}) {
        const Trajectory trajectory = sampled(omega, 4);
        const SampledMotion motion(trajectory, per_second, 0);
        double most = 0;
        for (Real t = 0; t < 4; t += 0.0037L)
            most = std::max(
                most, static_cast<double>(std::abs(motion.at(0, t).x[1] - std::cos(omega * t))));
        const double told = interpolation_errors(trajectory, per_second).back();
        EXPECT_GE(told, most) << omega;
        EXPECT_LE(told, 4 * most) << omega;
    }
}

// Two samples per period resolve nothing; the estimate must be of the size of the oscillation.
TEST(InterpolationErrors, AreLargeIfNothingIsResolved) {
    EXPECT_GT(interpolation_errors(sampled(33, 4), per_second).back(), 0.5);
}

}  // namespace
}  // namespace oiler::test
