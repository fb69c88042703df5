// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lab/tradeoffs.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "support/text.hpp"

namespace oiler::test {
using namespace oiler::lab;
namespace {

Tradeoff swept(const MeasuredScene& measured, const SweepPlan& plan) {
    Tradeoff tradeoff = started(measured, plan);
    sweep(tradeoff, measured.scene, measured.reference, plan, {});
    return tradeoff;
}

const Tradeoff& whole_sweep() {
    static const Tradeoff tradeoff = swept(spring(), small_plan());
    return tradeoff;
}

// ---- rungs

std::vector<std::int64_t> rungs_at(std::int64_t rate, std::int64_t samples, std::int64_t most) {
    Scene scene;
    scene.stepping.rate.steps = rate;
    return rungs(scene, {.per_second = samples, .count = 2}, most);
}

class Rungs : public testing::TestWithParam<std::pair<std::int64_t, std::int64_t>> {};

TEST_P(Rungs, AreDivisorsAndMultiplesOfTheSamplesAndTheRate) {
    const auto [rate, samples] = GetParam();
    const std::int64_t most = 64 * samples;
    const std::vector<std::int64_t> all = rungs_at(rate, samples, most);
    EXPECT_EQ(all.front(), 1);
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), std::less_equal{}));
    EXPECT_EQ(std::count(all.begin(), all.end(), rate), 1);
    EXPECT_EQ(std::count(all.begin(), all.end(), samples), 1);
    EXPECT_EQ(std::count(all.begin(), all.end(), most), 1);
    for (std::int64_t divisor = 1; divisor <= samples; ++divisor)
        EXPECT_EQ(std::count(all.begin(), all.end(), divisor),
                  samples % divisor == 0 || divisor == rate)
            << divisor;
    for (std::size_t i = 1; i < all.size(); ++i) {
        const std::int64_t rung = all[i];
        EXPECT_TRUE(rung == rate || samples % rung == 0 || rung % samples == 0) << rung;
        EXPECT_TRUE(rung <= most || rung == rate) << rung;
        EXPECT_TRUE(rung <= samples || rung <= 2 * all[i - 1]) << rung;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Rungs,
                         testing::Values(std::pair{100, 50}, std::pair{60, 60}, std::pair{240, 60},
                                         std::pair{1000, 50}, std::pair{1, 1}, std::pair{144, 48},
                                         std::pair{3000, 60}, std::pair{177, 59}));

// Each rung is at most twice the one before if the samples per second have the divisors for it.
TEST(RungsAt, SixtySamples) {
    EXPECT_EQ(rungs_at(60, 60, 500), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 10, 12, 15, 20,
                                                                30, 60, 120, 180, 240, 360, 480}));
    EXPECT_EQ(rungs_at(600, 60, 250), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 10, 12, 15, 20,
                                                                 30, 60, 120, 180, 240, 600}));
}

TEST(RungsAt, NoneIsAboveTheLimitButTheScenesRate) {
    EXPECT_EQ(rungs_at(100, 50, 10), (std::vector<std::int64_t>{1, 2, 5, 10, 100}));
    EXPECT_EQ(rungs_at(60, 60, 7), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 60}));
}

// A limit is a rung if it divides the samples per second, or is 2ⁿ or 1.5·2ⁿ times them. The
// scene's own 1 Hz is always a rung.
TEST(RungsAt, TheLimitItselfIsOne) {
    for (const std::int64_t most : {2, 10, 30, 60, 120, 180, 240, 360, 480, 720, 960}) {
        const std::vector<std::int64_t> all = rungs_at(1, 60, most);
        EXPECT_EQ(all.back(), most);
        EXPECT_LT(rungs_at(1, 60, most - 1).back(), most);
        // The rungs below do not depend on the limit.
        EXPECT_EQ(std::vector(all.begin(), all.end() - 1), rungs_at(1, 60, most - 1));
    }
}

// ---- sweeping

TEST(Sweep, ClimbsEachLadderByTheRungs) {
    const std::vector<std::int64_t> rates = rungs(spring().scene, spring().samples, 800);
    EXPECT_TRUE(whole_sweep().complete());
    EXPECT_EQ(whole_sweep().ladders.size(), 12U);
    EXPECT_EQ(whole_sweep().current,
              (Stepping{&find_method("semi_implicit_euler"), {100}, Precision::double_}));
    for (const Ladder& ladder : whole_sweep().ladders) {
        EXPECT_FALSE(ladder.rows.empty());
        for (std::size_t i = 0; i < ladder.rows.size(); ++i) {
            EXPECT_EQ(ladder.rows[i].stepping,
                      (Stepping{ladder.method, {rates[i]}, ladder.precision}));
            EXPECT_EQ(ladder.rows[i].meets_steps, rates[i] % spring().samples.per_second == 0);
        }
    }
}

