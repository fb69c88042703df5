// SPDX-License-Identifier: MIT
// Advice by the cost of steps, from a made-up clock, and the description of costs.
#include <nlohmann/json.hpp>

#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The cost of a step of a method, ns, as the search estimates it and as it is timed later.
struct Price {
    const char* method;
    double estimated;
    double timed;
};

SweepWatch clock_of(const std::vector<Price>& prices) {
    const auto price = [prices](const Stepping& choice, double Price::*of) {
        for (const Price& one : prices)
            if (choice.method->name == one.method) return one.*of;
        return 1.0;
    };
    SweepWatch watch =
        made_up_clock([=](const Stepping& choice) { return price(choice, &Price::timed); });
    watch.ns_per_step = [=](const auto&, const Stepping& choice, std::int64_t) {
        return price(choice, &Price::estimated);
    };
    return watch;
}

Advice advice_by(const Requirements& requirements, const std::vector<Price>& prices) {
    return advise(spring().scene, spring().reference, requirements, clock_of(prices));
}

// ---- by time

// Estimates of 1 ns per step allow rates up to 1000 Hz. Velocity Verlet is more accurate at all of
// them, but is then timed at 100 ns per step.
TEST(AdviceByTime, PutsSettingsOverBudgetLast) {
    const Requirements requirements{
        .ns_per_second = 1000, .methods = methods_of({"semi_implicit_euler", "velocity_verlet"})};
    const Advice advice =
        advice_by(requirements, {{"semi_implicit_euler", 1, 1}, {"velocity_verlet", 1, 100}});
    ASSERT_TRUE(advice.best);
    EXPECT_EQ(advice.best->stepping.method->name, "semi_implicit_euler");
    EXPECT_DOUBLE_EQ(advice.best->ns_per_second,
                     static_cast<double>(advice.best->stepping.rate.steps));
    EXPECT_TRUE(advice.meets);
    EXPECT_TRUE(advice.obstacles.empty());
    ASSERT_TRUE(advice.runner_up);
    EXPECT_EQ(advice.runner_up->stepping.method->name, "velocity_verlet");
    EXPECT_GT(advice.runner_up->ns_per_second, 1000);
}

TEST(AdviceByTime, IsTheMostAccurateWhereAllFit) {
    const Requirements requirements{
        .ns_per_second = 1000, .methods = methods_of({"semi_implicit_euler", "velocity_verlet"})};
    const Advice advice =
        advice_by(requirements, {{"semi_implicit_euler", 1, 1}, {"velocity_verlet", 1, 1}});
    ASSERT_TRUE(advice.best);
    EXPECT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "velocity_verlet");
    // The highest of 480, 720, 960, 1440 Hz that takes at most 1000 ns.
    EXPECT_EQ(advice.best->stepping.rate.steps, 960);
}

// A cost of exactly the budget fits. Rates between those of sweeps leave 5 % for the spread of the
// time: 683 of 719.
TEST(AdviceByTime, FitsABudgetThatItJustTakes) {
    for (const double budget : {720.0, 719.0}) {
        const Requirements requirements{.ns_per_second = budget,
                                        .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(requirements, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.best);
        EXPECT_EQ(advice.best->stepping.rate.steps, budget == 720 ? 720 : 683);
        EXPECT_TRUE(advice.meets);
    }
}

// Both methods meet 1 m. Velocity Verlet is cheaper as estimated, rk4 as timed. The chords of rk4,
// whose steps are almost exact, deviate by 1000 m·15/s²·dt²/8, which is 0.98 m at 43.7 Hz.
TEST(AdviceByTime, IsTheCheapestAsTimedNotAsEstimated) {
    const Requirements requirements{.position_error = 1,
                                    .methods = methods_of({"velocity_verlet", "rk4"})};
    const Advice advice = advice_by(requirements, {{"velocity_verlet", 1, 10}, {"rk4", 5, 5}});
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "rk4");
    const std::int64_t rate = advice.best->stepping.rate.steps;
    EXPECT_GE(rate, 43);
    EXPECT_LE(rate, 46);
    EXPECT_DOUBLE_EQ(advice.best->ns_per_second, 5.0 * static_cast<double>(rate));
    ASSERT_TRUE(advice.runner_up);
    EXPECT_EQ(advice.runner_up->stepping.method->name, "velocity_verlet");
}

