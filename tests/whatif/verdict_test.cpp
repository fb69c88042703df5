// SPDX-License-Identifier: MIT
// The sentence that a window shows: what it names, what it calls good, and what it does not claim.
#include "oiler/whatif/verdict.hpp"

#include "oiler/app/playback.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Grade = Verdict::Grade;

std::string name_of(Entity entity) { return "body " + std::to_string(entity.index); }

WhatIfRun run_of(const char* method, int rate, double distance, double nanoseconds) {
    WhatIfRun run;
    run.stepping = {.method = &find_method(method), .rate = {rate}};
    run.distance = distance;
    run.furthest = Entity{3, 0};
    run.costs.step = nanoseconds;
    return run;
}

/// A pixel is 1 cm. Euler at 60 Hz is off by `distance`; velocity Verlet and 120 Hz are rivals.
WhatIf measured(double distance, double of_verlet, double of_twice) {
    WhatIf result;
    result.duration = result.measured_until = result.certain_until = 4;
    result.uncertainty = 1e-6;
    result.pixel = 0.01;
    result.runs = {run_of("semi_implicit_euler", 60, distance, 1'000'000),
                   run_of("velocity_verlet", 60, of_verlet, 1'300'000),
                   run_of("semi_implicit_euler", 120, of_twice, 2'000'000)};
    return result;
}
Verdict judge(const WhatIf& result, const std::vector<Reading>& before = {}, double begin = 0) {
    return judge_setting(result, before, begin, name_of);
}

TEST(Verdict, NamesTheBodyThePixelsAndTheCheapestCure) {
    const Verdict verdict = judge(measured(0.04, 0.002, 0.001));
    EXPECT_EQ(verdict.grade, Grade::visible);
    EXPECT_EQ(verdict.text,
              "body 3 up to 4 cm off, 4 px, at 60 Hz semi_implicit_euler. velocity_verlet: 2 mm "
              "off, +300 µs a frame.");
    EXPECT_EQ(judge(measured(0.073, 0.02, 0.001)).grade, Grade::bad) << "a hundredth of 720 lines";
    EXPECT_TRUE(
        holds(judge(measured(0.073, 0.02, 0.001)).text, ". 120 Hz: 1 mm off, +1000 µs a frame."));
    EXPECT_TRUE(judge(measured(0.073, 0.04, 0.04)).text.ends_with("semi_implicit_euler."))
        << "nothing mends it";
    EXPECT_TRUE(holds(judge(measured(0.073, 5e-6, 0.02)).text, "velocity_verlet: exact,"));
}

// With ten uncertainties of 2.5 cm, an error of 4 cm is known, and one of 2 mm is not.
TEST(Verdict, ClaimsNothingThatTheReferenceDoesNotKnow) {
    WhatIf result = measured(0.04, 0.001, 0.002);
    result.uncertainty = 0.0025;
    EXPECT_TRUE(judge(result).text.ends_with("semi_implicit_euler.")) << judge(result).text;
    result.uncertainty = 0.002;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: less than 2 cm off,"));
    result.uncertainty = 0.005;
    EXPECT_EQ(judge(result).grade, Grade::unknown);
    EXPECT_EQ(judge(result).text, "Right to 5 cm so far at 60 Hz semi_implicit_euler.");
    result = measured(0.04, 5e-6, 0.02);
    result.uncertainty = 1.1e-5;
    EXPECT_TRUE(holds(judge(result).text, "less than 0.11 mm off,")) << "a pixel is 1 cm";
}

TEST(Verdict, SaysWhereACureIsOffOnlyBetweenSteps) {
    WhatIf result = measured(0.04, 0.002, 0.02);
    result.runs[1].distance_at_steps = 5e-6;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: exact at the steps, "));
    result.runs[1].distance_at_steps = 5e-5;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: 2 mm off, "));
    result = measured(0.04, 0.012, 0.03);
    result.runs[1].distance_at_steps = 5e-6;
    EXPECT_TRUE(holds(judge(result).text, "velocity_verlet: 1.2 cm off, ")) << "a pixel is seen";
}

TEST(Verdict, TellsTimesOfTheGame) {
    WhatIf result = measured(0.04, 0.002, 0.001);
    result.certain_until = 2.5;
    EXPECT_TRUE(holds(judge(result).text, "After 2.5 s the"));
    EXPECT_TRUE(holds(judge(result, {}, 3).text, "After 5.5 s the"));
    result.runs[0].other_play_from = 0.5;
    EXPECT_TRUE(judge(result, {}, 3).text.starts_with("From 3.5 s on"));
}

