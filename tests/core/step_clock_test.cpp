// SPDX-License-Identifier: MIT
#include "oiler/core/step_clock.hpp"

#include <random>

#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::int64_t frames_in_an_hour = std::int64_t{144} * 3600;

/// The time of frame i of a 144 Hz display, to the nearest nanosecond.
nanoseconds frame_at_144_hz(std::int64_t i) { return nanoseconds{(i * 1'000'000'000 + 72) / 144}; }

/// Advances through an hour of frames and returns the number of steps.
std::int64_t run_an_hour(StepClock& clock) {
    const std::int64_t before = clock.ticks();
    for (std::int64_t i = 0; i <= frames_in_an_hour; ++i) clock.advance(frame_at_144_hz(i));
    return clock.ticks() - before;
}

TEST(StepClock, AnHourAt144HzLosesNoStep) {
    StepClock clock(60);
    EXPECT_EQ(run_an_hour(clock), 216'000);
    EXPECT_EQ(clock.alpha(), 0);
    EXPECT_EQ(clock.dropped_time(), 0ns);
}

TEST(StepClock, CatchesUpLessOfALateFrameIfToldTo) {
    StepClock clock(100);
    clock.advance(0ns);
    EXPECT_EQ(clock.advance(200ms).steps, 20);
    clock.set_longest_frame(30ms);
    const auto late = clock.advance(400ms);
    EXPECT_EQ(late.steps, 3);
    EXPECT_EQ(late.dropped, 170ms);
    clock.set_longest_frame(250ms);
    EXPECT_EQ(clock.advance(500ms).steps, 10);
}

TEST(StepClock, TheFirstStampOnlyStartsTheClock) {
    StepClock clock(60);
    const auto first = clock.advance(5h);
    EXPECT_EQ(first.steps, 0);
    EXPECT_EQ(first.dropped, 0ns);
    EXPECT_EQ(first.backward, 0ns);
}

TEST(StepClock, AQuarterOfASecondAt100HzIsAlways25Steps) {
    StepClock clock(100);
    clock.advance(0ns);
    for (int i = 1; i <= 100'000; ++i) ASSERT_EQ(clock.advance(i * 250ms).steps, 25);
}

TEST(StepClock, ThreeTenthsOfASecondAt10HzAre3Steps) {
    StepClock clock(10, 1s);
    clock.advance(0ns);
    EXPECT_EQ(clock.advance(300ms).steps, 3);
}

TEST(StepClock, ContinuesWhereAFloatClockStops) {
    constexpr nanoseconds when = 524'288s;
    StepClock clock(60);
    clock.advance(when);
    for (int i = 1; i <= 60; ++i) clock.advance(when + nanoseconds{i * 1'000'000'000LL / 60});
    EXPECT_EQ(clock.ticks(), 60);
}

TEST(StepClock, AStallIsCutAndReported) {
    StepClock clock(60);
    clock.advance(0ns);
    const auto stall = clock.advance(5s);
    EXPECT_EQ(stall.steps, 15);
    EXPECT_EQ(stall.dropped, 4750ms);
    EXPECT_EQ(clock.advance(5s + 100ms).dropped, 0ns);
    EXPECT_EQ(clock.dropped_time(), 4750ms);
}

TEST(StepClock, ASuspendedLaptopIsOneLateFrameAtTheLargestRateToo) {
    StepClock clock(StepClock::largest_rate, 1s);
    clock.set_time_scale(1000, 1);
    clock.advance(1ns);
    const auto woken = clock.advance(240h + 1ns);
    EXPECT_EQ(woken.steps, 1'000'000'000);
    EXPECT_EQ(woken.dropped, 240h - 1s);
}

TEST(StepClock, ABackwardJumpOwesNothingAndRestarts) {
    StepClock clock(100);
    clock.advance(10s);
    clock.advance(10s + 5ms);
    const auto jump = clock.advance(7s);
    EXPECT_EQ(jump.steps, 0);
    EXPECT_EQ(jump.backward, 3005ms);
    EXPECT_EQ(jump.dropped, 0ns);
    EXPECT_EQ(clock.alpha(), 0.5);
    EXPECT_EQ(clock.advance(7s + 5ms).steps, 1);
}

TEST(StepClock, APauseIsNeitherSimulatedNorDropped) {
    StepClock clock(100);
    clock.advance(0s);
    clock.advance(15ms);
    clock.pause();
    EXPECT_TRUE(clock.paused());
    EXPECT_EQ(clock.advance(1h).steps, 0);
    clock.resume();
    EXPECT_FALSE(clock.paused());
    EXPECT_EQ(clock.advance(2h).steps, 0);
    EXPECT_EQ(clock.alpha(), 0.5);
    EXPECT_EQ(clock.advance(2h + 5ms).steps, 1);
    EXPECT_EQ(clock.dropped_time(), 0ns);
}

TEST(StepClock, ResumingARunningClockChangesNothing) {
    StepClock clock(100);
    clock.advance(0s);
    clock.resume();
    EXPECT_EQ(clock.advance(10ms).steps, 1);
}

TEST(StepClock, ASingleStepIsOneStepAndKeepsAlpha) {
    StepClock clock(100);
    clock.advance(0s);
    clock.advance(7ms);
    const double alpha = clock.alpha();
    clock.pause();
    clock.single_step();
    EXPECT_EQ(clock.advance(1s).steps, 1);
    EXPECT_EQ(clock.advance(2s).steps, 0);
    EXPECT_EQ(clock.ticks(), 1);
    EXPECT_EQ(clock.alpha(), alpha);
    EXPECT_GT(alpha, 0);
}

TEST(StepClock, APendingSingleStepEndsWithThePause) {
    StepClock clock(100);
    clock.advance(0s);
    clock.pause();
    clock.single_step();
    clock.resume();
    EXPECT_EQ(clock.advance(1s).steps, 0);
    clock.pause();
    EXPECT_EQ(clock.advance(2s).steps, 0);
    EXPECT_EQ(clock.ticks(), 0);
}

TEST(StepClock, TwoPressesWithinAFrameAreOneSingleStep) {
    StepClock clock(100);
    clock.advance(0s);
    clock.pause();
    clock.single_step();
    clock.single_step();
    EXPECT_EQ(clock.advance(1s).steps, 1);
    EXPECT_EQ(clock.advance(2s).steps, 0);
}

TEST(StepClock, TimeScalesAreExactOverAnHour) {
    const auto steps_at_scale = [](int numerator, int denominator) {
        StepClock clock(60);
        clock.set_time_scale(numerator, denominator);
        return run_an_hour(clock);
    };
    EXPECT_EQ(steps_at_scale(1, 2), 108'000);
    EXPECT_EQ(steps_at_scale(2, 1), 432'000);
    EXPECT_EQ(steps_at_scale(1, 3), 72'000);
    EXPECT_EQ(steps_at_scale(0, 1), 0);
    EXPECT_EQ(steps_at_scale(6, 2), 648'000);
}

TEST(StepClock, ChangingTheScaleKeepsTheRemainder) {
    StepClock clock(1);
    clock.advance(0s);
    clock.advance(1ns);
    for (const auto& [numerator, denominator] : {std::pair{1, 3}, {2, 1}, {1, 4}, {0, 1}, {1, 1}}) {
        clock.set_time_scale(numerator, denominator);
        const auto [parts, whole] = clock.remainder();
        EXPECT_EQ(parts * 1'000'000'000, whole) << numerator << '/' << denominator;
    }
}

TEST(StepClock, ScalesWithoutACommonDenominatorNeverGainOrLoseAStep) {
    StepClock clock(1);
    clock.advance(0s);
    for (int i = 1; i <= 4; ++i) clock.advance(i * 250ms - 1ns);
    ASSERT_EQ(clock.ticks(), 0);
    for (const int denominator : {997, 991, 983, 977, 1}) {
        clock.set_time_scale(1, denominator);
        EXPECT_LT(clock.alpha(), 1);
        EXPECT_GT(clock.alpha(), 1 - 7e-9);
    }
    EXPECT_EQ(clock.advance(1s + 6ns).steps, 1);
}

/// The duration of a frame of a real display; stalls and backward jumps occur too.
nanoseconds random_frame(std::mt19937_64& random) {
    switch (random() % 8) {
        case 0:
            return nanoseconds{static_cast<std::int64_t>(random() % 20'000'000'000)};
        case 1:
            return -nanoseconds{static_cast<std::int64_t>(random() % 1'000'000'000)};
        default:
            return nanoseconds{static_cast<std::int64_t>(random() % 40'000'000)};
    }
}

// The number of steps is that of the total kept time, each stretch at its scale. Time is counted in
// twelfths, which represent every scale used here.
TEST(StepClock, StepsAreThoseOfTheKeptTimeForAnyStamps) {
    std::mt19937_64 random(20240711);
    for (int run = 0; run < 300; ++run) {
        const int rate = 1 + static_cast<int>(random() % 2000);
        StepClock clock(rate);
        nanoseconds now = 1h;
        clock.advance(now);
        std::int64_t twelfths_kept = 0;
        std::int64_t twelfths = 12;
        for (int i = 0; i < 500; ++i) {
            if (random() % 16 == 0) {
                const int numerator = static_cast<int>(random() % 4);
                const int denominator = 1 + static_cast<int>(random() % 4);
                clock.set_time_scale(numerator, denominator);
                twelfths = 12 * numerator / denominator;
            }
            const nanoseconds frame = random_frame(random);
            now += frame;
            clock.advance(now);
            twelfths_kept += std::clamp(frame, 0ns, nanoseconds{250ms}).count() * twelfths;
            constexpr std::int64_t step = 12'000'000'000;
            ASSERT_EQ(clock.ticks(), twelfths_kept * rate / step) << "run " << run;
            const auto [parts, whole] = clock.remainder();
            ASSERT_EQ(parts * (step / whole), twelfths_kept * rate % step) << "run " << run;
            ASSERT_GE(clock.alpha(), 0);
            ASSERT_LT(clock.alpha(), 1);
        }
    }
}

TEST(HeadlessFrame, AtEqualRatesFrameIShowsStepI) {
    for (std::int64_t i = 0; i < 100'000; ++i) {
        ASSERT_EQ(headless_frame(i, 60, 60).step, i);
        ASSERT_EQ(headless_frame(i, 60, 60).alpha, 0);
    }
}

TEST(HeadlessFrame, HasAnExactAlphaBetweenSteps) {
    EXPECT_EQ(headless_frame(1, 100, 60).step, 1);
    EXPECT_EQ(headless_frame(1, 100, 60).alpha, 40.0 / 60);
    EXPECT_EQ(headless_frame(59, 100, 60).step, 98);
    EXPECT_EQ(headless_frame(59, 100, 60).alpha, 20.0 / 60);
    EXPECT_EQ(headless_frame(5, 10, 60).alpha, 50.0 / 60);
    EXPECT_EQ(headless_frame(1'000'000'000'000'007, 1'000'000, 1000).step,
              1'000'000'000'000'007'000);
}

}  // namespace
}  // namespace oiler::test
