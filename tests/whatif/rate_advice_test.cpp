// SPDX-License-Identifier: MIT
// Which rate is right: the lowest that was measured to be, or what the order of the errors
// promises.
#include "oiler/whatif/rate_advice.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

WhatIfRun run_of(int rate, double distance, const char* method = "semi_implicit_euler") {
    WhatIfRun run;
    run.stepping = {.method = &find_method(method), .rate = {rate}};
    run.distance = distance;
    return run;
}

/// A run at 60 Hz, at half and at twice its rate.
WhatIf measured(double of_half, double played, double of_twice, double pixel) {
    WhatIf result;
    result.certain_until = 4;
    result.uncertainty = 1e-6;
    result.pixel = pixel;
    result.runs = {run_of(60, played), run_of(60, 0, "velocity_verlet"), run_of(30, of_half),
                   run_of(120, of_twice)};
    return result;
}

std::int64_t rate_of(const WhatIf& result) {
    const auto advice = advise_rate(result);
    return advice ? advice->rate : 0;
}

TEST(RateAdvice, NamesTheLowestMeasuredRateWithinAPixel) {
    const WhatIf twice = measured(0.08, 0.04, 0.009, 0.01);
    EXPECT_EQ(rate_of(twice), 120);
    EXPECT_TRUE(advise_rate(twice)->is_measured);
    EXPECT_EQ(rate_advice_text(twice), "120 Hz of this method is within a pixel so far.");
    WhatIf decided = twice;
    decided.has_events_at_steps = true;
    EXPECT_EQ(
        rate_advice_text(decided),
        "120 Hz of this method is within a pixel so far. Events of update() come at steps: the "
        "rate moves them.");
    EXPECT_EQ(rate_of(measured(0.02, 0.009, 0.005, 0.01)), 60);
    EXPECT_EQ(rate_advice_text(measured(0.02, 0.009, 0.005, 0.01)),
              "This rate is within a pixel so far.");
    EXPECT_EQ(rate_of(measured(0.01, 0.009, 0.005, 0.01)), 30);
    WhatIf failed = measured(0.001, 0.04, 0.02, 0.01);
    failed.runs[2].failure = "diverged";
    EXPECT_NE(rate_of(failed), 30);
    failed.runs[2].failure = "";
    failed.runs[2].other_play_from = 1;
    EXPECT_NE(rate_of(failed), 30);
    WhatIf unsure = measured(0.08, 0.04, 0.009, 0.01);
    unsure.uncertainty = 0.0011;
    EXPECT_EQ(rate_of(unsure), 0) << "it may be off by 1.1 pixels";
}

// Errors of order p at rate r are C·r⁻ᵖ. Half a pixel needs r = 120·(2·e₁₂₀/pixel)^(1/p).
TEST(RateAdvice, PromisesWhatTheOrderOfTheErrorsPromises) {
    const WhatIf first = measured(0.08, 0.04, 0.02, 0.008);  // 120·5 = 600
    EXPECT_EQ(rate_of(first), 600);
    EXPECT_FALSE(advise_rate(first)->is_measured);
    EXPECT_EQ(rate_advice_text(first),
              "About 600 Hz of this method would be within a pixel so far.");
    EXPECT_EQ(rate_of(measured(0.08, 0.04, 0.02, 0.0079)), 0) << "608 Hz; 1000 is not 60·n";
    EXPECT_EQ(rate_advice_text(measured(0.08, 0.04, 0.02, 0.001)),
              "To be within a pixel so far, this method would need about 2400 Hz.");
    EXPECT_EQ(rate_advice_text(measured(0.08, 0.04, 0.02, 0.000195)),
              "To be within a pixel so far, this method would need about 12000 Hz.");
    EXPECT_EQ(rate_advice_text(measured(8, 4, 2, 0.001)),
              "To be within a pixel so far, this method would need more than 100000 Hz.");
}

/// The same with another method.
WhatIf with_method(const char* method, WhatIf result) {
    for (WhatIfRun& run : result.runs) run.stepping.method = &find_method(method);
    result.runs.erase(result.runs.begin() + 1);
    return result;
}