// The sweep uses a thread per core; this test judges with one.
TEST(Sweep, OfSeveralThreadsHasTheErrorsOfOne) {
    std::size_t count = 0;
    for (const TradeoffRow* row : whole_sweep().rows()) {
        const Judgement alone = judge(spring().scene, Settings{row->stepping}, spring().reference);
        EXPECT_TRUE(same_errors(row->judgement, alone)) << named(row->stepping);
        ++count;
    }
    EXPECT_GT(count, 80U);
}

// x" = -15 x - 0.1 x', so the closed form is a damped cosine. At 100 Hz every other step is
// sampled.
TEST(Sweep, HasTheErrorsOfTheArticlesLines) {
    const double w = std::sqrt(15 - 0.05 * 0.05);
    double x = 1000;
    double v = 0;
    double most = 0;
    for (int tick = 0; tick <= 1000; ++tick) {
        const double t = tick / 100.0;
        const double exact =
            1000 * std::exp(-0.05 * t) * (std::cos(w * t) + 0.05 / w * std::sin(w * t));
        if (tick % 2 == 0) most = std::max(most, std::abs(x - exact));
        v += (-15 * x - 0.1 * v) * 0.01;
        x += v * 0.01;
    }
    const TradeoffRow* row = whole_sweep().find(whole_sweep().current);
    ASSERT_NE(row, nullptr);
    EXPECT_NEAR(row->judgement.position_error, most, 1e-9 * most);
}

// 50 samples per second: every other falls between two steps at 25 Hz, four of five at 10 Hz. There
// the run is on the straight line.
TEST(Sweep, HasTheErrorsOfTheDrawnMotionBetweenSteps) {
    const double w = std::sqrt(15 - 0.05 * 0.05);
    for (const int rate : {10, 25}) {
        std::vector<double> x{1000};
        double v = 0;
        for (int tick = 0; tick <= 10 * rate; ++tick) {
            v += (-15 * x.back() - 0.1 * v) / rate;
            x.push_back(x.back() + v / rate);
        }
        double most = 0;
        for (int sample = 0; sample <= 500; ++sample) {
            const double t = sample / 50.0;
            const auto tick = static_cast<std::size_t>(sample * rate / 50);
            const double share = sample * rate % 50 / 50.0;
            const double drawn = x[tick] + share * (x[tick + 1] - x[tick]);
            const double exact =
                1000 * std::exp(-0.05 * t) * (std::cos(w * t) + 0.05 / w * std::sin(w * t));
            most = std::max(most, std::abs(drawn - exact));
        }
        const TradeoffRow* row =
            whole_sweep().find({&find_method("semi_implicit_euler"), {rate}, Precision::double_});
        ASSERT_NE(row, nullptr);
        EXPECT_NEAR(row->judgement.position_error, most, 1e-9 * most) << rate;
        EXPECT_FALSE(row->meets_steps);
    }
}

TEST(Sweep, StoppedAndResumedEqualsAnUninterruptedOne) {
    for (const int ladders : {1, 4, 7}) {
        Tradeoff tradeoff = started(spring(), small_plan());
        int done = 0;
        bool stopped = false;
        SweepWatch watch;
        watch.ladder_done = [&](const Tradeoff&) { stopped = ++done >= ladders; };
        watch.stopped = [&] { return stopped; };
        sweep(tradeoff, spring().scene, spring().reference, small_plan(), watch);
        EXPECT_FALSE(tradeoff.complete());
        Tradeoff read = parse_tradeoff(to_json(tradeoff), "tradeoff.json");
        expect_same_errors(read, tradeoff);
        sweep(read, spring().scene, spring().reference, small_plan(), {});
        EXPECT_TRUE(read.complete());
        expect_same_errors(read, whole_sweep());
    }
}

TEST(Sweep, KeepsFinishedLadders) {
    Tradeoff tradeoff = whole_sweep();
    tradeoff.ladders[2].rows[0].judgement.position_error = 42;
    int climbed = 0;
    SweepWatch watch;
    watch.ladder_done = [&](const Tradeoff&) { ++climbed; };
    sweep(tradeoff, spring().scene, spring().reference, small_plan(), watch);
    EXPECT_EQ(climbed, 0);
    EXPECT_EQ(tradeoff.ladders[2].rows[0].judgement.position_error, 42);
}

TEST(Sweep, ReportsItsProgress) {
    SweepPlan plan = small_plan();
    plan.max_rate = 50;
    Tradeoff tradeoff = started(spring(), plan);
    std::vector<double> shares;
    SweepWatch watch;
    watch.progress = [&](double share) { shares.push_back(share); };
    sweep(tradeoff, spring().scene, spring().reference, plan, watch);
    EXPECT_EQ(shares.size(), tradeoff.ladders.size());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.front(), 0);
    EXPECT_NEAR(shares.back(), 1, 1e-12);
}

