// SPDX-License-Identifier: MIT
// Advice by what steps cost, from a made-up clock, and how its costs are said.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/json.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

using namespace lab;

const MeasuredScene& spring() {
    static const MeasuredScene measured(article_spring);
    return measured;
}

/// What a step of a method costs in ns, as the search estimates it and as it is then timed.
struct Price {
    const char* method;
    double estimated;
    double timed;
};

/// The search estimates costs at a rate that no scene here has a run at.
SweepWatch clock_of(const std::vector<Price>& prices) {
    constexpr std::int64_t rate_of_estimates = 1 << 16;
    SweepWatch watch;
    watch.ns_per_step = [prices](const Scene&, const Stepping& choice, std::int64_t) {
        for (const Price& price : prices)
            if (choice.method->name == price.method)
                return choice.rate.steps == rate_of_estimates ? price.estimated : price.timed;
        return 1.0;
    };
    return watch;
}

Advice advice_by(const Wish& wish, const std::vector<Price>& prices) {
    return advise(spring().scene, spring().reference, wish, clock_of(prices));
}

// ---- by time

// Rates are tried up to 1000 ns of computing for a second, by estimates of 1 ns for a step. Then
// velocity Verlet, which is more accurate at all of them, turns out to take a hundred times that.
TEST(AdviceByTime, PutsLastWhatDoesNotFitItsBudget) {
    const Wish wish{.ns_per_second = 1000,
                    .methods = methods_of({"semi_implicit_euler", "velocity_verlet"})};
    const Advice advice =
        advice_by(wish, {{"semi_implicit_euler", 1, 1}, {"velocity_verlet", 1, 100}});
    ASSERT_TRUE(advice.best);
    EXPECT_EQ(advice.best->stepping.method->name, "semi_implicit_euler");
    EXPECT_EQ(advice.best->ns_per_second, static_cast<double>(advice.best->stepping.rate.steps));
    EXPECT_TRUE(advice.meets);
    EXPECT_TRUE(advice.obstacles.empty());
    ASSERT_TRUE(advice.runner_up);
    EXPECT_EQ(advice.runner_up->stepping.method->name, "velocity_verlet");
    EXPECT_GT(advice.runner_up->ns_per_second, 1000);
}

TEST(AdviceByTime, IsTheMostAccurateWhereAllFit) {
    const Wish wish{.ns_per_second = 1000,
                    .methods = methods_of({"semi_implicit_euler", "velocity_verlet"})};
    const Advice advice =
        advice_by(wish, {{"semi_implicit_euler", 1, 1}, {"velocity_verlet", 1, 1}});
    ASSERT_TRUE(advice.best);
    EXPECT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "velocity_verlet");
    // The highest of 50, 100, 150, 200, 300, 400, 600, 800, 1200 Hz that takes at most 1000 ns.
    EXPECT_EQ(advice.best->stepping.rate.steps, 800);
}

// A cost of exactly the budget fits.
TEST(AdviceByTime, FitsABudgetThatItJustTakes) {
    for (const double budget : {800.0, 799.0}) {
        const Wish wish{.ns_per_second = budget, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(wish, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.best);
        EXPECT_EQ(advice.best->stepping.rate.steps, budget == 800 ? 800 : 600);
        EXPECT_TRUE(advice.meets);
    }
}

// Within 1 m both methods will do. By the estimates velocity Verlet is the cheaper one, by its
// times Runge and Kutta's is: 50 Hz at 5 ns each are 250 ns a second.
TEST(AdviceByTime, IsTheCheapestAsTimedNotAsEstimated) {
    const Wish wish{.position_error = 1, .methods = methods_of({"velocity_verlet", "rk4"})};
    const Advice advice = advice_by(wish, {{"velocity_verlet", 1, 10}, {"rk4", 5, 5}});
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "rk4");
    EXPECT_EQ(advice.best->stepping.rate.steps, 50);
    EXPECT_EQ(advice.best->ns_per_second, 250);
    ASSERT_TRUE(advice.runner_up);
    EXPECT_EQ(advice.runner_up->stepping.method->name, "velocity_verlet");
}

// 60 frames show a second: 48,000 ns for a second at 400 Hz are 0.8 µs for a frame.
TEST(AdviceByTime, ThatNothingFitsSaysTheTimeOfAFrame) {
    const Wish wish{.position_error = 100,
                    .ns_per_second = 10,
                    .min_rate = 400,
                    .max_rate = 400,
                    .methods = methods_of({"velocity_verlet"})};
    const Advice advice = advice_by(wish, {{"velocity_verlet", 120, 120}});
    EXPECT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best);
    EXPECT_EQ(advice.best->ns_per_second, 48'000);
    ASSERT_EQ(advice.obstacles.size(), 1U);
    EXPECT_TRUE(holds(advice.obstacles[0], "0.8 µs per frame")) << advice.obstacles[0];
}

