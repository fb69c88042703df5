// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/samples.hpp"
#include "lab/motions.hpp"
#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/reference/sampled_motion.hpp"
#include "oiler/lab/reference/scales.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

Scene falling(std::int64_t rate, double duration, std::int64_t bodies = 1) {
    Scene scene;
    scene.stepping.rate.steps = rate;
    scene.duration = duration;
    scene.gravity = {-9.81, 0, 0};
    scene.scatters = {{.count = bodies}};
    return scene;
}

Bodies start_of(const Scene& scene) { return make_world(scene, Settings{scene.stepping}).bodies(); }
SampleTimes samples_of(const Scene& scene, const Density& density = {}) {
    return sample_times_of(scene, start_of(scene), density);
}

Scene oscillating(double stiffness, double duration, double damping = 0) {
    Scene scene;
    scene.duration = duration;
    scene.bodies = {{.position = {1, 0, 0}}};
    scene.springs = {{.stiffness = stiffness, .damping = damping}};
    return scene;
}

constexpr double pi = std::numbers::pi;

TEST(SampleTimesOf, AreSixtyPerSecondForSlowMotion) {
    EXPECT_EQ(samples_of(falling(60, 10)), (SampleTimes{60, 601}));
    EXPECT_EQ(samples_of(oscillating(15, 10)), (SampleTimes{60, 601}));
}

TEST(SampleTimesOf, AreTwentyInAShortScene) {
    EXPECT_EQ(samples_of(falling(60, 0.01)), (SampleTimes{2000, 21}));
}

TEST(SampleTimesOf, CoverASceneThatEndsBetweenTwo) {
    EXPECT_EQ(samples_of(falling(60, 1.99)), (SampleTimes{60, 121}));
    // 2.05·60 and 0.58·60 are 123 and 34.8.
    EXPECT_EQ(samples_of(falling(60, 2.05)), (SampleTimes{60, 124}));
    EXPECT_EQ(samples_of(falling(60, 0.58)), (SampleTimes{60, 36}));
}

// 48 samples per period: of an oscillation of 100 Hz, and of a damper whose rate of decay, 1000
// 1/s, is larger than its frequency, √10 1/s.
TEST(SampleTimesOf, ResolveTheFastestMotion) {
    EXPECT_EQ(samples_of(oscillating(std::pow(200 * pi, 2), 1)).per_second, 4800);
    EXPECT_EQ(samples_of(oscillating(10, 1, 1000)).per_second, std::llround(48 * 1000 / (2 * pi)));
}

// A body that starts at the aphelion of an orbit is fastest at the perihelion: gm = 1, e = 0.6,
// 0.4 m away from the attractor, where a circle would take 2π·0.4^1.5 s.
TEST(SampleTimesOf, ResolveTheClosestPointOfAnOrbit) {
    Scene scene;
    scene.axes = 2;
    scene.duration = 1;
    scene.bodies = {{.position = {1.6e-2, 0, 0}, .velocity = {0, 5, 0}}};
    scene.attractors = {{.gm = 1}};
    EXPECT_NEAR(static_cast<double>(samples_of(scene).per_second),
                48 / (2 * pi * std::pow(0.4e-2, 1.5)), 1);
}

// A body of 20 m/s with 0.5 1/m of quadratic drag slows down at 2·0.5·20 = 20 1/s. One that falls
// from rest is damped by 2·√(c·g) at its terminal speed √(g/c).
TEST(SampleTimesOf, ResolveQuadraticDrag) {
    Scene scene = falling(60, 1);
    scene.scatters.clear();
    scene.bodies = {{.matter = {.quadratic_drag = 0.5}, .velocity = {20, 0, 0}}};
    EXPECT_EQ(samples_of(scene).per_second, std::llround(48 * 20 / (2 * pi)));
    scene.bodies = {{.matter = {.quadratic_drag = 100}}};
    EXPECT_EQ(samples_of(scene).per_second, std::llround(48 * 2 * std::sqrt(981) / (2 * pi)));
}

// 1.5 million states are kept: 1000 bodies have 1500 samples in 50 s.
TEST(SampleTimesOf, FitIntoMemory) {
    EXPECT_EQ(samples_of(falling(60, 50, 1000), {.bodies = 1000}).per_second, 30);
    EXPECT_EQ(samples_of(falling(60, 50, 1000)).per_second, 60);
}