TEST(TimeRows, TimesStableRowsAndChangesNoError) {
    Tradeoff tradeoff = whole_sweep();
    EXPECT_FALSE(tradeoff.timed());
    std::vector<TradeoffRow*> rows;
    for (Ladder& ladder : tradeoff.ladders)
        for (TradeoffRow& row : ladder.rows) rows.push_back(&row);
    time_rows(spring().scene, rows, 1, {});
    EXPECT_TRUE(tradeoff.timed());
    expect_same_errors(tradeoff, whole_sweep());
    for (const TradeoffRow* row : rows) {
        EXPECT_EQ(std::isnan(row->ns_per_second), !row->judgement.stable) << named(row->stepping);
        EXPECT_FALSE(row->ns_per_second <= 0);
    }
}

// ---- where ladders end

const Ladder& ladder_of(const Tradeoff& tradeoff, const char* name, Precision precision) {
    for (const Ladder& ladder : tradeoff.ladders)
        if (ladder.method->name == name && ladder.precision == precision) return ladder;
    throw std::invalid_argument("no such ladder");
}

TEST(Ladder, EndsBelowTheFloorOfTheReference) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"kahan_li8_kdk"});
    plan.max_rate = 100'000;
    const MeasuredScene rough(
        "[scene]\naxes = 1\nrate = 100\nduration = 3.0\n[[body]]\nname = \"a\"\n"
        "position = [1.0]\n[[body]]\nname = \"b\"\nposition = [2.0]\n[[spring]]\nbody = \"a\"\n"
        "to = \"b\"\nstiffness = 15.0\nrest_length = 0.5\n",
        {.wanted = 1e-9});
    const Tradeoff tradeoff = swept(rough, plan);
    const Ladder& ladder = ladder_of(tradeoff, "kahan_li8_kdk", Precision::double_);
    EXPECT_EQ(ladder.end, "smaller errors are below the reference's floor");
    ASSERT_GT(ladder.rows.size(), 1U);
    for (std::size_t i = 0; i < ladder.rows.size(); ++i)
        EXPECT_EQ(ladder.rows[i].judgement.below_floor(), i + 1 == ladder.rows.size()) << i;
}

// None of the last three aligned rows improved on the best by a tenth.
TEST(Ladder, EndsAtRoundOff) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"rk4"});
    plan.max_rate = 1'000'000;
    const Tradeoff tradeoff = swept(spring(), plan);
    const Ladder& ladder = ladder_of(tradeoff, "rk4", Precision::single);
    EXPECT_EQ(ladder.end, "round-off keeps errors from falling");
    std::vector<double> errors;
    for (const TradeoffRow& row : ladder.rows)
        if (row.judgement.stable && row.meets_steps) errors.push_back(row.judgement.position_error);
    ASSERT_GT(errors.size(), 4U);
    const double best = *std::min_element(errors.begin(), errors.end() - 3);
    EXPECT_GE(*std::min_element(errors.end() - 3, errors.end()), 0.9 * best);
    EXPECT_LT(*(errors.end() - 4), 0.9 * *std::min_element(errors.begin(), errors.end() - 4));
    // 24 bits of 1000 m are 6e-5 m; thousands of roundings leave some hundred times that.
    EXPECT_LT(best, 0.1);
}

// Semi-implicit Euler evaluates forces once per step: 10 s of one body at 400 Hz are 4000.
TEST(Ladder, EndsWhereARunIsTooMuchWork) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"semi_implicit_euler"});
    plan.precisions = {Precision::double_};
    plan.most_work = 4000;
    const Tradeoff tradeoff = swept(spring(), plan);
    const Ladder& ladder = tradeoff.ladders.front();
    EXPECT_EQ(ladder.end, "a run at higher rates is too much work");
    ASSERT_FALSE(ladder.rows.empty());
    EXPECT_EQ(ladder.rows.back().stepping.rate.steps, 400);
    EXPECT_EQ(ladder.rows.back().judgement.evaluations, 4000);
}

// 50 samples per second: rates up to 1024 × 50 Hz, which is below 1,000,000 Hz.
TEST(Ladder, GoesUpTo1024TimesTheSamplesWhereNoLimitIsGiven) {
    SweepPlan plan{.methods = methods_of({"explicit_euler"}), .precisions = {Precision::double_}};
    const MeasuredScene brief(one_axis + "duration = 2.0\n[[body]]\nposition = [1.0]\n" +
                              "name = \"a\"\n[[spring]]\nbody = \"a\"\nanchor = [0.0]\n" +
                              "stiffness = 15.0\n");
    const Tradeoff tradeoff = swept(brief, plan);
    const Ladder& ladder = tradeoff.ladders.front();
    EXPECT_EQ(ladder.end, "the highest rate of the sweep was reached");
    EXPECT_EQ(ladder.rows.back().stepping.rate.steps, 1024 * brief.samples.per_second);
}

