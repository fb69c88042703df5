// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "support/oscillator.hpp"
#include "support/text.hpp"

namespace {

using oiler::Exit;
using oiler::Scene;
using oiler::lab::sample_times_of;
using oiler::lab::SampleTimes;
using oiler::test::holds;
using oiler::test::line_of_error;

Scene falling(std::int64_t rate, double duration, std::int64_t bodies = 1) {
    Scene scene;
    scene.stepping.rate.steps = rate;
    scene.duration = duration;
    scene.gravity = {-9.81, 0, 0};
    scene.scatters = {{.count = bodies}};
    return scene;
}

struct SampleTimesCase {
    std::int64_t rate;
    double duration;
    std::int64_t bodies;
    std::int64_t per_second;
    std::int64_t count;
};

// The divisor nearest to 60; about 20 samples of a short scene; at most 400,000 states.
TEST(SampleTimesOf, AreADivisorOfTheRateOrAMultipleOfALowOne) {
    for (const SampleTimesCase& c :
         {SampleTimesCase{60, 10, 1, 60, 601},
          {100, 90, 1, 50, 4501},
          {1000, 17, 1, 50, 851},
          {120, 2.5, 1, 60, 151},
          {61, 3, 1, 61, 184},
          {15, 2, 1, 15, 31},
          {14, 2, 1, 56, 113},
          {7, 2, 1, 63, 127},
          {1, 5, 1, 60, 301},
          // A prime without a divisor near 60.
          {997, 1, 1, 60, 61},
          // The scene ends between two samples.
          {60, 1.99, 1, 60, 120},
          {500, 12.566, 1, 50, 629},
          // 2.05·60 and 0.58·50 are less than 123 and 29 in double.
          {60, 2.05, 1, 60, 124},
          {100, 0.58, 1, 50, 30},
          {60, 0.3, 1, 60, 19},
          // A short scene has more than 60 samples per second.
          {1000, 0.1, 1, 200, 21},
          {1000, 0.29, 1, 50, 15},

          {1'000'000, 1e-5, 1, 1'000'000, 11},
          // Many bodies: 400,000/1000/10 = 40, and the divisors are 20 and 25.
          {60, 10, 1000, 30, 301},
          {100, 10, 1000, 25, 251},
          {60, 10, 100'000, 1, 11},
          {60, 100'000, 1, 4, 400'001}}) {
        const SampleTimes samples = sample_times_of(falling(c.rate, c.duration, c.bodies));
        EXPECT_EQ(samples, (SampleTimes{c.per_second, c.count}))
            << c.rate << " Hz, " << c.duration << " s";
        EXPECT_EQ(samples.meet_steps(c.rate), c.rate >= 15 && c.rate != 997) << c.rate << " Hz";
    }
}

TEST(SampleTimesOf, HasTheTimeOfEachSample) {
    const SampleTimes samples{.per_second = 60, .count = 601};
    EXPECT_EQ(samples.time(600), 10);
    EXPECT_TRUE(samples.meet_steps(120));
    EXPECT_FALSE(samples.meet_steps(90));
    EXPECT_FALSE(samples.meet_steps(30));
}

TEST(SampleTimesOf, RefusesScenesThatAreTooLargeOrTooLong) {
    const auto refusal = [](const Scene& scene) {
        return line_of_error(Exit::usage, [&] { (void)sample_times_of(scene); });
    };
    EXPECT_TRUE(holds(refusal(falling(60, 10, 100'001)), "100001 bodies"));
    EXPECT_TRUE(holds(refusal(falling(60, 100'001)), "a duration of 100001 s"));
    EXPECT_TRUE(holds(refusal(falling(60, 0)), "give --duration"));
    EXPECT_TRUE(holds(refusal(falling(60, NAN)), "give --duration"));
    EXPECT_TRUE(holds(refusal(falling(10, 0.05)), "within one of its steps"));
}

}  // namespace