// ---- rates between the rungs

// Velocity Verlet is ahead by ω·(ω·dt)²/24 rad a second: within 1 m at 121 Hz. The lowest rate that
// is asked for decides, where it is a rung (200 Hz) as where it lies between two.
TEST(AdviceByTime, NeverGoesBelowTheLowestRate) {
    for (const std::int64_t lowest : {160, 200, 210, 299}) {
        const Wish wish{
            .position_error = 1, .min_rate = lowest, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(wish, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.meets);
        EXPECT_GE(advice.best->stepping.rate.steps, lowest);
        EXPECT_LE(advice.best->stepping.rate.steps, lowest <= 200 ? 200 : 300) << lowest;
    }
}

// Of the multiples of 50 Hz, 100 Hz is too low and 150 Hz will do, as above.
TEST(AdviceByTime, IsRefinedBetweenTheLowestRateAndARung) {
    for (const std::int64_t lowest : {1, 50, 100}) {
        const Wish wish{
            .position_error = 1, .min_rate = lowest, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(wish, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.meets);
        EXPECT_EQ(advice.best->stepping.rate.steps, 150) << lowest;
    }
}

TEST(AdviceByTime, TriesTheHighestRateToo) {
    for (const std::int64_t highest : {50, 300, 400}) {
        const Wish wish{
            .ns_per_second = 1e9, .max_rate = highest, .methods = methods_of({"velocity_verlet"})};
        const Advice advice = advice_by(wish, {{"velocity_verlet", 1, 1}});
        ASSERT_TRUE(advice.best);
        EXPECT_EQ(advice.best->stepping.rate.steps, highest);
    }
}

// ---- how costs are said

/// 36 µs for a second of the scene are 0.6 µs for each of 60 frames.
TradeoffRow costing(const char* method, double us_per_second) {
    TradeoffRow row{.stepping = {&find_method(method), 240, Precision::double_}};
    row.judgement.position_error = 0.25;
    row.ns_per_second = 1e3 * us_per_second;
    row.ns_spread = 0;
    return row;
}

const Wish both{.position_error = 0.5, .ns_per_second = 120e3};

std::string said(const Advice& advice) {
    std::string all;
    for (const std::string& sentence : words_of(advice, spring().scene, spring().reference, both))
        all += sentence + "\n";
    return all;
}

TEST(WordsOfAdvice, SayCostsForASecondAndForAFrame) {
    const std::string words = said({.best = costing("rk4", 36),
                                    .meets = true,
                                    .runner_up = costing("velocity_verlet", 72),
                                    .today = costing("semi_implicit_euler", 9)});
    for (const char* part : {" 36 µs of computing for a second", " 0.6 µs per frame",
                             " 72 µs of computing for a second", " 2 times the cost",
                             " 9 µs of computing for a second", " 0.25 times the cost", "50 % of"})
        EXPECT_TRUE(holds(words, part)) << part << "\n" << words;
    EXPECT_EQ(count_of(words, "per frame"), 1U) << words;
}

// 120 µs for a second are 2 µs for a frame.
TEST(WordsOfAdvice, SayABudgetForAFrame) {
    const std::string words = said({.best = costing("rk4", 600)});
    EXPECT_TRUE(holds(words, " 0.5 m and 2 µs per frame")) << words;
    EXPECT_TRUE(holds(words, " 10 µs per frame")) << words;
}

TEST(JsonOfAdvice, HasEveryCostForAFrameInMicroseconds) {
    const Advice advice{
        .best = costing("rk4", 36),
        .meets = true,
        .runner_up = costing("velocity_verlet", 72),
        .today = costing("semi_implicit_euler", 9),
        .alternatives = {
            {.row = costing("exact", 18), .method = &find_method("exact"), .why = "so"}}};
    const auto json =
        nlohmann::json::parse(json_of(advice, spring().scene, spring().reference, both).dump(-1));
    const auto us = [](const nlohmann::json& row) { return row.at("us_per_frame").get<double>(); };
    EXPECT_DOUBLE_EQ(us(json.at("advice")), 0.6);
    EXPECT_DOUBLE_EQ(us(json.at("runner_up")), 1.2);
    EXPECT_DOUBLE_EQ(us(json.at("today")), 0.15);
    EXPECT_DOUBLE_EQ(us(json.at("alternatives").at(0)), 0.3);
    EXPECT_DOUBLE_EQ(us(json.at("wish")), 2);
    EXPECT_EQ(json.at("advice").at("ns_per_second"), 36'000);
}

}  // namespace
}  // namespace oiler::test