// 480 Hz at 120 ns are 57,600 ns per second: 0.96 µs for each of 60 frames.
TEST(AdviceByTime, ThatNoSettingMeetsNamesTheTimePerFrame) {
    const Requirements requirements{.position_error = 100,
                                    .ns_per_second = 10,
                                    .min_rate = 480,
                                    .max_rate = 480,
                                    .methods = methods_of({"velocity_verlet"})};
    const Advice advice = advice_by(requirements, {{"velocity_verlet", 120, 120}});
    EXPECT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best);
    EXPECT_EQ(advice.best->ns_per_second, 57'600);
    ASSERT_EQ(advice.obstacles.size(), 1U);
    EXPECT_TRUE(holds(advice.obstacles[0], "0.96 µs per frame"));
}

// ---- rates between the rates

// Velocity Verlet gains ω·(ω·dt)²/24 rad per second: it meets 1 m from about 122 Hz on. The lowest
// allowed rate decides, on a rate (180 Hz) and between two.
TEST(AdviceByTime, NeverGoesBelowTheLowestRate) {
    for (const auto& [lowest, allowed] :
         {std::pair{160, 180}, std::pair{180, 180}, std::pair{181, 240}, std::pair{299, 360}}) {
        const Requirements requirements{
            .position_error = 1, .min_rate = lowest, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(requirements, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.meets);
        EXPECT_EQ(advice.best->stepping.rate.steps, allowed) << lowest;
    }
}

// As above. Refining ends within 1/32 of the lowest rate that meets the tolerance.
TEST(AdviceByTime, IsRefinedBetweenTheLowestRateAndARung) {
    for (const std::int64_t lowest : {1, 50, 100}) {
        const Requirements requirements{
            .position_error = 1, .min_rate = lowest, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(requirements, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.meets);
        EXPECT_NEAR(static_cast<double>(advice.best->stepping.rate.steps), 124, 6) << lowest;
    }
}

TEST(AdviceByTime, TriesTheHighestRateToo) {
    for (const std::int64_t highest : {60, 100, 360, 480}) {
        const Requirements requirements{
            .ns_per_second = 1e9, .max_rate = highest, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(requirements, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.best);
        EXPECT_EQ(advice.best->stepping.rate.steps, highest);
    }
}

// ---- descriptions of costs

/// 36 µs per second of the scene are 0.6 µs for each of 60 frames, or 0.0036 % of the time.
TradeoffRow costing(const char* method, double us_per_second) {
    TradeoffRow row{.stepping = {&find_method(method), {240}, Precision::double_}};
    row.judgement.position_error = 0.25;
    row.judgement.step_error = 0.125;
    row.ns_per_second = 1e3 * us_per_second;
    row.ns_spread = 0;
    return row;
}

const Requirements both{.position_error = 0.5, .ns_per_second = 120e3};

std::string said(const Advice& advice) {
    std::string all;
    for (const std::string& sentence : describe(advice, spring().scene, spring().reference, both))
        all += sentence + "\n";
    return all;
}

TEST(DescribeAdvice, SayCostsForASecondAndForAFrame) {
    const std::string words = said({.best = costing("rk4", 36),
                                    .meets = true,
                                    .runner_up = costing("velocity_verlet", 72),
                                    .current = costing("semi_implicit_euler", 9)});
    for (const char* part :
         {" 36 µs per simulated second, 0.0036 % of a frame (0.6 µs);",
          " 72 µs per simulated second, 0.0072 % of a frame, 2 times the cost",
          " 9 µs per simulated second, 0.0009 % of a frame, 0.25 times the cost",
          "that is 50 % of the 0.5 m allowed", "error 25 cm as drawn, 12 cm at the steps"})
        EXPECT_TRUE(holds(words, part)) << part << "\n" << words;
    EXPECT_EQ(count_of(words, "(0.6 µs)"), 1U) << words;
}

// 1/240 s is 4.17 ms.
TEST(DescribeAdvice, SaysHowLateInputShows) {
    const std::string words = said({.best = costing("rk4", 36), .meets = true});
    EXPECT_TRUE(holds(words, "Input shows up to 4.17 ms late, one step."));
}

// A tolerance at the steps is compared with the error at the steps.
TEST(DescribeAdvice, SayTheShareOfATolerance) {
    Requirements at_steps = both;
    at_steps.at_steps = true;
    const std::string words = describe({.best = costing("rk4", 36), .meets = true}, spring().scene,
                                       spring().reference, at_steps)
                                  .front();
    EXPECT_TRUE(holds(words, "that is 25 % of the 0.5 m at the steps allowed"));
}

// 37 µs cost 1/36 more than 36 µs, which is less than times differ from one measurement to the
// next.
TEST(DescribeAdvice, NameTiesAndEqualCosts) {
    const std::string words = said({.best = costing("rk4", 36),
                                    .meets = true,
                                    .ties = {costing("rk4_38", 36), costing("rk3_kutta", 37)},
                                    .current = costing("semi_implicit_euler", 37)});
    EXPECT_TRUE(holds(words,
                      "Ties, within the spread of the cost: rk4_38 at 240 Hz in double; rk3_kutta "
                      "at 240 Hz in double.\n"));
    EXPECT_TRUE(holds(words,
                      " 37 µs per simulated second, 0.0037 % of a frame, 1.03 times the cost, "
                      "within its spread."));
}

// 120 µs per second are 2 µs per frame.
TEST(DescribeAdvice, SayABudgetForAFrame) {
    const std::string words = said({.best = costing("rk4", 600)});
    EXPECT_TRUE(holds(words, " 0.5 m and 2 µs per frame"));
    EXPECT_TRUE(holds(words, " 600 µs per simulated second, 0.06 % of a frame (10 µs)."));
}

TEST(JsonOfAdvice, HasEveryCostForAFrameInMicroseconds) {
    const Advice advice{
        .best = costing("rk4", 36),
        .meets = true,
        .ties = {costing("rk4_38", 30)},
        .runner_up = costing("velocity_verlet", 72),
        .current = costing("semi_implicit_euler", 9),
        .alternatives = {
            {.row = costing("exact", 18), .method = &find_method("exact"), .why = "so"}}};
    const auto json =
        nlohmann::json::parse(to_json(advice, spring().scene, spring().reference, both).dump(-1));
    const auto us = [](const nlohmann::json& row) { return row.at("us_per_frame").get<double>(); };
    EXPECT_DOUBLE_EQ(us(json.at("advice")), 0.6);
    EXPECT_DOUBLE_EQ(us(json.at("runner_up")), 1.2);
    EXPECT_DOUBLE_EQ(us(json.at("current")), 0.15);
    EXPECT_DOUBLE_EQ(us(json.at("alternatives").at(0)), 0.3);
    EXPECT_DOUBLE_EQ(us(json.at("ties").at(0)), 0.5);
    EXPECT_DOUBLE_EQ(us(json.at("requirements")), 2);
    EXPECT_DOUBLE_EQ(json.at("advice").at("share_of_frame"), 36e-6);
    EXPECT_DOUBLE_EQ(json.at("advice").at("latency_ms"), 1e3 / 240);
    EXPECT_EQ(json.at("advice").at("ns_per_second"), 36'000);
}

}  // namespace
}  // namespace oiler::test