TEST(Verdict, IsGoodBelowAPixelAndUnknownWithoutAReference) {
    const Verdict good = judge(measured(0.009, 0, 0));
    EXPECT_EQ(good.grade, Grade::good);
    EXPECT_EQ(good.text,
              "Drawn within 9 mm of the true motion, less than a pixel, at 60 Hz "
              "semi_implicit_euler.");
    EXPECT_TRUE(holds(judge(measured(1e-7, 0, 0)).text, "within 10 µm")) << "no more is known";
    WhatIf unsure = measured(0.001, 0, 0);
    unsure.uncertainty = 0.003;
    EXPECT_EQ(judge(unsure).grade, Grade::unknown) << "it may be off by three pixels";
    EXPECT_EQ(judge(unsure).text, "Right to 3 cm so far at 60 Hz semi_implicit_euler.");
    unsure.pixel_until = 1.25;
    EXPECT_EQ(judge(unsure).text,
              "Right to a pixel until 1.2 s at 60 Hz semi_implicit_euler, to 3 cm since.");
    unsure.pixel_until = 1.29;
    EXPECT_TRUE(holds(judge(unsure).text, "until 1.2 s")) << "no longer than is known";
    unsure.runs[0].visible_from = 1.5;
    EXPECT_EQ(judge(unsure).grade, Grade::visible) << "it was, before the reference was that bad";
    EXPECT_EQ(judge(unsure, {}, 2).text,
              "More than a pixel off since 3.5 s at 60 Hz semi_implicit_euler, 3 cm at most.");
    WhatIf still = measured(0, 0, 0);
    still.uncertainty = 0;
    EXPECT_EQ(judge(still).text, "No error so far at 60 Hz semi_implicit_euler.");
    WhatIf unknown = measured(1, 0, 0);
    unknown.certain_until = 0;
    EXPECT_EQ(judge(unknown).grade, Grade::unknown);
    EXPECT_FALSE(holds(judge(unknown).text, "1 m")) << "never a guess";
}

// A figure of an earlier moment is not green, whatever it was then.
TEST(Verdict, IsGreyWhereThePresentMomentIsNotKnown) {
    for (const double error : {0.0, 0.009, 0.04, 0.4}) {
        WhatIf early = measured(error, 0, 0);
        early.certain_until = 2.25;
        EXPECT_EQ(judge(early).grade, Grade::unknown) << error;
        EXPECT_TRUE(judge(early).text.ends_with(" After 2.2 s the true motion is not known."));
        early.tenfold = 0.31;
        EXPECT_TRUE(judge(early).text.ends_with(
            " After 2.2 s nobody knows the true motion: the least error grows tenfold in 0.31 s."));
        early.measured_until = 2.5;
        EXPECT_TRUE(judge(early).text.ends_with(" Measured until 2.2 s so far.")) << "it lags";
        early.certain_until = 3.75;
        EXPECT_NE(judge(early).grade, Grade::unknown) << "a difference may be a delay of 0.25 s";
        early.runs[0].readings = {{"apex", 1.95, "m"}};
        early.reference.readings = early.check.readings = {{"apex", 2.025, "m"}};
        EXPECT_GE(judge(early, early.runs[0].readings).grade, Grade::visible);
        early.certain_until = 2.25;
        EXPECT_EQ(judge(early, early.runs[0].readings).grade, Grade::unknown);
    }
}

TEST(Verdict, NamesTheBestSettingIfNoneIsBelowAPixel) {
    EXPECT_TRUE(
        judge(measured(0.9, 0.05, 0.03)).text.ends_with(" 120 Hz: 3 cm off, +1000 µs a frame."));
    EXPECT_TRUE(judge(measured(0.09, 0.05, 0.06)).text.ends_with(" semi_implicit_euler."))
        << "less than half is no cure";
    EXPECT_TRUE(judge(measured(9, 0.071, 8)).text.ends_with(" 7.1 cm off, +300 µs a frame."));
    EXPECT_TRUE(judge(measured(9, 0.073, 8)).text.ends_with(" semi_implicit_euler."))
        << "beyond a hundredth of the 720 lines of the picture";
    WhatIf cheap = measured(0.9, 0.001, 0.002);
    cheap.runs[0].costs.step = 500;
    cheap.runs[1].costs.step = 10'000;
    EXPECT_TRUE(judge(cheap).text.ends_with("1 mm off, for about the same time."));
    cheap.runs[1].costs.step = cheap.runs[2].costs.step = 9'999;
    cheap.runs[1].evaluations = 120;
    cheap.runs[2].evaluations = 119;
    EXPECT_TRUE(judge(cheap).text.ends_with(" 120 Hz: 2 mm off, below 10 µs a frame."))
        << "fewer forces";
    cheap.runs[0].costs.step = 41'000;
    EXPECT_TRUE(judge(cheap).text.ends_with(" below 10 µs a frame.")) << "not −31 µs";
    cheap.runs[1].costs.step = cheap.runs[2].costs.step = 12'000;
    EXPECT_TRUE(judge(cheap).text.ends_with(" 12 instead of 41 µs a frame."));
    EXPECT_TRUE(holds(judge(measured(1e9, 1e9, 1e9)).text, "1.0e+09 m off, more than 99999 px"));
}

