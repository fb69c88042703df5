// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/samples.hpp"

#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;

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

}  // namespace
}  // namespace oiler::test