TEST(Ladder, EndsAtTheHighestRateOfThePlan) {
    const Ladder& ladder = ladder_of(whole_sweep(), "semi_implicit_euler", Precision::double_);
    EXPECT_EQ(ladder.end, "the highest rate of the sweep was reached");
    EXPECT_EQ(ladder.rows.back().stepping.rate.steps, 800);
}

TEST(Ladder, OfAMethodThatCannotStepTheSceneSaysWhy) {
    const MeasuredScene orbit(
        "[scene]\naxes = 2\nrate = 100\nduration = 3.0\n[[attractor]]\nposition = [0.0, 0.0]\ngm = "
        "1.0\n"
        "[[body]]\nposition = [1.0, 0.0]\nvelocity = [0.0, 1.0]\n");
    SweepPlan plan{.methods = methods_of({"exact", "velocity_verlet"}), .max_rate = 100};
    const Tradeoff tradeoff = swept(orbit, plan);
    EXPECT_TRUE(tradeoff.complete());
    for (const Precision precision : plan.precisions) {
        const Ladder& ladder = ladder_of(tradeoff, "exact", precision);
        EXPECT_TRUE(ladder.rows.empty());
        EXPECT_TRUE(holds(ladder.end, "exact")) << ladder.end;
        EXPECT_TRUE(holds(ladder.end, "attractor")) << ladder.end;
        EXPECT_FALSE(ladder_of(tradeoff, "velocity_verlet", precision).rows.empty());
    }
}

TEST(Ladder, ContinuesPastUnstableRates) {
    const Ladder& ladder = ladder_of(whole_sweep(), "velocity_verlet", Precision::double_);
    // Below 1.94 Hz, where ω·dt = 2, it is unstable.
    EXPECT_FALSE(ladder.rows.front().judgement.stable);
    EXPECT_TRUE(std::isnan(ladder.rows.front().judgement.position_error));
    EXPECT_TRUE(ladder.rows.back().judgement.stable);
}

// ---- shards

std::vector<Tradeoff> shards_of(int shards) {
    std::vector<Tradeoff> parts;
    for (int shard = 1; shard <= shards; ++shard) {
        SweepPlan plan = small_plan();
        plan.shard = shard;
        plan.shards = shards;
        parts.push_back(swept(spring(), plan));
    }
    return parts;
}

TEST(Merge, OfFourShardsIsOneRun) {
    const std::vector<Tradeoff> parts = shards_of(4);
    std::size_t rows = 0;
    for (const Tradeoff& part : parts) {
        EXPECT_FALSE(part.complete());
        EXPECT_EQ(part.ladders.size(), whole_sweep().ladders.size());
        EXPECT_EQ(std::count_if(part.ladders.begin(), part.ladders.end(),
                                [](const Ladder& ladder) { return ladder.done; }),
                  3);
        rows += part.rows().size();
    }
    EXPECT_EQ(rows, whole_sweep().rows().size());
    const Tradeoff merged = merge(parts);
    expect_same_errors(merged, whole_sweep());
    EXPECT_EQ(to_json(merged), to_json(whole_sweep()));
    EXPECT_EQ(to_json(merge({parts[2], parts[0], parts[3], parts[1]})), to_json(whole_sweep()));
}

TEST(Merge, NamesEachMachineOnce) {
    std::vector<Tradeoff> parts = shards_of(3);
    parts[1].machines = {{"another", 7, "cc"}};
    const Tradeoff merged = merge(parts);
    EXPECT_EQ(merged.machines.size(), 2U);
    EXPECT_EQ(merged.machines.at(0), this_machine());
    EXPECT_EQ(merged.machines.at(1), (Machine{"another", 7, "cc"}));
}

TEST(Merge, RefusesPartsOfOtherSweeps) {
    std::vector<Tradeoff> parts = shards_of(2);
    parts[1].fingerprint = "another";
    expect_usage([&] { (void)merge(parts); }, "not of one sweep");
    parts = shards_of(2);
    parts[1].ladders.pop_back();
    expect_usage([&] { (void)merge(parts); }, "not of one sweep");
}

TEST(Merge, RefusesWhereAPartIsMissing) {
    std::vector<Tradeoff> parts = shards_of(4);
    parts.erase(parts.begin() + 1);
    expect_usage([&] { (void)merge(parts); }, "3 of 12");
}

}  // namespace
}  // namespace oiler::test