TEST(SampleTimesOf, AreNoMoreThanAskedFor) {
    EXPECT_EQ(samples_of(falling(60, 10), {.most_per_second = 7.4}).per_second, 7);
    EXPECT_EQ(samples_of(oscillating(std::pow(200 * pi, 2), 1), {.per_period = 12}).per_second,
              1200);
}

TEST(SampleTimesOf, HasTheTimeOfEachSample) {
    const SampleTimes samples{.per_second = 60, .count = 601};
    EXPECT_EQ(samples.time(600), 10);
}

TEST(RequireMeasurable, RefusesScenesThatAreTooLargeOrTooLong) {
    const auto refusal = [](const Scene& scene) {
        return line_of_error(Exit::usage, [&] { require_measurable(scene); });
    };
    EXPECT_TRUE(holds(refusal(falling(60, 10, 100'001)), "100001 bodies"));
    EXPECT_TRUE(holds(refusal(falling(60, 100'001)), "a duration of 100001 s"));
    EXPECT_TRUE(holds(refusal(falling(60, 0)), "give --duration"));
    EXPECT_TRUE(holds(refusal(falling(60, NAN)), "give --duration"));
    require_measurable(falling(10, 0.05));
}

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
    EXPECT_EQ(motion.cubic_error(1, {}, {}, 0.9L, kink), 0);
    EXPECT_EQ(motion.cubic_error(1, {}, {}, kink, 1), 0);
    // Leaving a sample out shows no kink.
    EXPECT_LE(
        interpolation_errors({1, one_row(trajectory, 1), {trajectory.kinks[1]}}, per_second, false)
            .back(),
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
        const double told = interpolation_errors(trajectory, per_second, false).back();
        EXPECT_GE(told, most) << omega;
        EXPECT_LE(told, 4 * most) << omega;
    }
}

// A body of 1 m/s that friction of 2 m/s² stops somewhere among the samples, also near the ends.
TEST(InterpolationErrors, BoundThoseBesideAStop) {
    constexpr std::int64_t samples = 30;
    const auto spacing = 1 / Real(per_second);
    for (Real start = -0.5L; start < 2.5L; start += 0.0137L) {
        const auto state = [&](Real t) {
            const Real slid = std::clamp(t - start, Real(0), Real(0.5L));
            return State3{{std::min(t - start, Real(0)) + slid - slid * slid, 0, 0},
                          {1 - 2 * slid, 0, 0}};
        };
        Trajectory trajectory{.bodies = 1};
        for (std::int64_t i = 0; i < samples; ++i)
            trajectory.states.push_back(state(Real(i) * spacing));
        const SampledMotion motion(trajectory, per_second, 0);
        double most = 0;
        for (Real t = 0; t < Real(samples - 1) * spacing; t += 0.0037L)
            most =
                std::max(most, static_cast<double>(std::abs(motion.at(0, t).x[0] - state(t).x[0])));
        EXPECT_GE(interpolation_errors(trajectory, per_second, true).back(), most)
            << static_cast<double>(start);
    }
}

// Two samples per period resolve nothing; the estimate must be of the size of the oscillation.
TEST(InterpolationErrors, AreLargeIfNothingIsResolved) {
    EXPECT_GT(interpolation_errors(sampled(33, 4), per_second, false).back(), 0.5);
}

// Straight lines, a second each. The body dips into the band but not below it after its first
// crossing of 0.
TEST(UpwardCrossings, AreFromBelowTheBand) {
    const Path path{.t = {0, 1, 2, 3, 4, 5}, .x = {-1, 1, -0.0625, 1, -1, 1}};
    const std::vector<double> crossings = upward_crossings(path, 0, 0.125);
    ASSERT_EQ(crossings.size(), 2U);
    EXPECT_NEAR(crossings[0], 0.5, 1e-15);
    EXPECT_NEAR(crossings[1], 4.5, 1e-15);
}

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

// A body that slides on a slope of 3:4 must not bounce, and one above the slope stays above it.
TEST(PerturbedStarts, StayOnTheirPlanes) {
    const Scene scene = parse_scene(
        "[scene]\naxes = 2\n[gravity]\nacceleration = [0.0, -9.81]\n"
        "[[plane]]\nnormal = [3.0, 4.0]\noffset = 5.0\n"
        "[[body]]\nposition = [0.75, 1.0]\nvelocity = [4.0, -3.0]\ncontact = 0.25\n"
        "[[body]]\nposition = [0.7501, 1.0]\nvelocity = [0.0, 1.0]\ncontact = 0.25\n",
        "test");
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const World world = make_world(scene, Settings{}, {seed, 0.01, 0.02});
        const auto gap = [&](std::size_t row) {
            const Vec3 x = world.bodies().position(row);
            return 0.6 * x[0] + 0.8 * x[1] - 1.25;
        };
        const Vec3 v = world.bodies().velocity(0);
        EXPECT_NEAR(gap(0), 0, 1e-15);
        EXPECT_NEAR(0.6 * v[0] + 0.8 * v[1], 0, 1e-15);
        EXPECT_NE(v[0], 4);
        EXPECT_GE(gap(1), -1e-15);
        EXPECT_NE(world.bodies().velocity(1)[0], 0);
    }
}

// The first body touches the circle, the second could get into it: both stay where they are. The
// third, which passes through obstacles, and the fourth, which is far, are moved.
TEST(PerturbedStarts, StayOutOfObstacles) {
    const std::string circle =
        "[[obstacle]]\nshape = 'circle'\ncentre = [0.0, 0.0]\nradius = 1.0\n";
    const Scene scene =
        parse_scene("[scene]\naxes = 2\n[gravity]\nacceleration = [0.0, -9.81]\n" + circle +
                        "[[body]]\nposition = [0.75, 1.0]\ncontact = 0.25\n"
                        "[[body]]\nposition = [1.251, 0.0]\ncontact = 0.25\n"
                        "[[body]]\nposition = [0.0, 1.0]\n"
                        "[[body]]\nposition = [2.0, 0.0]\ncontact = 0.25\n",
                    "test");
    int pushed = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const World world = make_world(scene, Settings{}, {seed, 0.01, 0.02});
        const auto at = [&](std::size_t row) { return world.bodies().position(row); };
        EXPECT_EQ(at(0), (Vec3{0.75, 1}));
        EXPECT_EQ(world.bodies().velocity(0), Vec3{});
        EXPECT_GE(std::hypot(at(1)[0], at(1)[1]), 1.25);
        pushed += at(1) == Vec3{1.251, 0};
        EXPECT_NE(at(2), (Vec3{0, 1}));
        EXPECT_NE(at(3), (Vec3{2, 0}));
    }
    EXPECT_GT(pushed, 4);
    EXPECT_LT(pushed, 16);
}

TEST(Conservative, AreObstaclesThatStandAndTakeNothing) {
    const Obstacle elastic{.shape = CircleShape{{0, 0}, 1}, .restitution = 1};
    const auto conserve = [](const Obstacle& obstacle, bool meets = true) {
        Bodies bodies(2, Precision::double_);
        bodies.add_plane({.normal = {0, 1}, .offset = -5, .restitution = 1});
        bodies.add_obstacle(obstacle);
        bodies.add(
            {.position = {0, 4}, .contact = meets ? std::optional(Contact{}) : std::nullopt});
        return is_conservative(bodies);
    };
    const auto with = [&](auto change) {
        Obstacle changed = elastic;
        change(changed);
        return changed;
    };
    EXPECT_TRUE(conserve(elastic));
    const std::vector<Obstacle> lossy{with([](Obstacle& one) { one.restitution = 0.9; }),
                                      with([](Obstacle& one) { one.friction = 0.1; }),
                                      with([](Obstacle& one) { one.belt = 1; }),
                                      with([](Obstacle& one) {
                                          one.velocity = {1, 0};
                                      }),
                                      with([](Obstacle& one) {
                                          one.swing = Swing{{1, 0}};
                                      })};
    for (const Obstacle& one : lossy) {
        EXPECT_FALSE(conserve(one));
        EXPECT_TRUE(conserve(one, false)) << "nobody meets it";
    }
}

}  // namespace
}  // namespace oiler::test