// The phase error of semi-implicit Euler shrinks with order 2 and hides, at first, the error of
// order 1 that is left: half a pixel of 4 mm needs 120·(0.01/0.002) Hz, not 120·√5.
TEST(RateAdvice, PromisesNoMoreThanTheOrderOfTheMethod) {
    EXPECT_EQ(rate_of(measured(0.16, 0.04, 0.01, 0.004)), 600);
    EXPECT_EQ(rate_of(with_method("velocity_verlet", measured(0.16, 0.04, 0.01, 0.005))), 240);
    EXPECT_EQ(rate_of(with_method("velocity_verlet", measured(0.16, 0.04, 0.01, 0.0049))), 300)
        << "242 Hz";
}

// Far from its order, a run tells nothing; those at 8, 16 and 32 times its rate do: half a pixel
// of 1 mm needs 1920·(0.001/0.0005) Hz.
TEST(RateAdvice, TakesTheTrendOfTheHighestRates) {
    WhatIf result = measured(1.1, 0.9, 0.5, 0.001);
    const std::string unknown = "No rate within a pixel is known yet for this method.";
    EXPECT_EQ(rate_advice_text(result), unknown);
    EXPECT_EQ(rates_to_try(result), (std::vector<std::int64_t>{480, 960, 1920}));
    for (const int factor : {8, 16, 32}) result.runs.push_back(run_of(60 * factor, 0.064 / factor));
    EXPECT_EQ(rate_advice_text(result),
              "To be within a pixel so far, this method would need about 3800 Hz.");
    result.runs = {run_of(60, 0.04),   run_of(30, 0.08),   run_of(120, 0.02),
                   run_of(480, 0.004), run_of(960, 0.007), run_of(1920, 0.014)};
    EXPECT_EQ(rate_advice_text(result), unknown) << "float: round-off grows with the rate";
    EXPECT_EQ(rates_to_try(measured(0.08, 0.04, 0.02, 0.008)), std::vector<std::int64_t>{600});
    WhatIf disproved = measured(0.08, 0.04, 0.02, 0.008);
    disproved.runs.push_back(run_of(600, 0.009));
    EXPECT_FALSE(advise_rate(disproved))
        << "it was promised half a pixel, and is measured beyond one";
    WhatIf fast = result;
    fast.runs = {run_of(240, 0.9), run_of(120, 1.1), run_of(480, 0.5)};
    EXPECT_EQ(rates_to_try(fast), (std::vector<std::int64_t>{1920, 3840})) << "7680 is too much";
    // 1920 and 3840 Hz take 24 times as long as 240 Hz.
    fast.runs[0].costs.step = 12'400;
    EXPECT_EQ(rates_to_try(fast).size(), 2U);
    fast.runs[0].costs.update = 200;
    EXPECT_TRUE(rates_to_try(fast).empty()) << "0.302 ms";
}

bool is_unknown(const WhatIf& result) {
    return !advise_rate(result) &&
           rate_advice_text(result).starts_with("No rate within a pixel is known");
}

TEST(RateAdvice, PromisesNothingWhereErrorsShrinkOtherwise) {
    EXPECT_TRUE(is_unknown(measured(0.5, 0.04, 0.02, 0.008))) << "orders 3.6 and 1";
    EXPECT_TRUE(is_unknown(measured(0.05, 0.04, 0.032, 0.008))) << "order 0.3";
    WhatIf unsure = measured(0.08, 0.04, 0.02, 0.008);
    unsure.uncertainty = 0.0021;
    EXPECT_TRUE(is_unknown(unsure)) << "10 times as much is more than 0.02";
    WhatIf alone = measured(0.08, 0.04, 0.02, 0.008);
    alone.runs.pop_back();
    EXPECT_TRUE(is_unknown(alone));
    WhatIf other = measured(0.08, 0.04, 0.02, 0.008);
    other.runs[3].stepping.precision = Precision::single;
    EXPECT_TRUE(is_unknown(other)) << "at twice the rate, but in float";
}

}  // namespace
}  // namespace oiler::test