TEST(Verdict, NamesReadingsAtRestFirst) {
    WhatIf result = measured(0.04, 0.002, 0.001);
    result.runs[0].readings = {{"apex", 1.95, "m"}, {"score", 3}, {"speed", 5, "m/s"}};
    result.reference.readings = {{"apex", 2.025, "m"}, {"score", 4}, {"speed", 5.001, "m/s"}};
    result.check.readings = result.reference.readings;
    EXPECT_FALSE(holds(judge(result).text, "apex")) << "it may still grow";
    EXPECT_EQ(judge(result, result.runs[0].readings).text,
              "apex 1.95 m, true 2.025 m: 7.5 cm too low at 60 Hz semi_implicit_euler. "
              "velocity_verlet: 2 mm off, +300 µs a frame.");
    result.runs[0].readings[0].value = std::nextafter(1.9875, 0);
    EXPECT_TRUE(judge(result, result.runs[0].readings).text.starts_with("apex 1.988 m, true 2.025"))
        << "a half in the last places";
    result.runs[0].readings[0].value = 1.95;
    result.reference.readings[0].value = 1.9;
    result.check.readings[0].value = 1.9;
    EXPECT_TRUE(holds(judge(result, result.runs[0].readings).text, "5 cm too high"));
    result.check.readings[0].value = 1.906;
    EXPECT_FALSE(holds(judge(result, result.runs[0].readings).text, "apex"))
        << "the reference is unsure by 6 mm";
    result.reference.readings[0].value = result.check.readings[0].value = 1.955;
    EXPECT_FALSE(holds(judge(result, result.runs[0].readings).text, "apex"))
        << "no more than a pixel";
    result.reference.readings[2].value = result.check.readings[2].value = 4;
    EXPECT_TRUE(
        holds(judge(result, result.runs[0].readings).text, "speed 5 m/s, true 4 m/s: 1 m/s too"));
}

TEST(Verdict, NamesTheFailureOfTheGameAndItsCure) {
    WhatIf result = measured(0.001, 0.002, 0.001);
    result.runs[0].failure = "diverged at step 8";
    EXPECT_EQ(judge(result).grade, Grade::bad);
    EXPECT_EQ(judge(result).text, "diverged at step 8 velocity_verlet: 2 mm off, +300 µs a frame.");
    result.runs[1].failure = "diverged, too";
    EXPECT_EQ(judge(result).text, "diverged at step 8 120 Hz: 1 mm off, +1000 µs a frame.");
}

TEST(Verdict, SaysWhenThePlayIsAnotherOne) {
    WhatIf result = measured(0.001, 0.002, 0.001);
    result.runs[0].other_play_from = 3.25;
    result.runs[0].other_play = "coins 2, true 3";
    result.runs[1].other_play_from = 1;
    EXPECT_EQ(judge(result).grade, Grade::bad);
    EXPECT_EQ(judge(result).text,
              "From 3.2 s on, other things happen at 60 Hz semi_implicit_euler: coins 2, true 3. "
              "120 Hz: 1 mm off, +1000 µs a frame.");
    // A wrong result says more.
    result.runs[0].readings = {{"apex", 1.95, "m"}};
    result.reference.readings = result.check.readings = {{"apex", 2.025, "m"}};
    EXPECT_EQ(judge(result, result.runs[0].readings).grade, Grade::bad);
    EXPECT_EQ(judge(result, result.runs[0].readings).text,
              "apex 1.95 m, true 2.025 m: 7.5 cm too low at 60 Hz semi_implicit_euler. "
              "120 Hz: 1 mm off, +1000 µs a frame.");
}

}  // namespace
}  // namespace oiler::test
