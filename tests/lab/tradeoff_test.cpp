// SPDX-License-Identifier: MIT
#include "oiler/lab/tradeoff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <sstream>

#include "lab/measured_scenes.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/version.hpp"
#include "oiler/lab/tradeoff_file.hpp"

namespace oiler::test {
namespace {

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<const Method*> methods_of(const std::vector<const char*>& names) {
    std::vector<const Method*> all;
    for (const char* name : names) all.push_back(&find_method(name));
    return all;
}

const MeasuredScene& spring() {
    static const MeasuredScene measured(article_spring);
    return measured;
}

SweepPlan small_plan() {
    return {.methods = methods_of({"explicit_euler", "semi_implicit_euler", "velocity_verlet",
                                   "rk4", "exact", "kahan_li8_kdk"}),
            .max_rate = 800};
}

Tradeoff started(const MeasuredScene& measured, const SweepPlan& plan) {
    Tradeoff tradeoff = start_tradeoff(measured.scene, measured.looks, measured.reference, plan);
    tradeoff.scene = "test";
    tradeoff.fingerprint = fingerprint(measured.text, measured.scene, measured.looks, plan);
    return tradeoff;
}

Tradeoff swept(const MeasuredScene& measured, const SweepPlan& plan) {
    Tradeoff tradeoff = started(measured, plan);
    sweep(tradeoff, measured.scene, measured.reference, plan, {});
    return tradeoff;
}

const Tradeoff& whole_sweep() {
    static const Tradeoff tradeoff = swept(spring(), small_plan());
    return tradeoff;
}

// What is compared is told apart to the bit, and so are different NaNs of the same meaning: none.
bool same(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_errors(const Judgement& a, const Judgement& b) {
    return a.stable == b.stable && same(a.position_error, b.position_error) &&
           same(a.velocity_error, b.velocity_error) && same(a.phase_error, b.phase_error) &&
           same(a.energy_drift, b.energy_drift) && same(a.evaluations, b.evaluations);
}

bool same_times(const TradeoffRow& a, const TradeoffRow& b) {
    return same(a.ns_per_second, b.ns_per_second) && same(a.ns_spread, b.ns_spread);
}

std::string named(const SceneChoice& choice) {
    return std::string(choice.method->name) + " at " + std::to_string(choice.rate);
}

void expect_same_errors(const Tradeoff& a, const Tradeoff& b) {
    ASSERT_EQ(a.ladders.size(), b.ladders.size());
    for (std::size_t i = 0; i < a.ladders.size(); ++i) {
        const Ladder& one = a.ladders[i];
        const Ladder& other = b.ladders[i];
        EXPECT_EQ(one.method, other.method);
        EXPECT_EQ(one.precision, other.precision);
        EXPECT_EQ(one.end, other.end);
        EXPECT_EQ(one.done, other.done);
        ASSERT_EQ(one.rows.size(), other.rows.size()) << one.method->name;
        for (std::size_t row = 0; row < one.rows.size(); ++row) {
            EXPECT_EQ(one.rows[row].choice, other.rows[row].choice);
            EXPECT_EQ(one.rows[row].meets_steps, other.rows[row].meets_steps);
            EXPECT_TRUE(same_errors(one.rows[row].judgement, other.rows[row].judgement))
                << named(one.rows[row].choice);
        }
    }
}

void expect_usage(const std::function<void()>& wrong, const std::string& words) {
    try {
        wrong();
        ADD_FAILURE() << "is not refused";
    } catch (const Error& error) {
        const std::string line = error.what();
        EXPECT_EQ(error.exit(), Exit::usage);
        EXPECT_TRUE(holds(line, words)) << line;
        EXPECT_FALSE(holds(line, "\n")) << line;
    }
}

// ---- rungs

std::vector<std::int64_t> rungs_at(std::int64_t rate, std::int64_t looks, std::int64_t most) {
    Scene scene;
    scene.rate = rate;
    return rungs(scene, {.per_second = looks, .count = 2}, most);
}

class Rungs : public testing::TestWithParam<std::pair<std::int64_t, std::int64_t>> {};

TEST_P(Rungs, AreDivisorsAndMultiplesOfTheLooksAndTheRate) {
    const auto [rate, looks] = GetParam();
    const std::int64_t most = 64 * looks;
    const std::vector<std::int64_t> all = rungs_at(rate, looks, most);
    EXPECT_EQ(all.front(), 1);
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), std::less_equal{}));
    EXPECT_EQ(std::count(all.begin(), all.end(), rate), 1);
    EXPECT_EQ(std::count(all.begin(), all.end(), looks), 1);
    EXPECT_EQ(std::count(all.begin(), all.end(), most), 1);
    for (std::int64_t divisor = 1; divisor <= looks; ++divisor)
        EXPECT_EQ(std::count(all.begin(), all.end(), divisor),
                  looks % divisor == 0 || divisor == rate)
            << divisor;
    for (std::size_t i = 1; i < all.size(); ++i) {
        const std::int64_t rung = all[i];
        EXPECT_TRUE(rung == rate || looks % rung == 0 || rung % looks == 0) << rung;
        EXPECT_TRUE(rung <= most || rung == rate) << rung;
        EXPECT_TRUE(rung <= looks || rung <= 2 * all[i - 1]) << rung;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Rungs,
                         testing::Values(std::pair{100, 50}, std::pair{60, 60}, std::pair{240, 60},
                                         std::pair{1000, 50}, std::pair{1, 1}, std::pair{144, 48},
                                         std::pair{3000, 60}, std::pair{177, 59}));

// Up to twice the one before, where the looks have the divisors for it, and not beyond the limit.
TEST(RungsAt, SixtyLooks) {
    EXPECT_EQ(rungs_at(60, 60, 500), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 10, 12, 15, 20,
                                                                30, 60, 120, 180, 240, 360, 480}));
    EXPECT_EQ(rungs_at(600, 60, 250), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 10, 12, 15, 20,
                                                                 30, 60, 120, 180, 240, 600}));
}

TEST(RungsAt, NoneIsAboveTheLimitButTheScenesRate) {
    EXPECT_EQ(rungs_at(100, 50, 10), (std::vector<std::int64_t>{1, 2, 5, 10, 100}));
    EXPECT_EQ(rungs_at(60, 60, 7), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 60}));
}

// ---- sweeping

TEST(Sweep, ClimbsEachLadderByTheRungs) {
    const std::vector<std::int64_t> rates = rungs(spring().scene, spring().looks, 800);
    EXPECT_TRUE(whole_sweep().complete());
    EXPECT_EQ(whole_sweep().ladders.size(), 12U);
    EXPECT_EQ(whole_sweep().today,
              (SceneChoice{&find_method("semi_implicit_euler"), 100, Precision::double_}));
    for (const Ladder& ladder : whole_sweep().ladders) {
        EXPECT_FALSE(ladder.rows.empty());
        for (std::size_t i = 0; i < ladder.rows.size(); ++i) {
            EXPECT_EQ(ladder.rows[i].choice,
                      (SceneChoice{ladder.method, rates[i], ladder.precision}));
            EXPECT_EQ(ladder.rows[i].meets_steps, rates[i] % spring().looks.per_second == 0);
        }
    }
}

// As many threads as there are cores climbed the ladders of the sweep; one judges here.
TEST(Sweep, OfSeveralThreadsHasTheErrorsOfOne) {
    std::size_t count = 0;
    for (const TradeoffRow* row : whole_sweep().rows()) {
        const Judgement alone = judge(spring().scene, settings_of(row->choice), spring().reference);
        EXPECT_TRUE(same_errors(row->judgement, alone)) << named(row->choice);
        ++count;
    }
    EXPECT_GT(count, 80U);
}

// The spring is left to itself: x" = -15 x - 0.1 x', so that the closed form is a damped cosine.
// What the sweep says of semi-implicit Euler is what its two lines say: at 100 Hz it is looked at
// every other step.
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
    const TradeoffRow* row = whole_sweep().find(whole_sweep().today);
    ASSERT_NE(row, nullptr);
    EXPECT_NEAR(row->judgement.position_error, most, 1e-9 * most);
}

// At 25 Hz every other of 50 looks a second falls between two steps, at 10 Hz four of five: there
// it is on the straight line.
TEST(Sweep, HasTheErrorsOfWhatIsDrawnBetweenSteps) {
    const double w = std::sqrt(15 - 0.05 * 0.05);
    for (const int rate : {10, 25}) {
        std::vector<double> x{1000};
        double v = 0;
        for (int tick = 0; tick <= 10 * rate; ++tick) {
            v += (-15 * x.back() - 0.1 * v) / rate;
            x.push_back(x.back() + v / rate);
        }
        double most = 0;
        for (int look = 0; look <= 500; ++look) {
            const double t = look / 50.0;
            const auto tick = static_cast<std::size_t>(look * rate / 50);
            const double share = look * rate % 50 / 50.0;
            const double drawn = x[tick] + share * (x[tick + 1] - x[tick]);
            const double exact =
                1000 * std::exp(-0.05 * t) * (std::cos(w * t) + 0.05 / w * std::sin(w * t));
            most = std::max(most, std::abs(drawn - exact));
        }
        const TradeoffRow* row =
            whole_sweep().find({&find_method("semi_implicit_euler"), rate, Precision::double_});
        ASSERT_NE(row, nullptr);
        EXPECT_NEAR(row->judgement.position_error, most, 1e-9 * most) << rate;
        EXPECT_FALSE(row->meets_steps);
    }
}

TEST(Sweep, StoppedAndGoneOnWithIsThatOfOneGo) {
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

TEST(Sweep, LeavesWhatIsDoneAlone) {
    Tradeoff tradeoff = whole_sweep();
    tradeoff.ladders[2].rows[0].judgement.position_error = 42;
    int climbed = 0;
    SweepWatch watch;
    watch.ladder_done = [&](const Tradeoff&) { ++climbed; };
    sweep(tradeoff, spring().scene, spring().reference, small_plan(), watch);
    EXPECT_EQ(climbed, 0);
    EXPECT_EQ(tradeoff.ladders[2].rows[0].judgement.position_error, 42);
}

TEST(Sweep, TellsHowFarItIs) {
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

TEST(TimeRows, TimesWhatIsStableAndChangesNoError) {
    Tradeoff tradeoff = whole_sweep();
    EXPECT_FALSE(tradeoff.timed());
    std::vector<TradeoffRow*> rows;
    for (Ladder& ladder : tradeoff.ladders)
        for (TradeoffRow& row : ladder.rows) rows.push_back(&row);
    time_rows(spring().scene, rows, 1, {});
    EXPECT_TRUE(tradeoff.timed());
    expect_same_errors(tradeoff, whole_sweep());
    for (const TradeoffRow* row : rows) {
        EXPECT_EQ(std::isnan(row->ns_per_second), !row->judgement.stable) << named(row->choice);
        EXPECT_FALSE(row->ns_per_second <= 0);
    }
}

// ---- where ladders end

const Ladder& ladder_of(const Tradeoff& tradeoff, const char* name, Precision precision) {
    for (const Ladder& ladder : tradeoff.ladders)
        if (ladder.method->name == name && ladder.precision == precision) return ladder;
    throw std::invalid_argument("no such ladder");
}

TEST(Ladder, EndsWhereTheReferenceCannotTell) {
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
    EXPECT_EQ(ladder.end, "the reference cannot tell smaller errors");
    ASSERT_GT(ladder.rows.size(), 1U);
    for (std::size_t i = 0; i < ladder.rows.size(); ++i)
        EXPECT_EQ(ladder.rows[i].judgement.below_floor(), i + 1 == ladder.rows.size()) << i;
}

// Of the last three aligned rows none was better by a tenth than the best before.
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

// Semi-implicit Euler evaluates once a step: 10 s at 400 Hz are 4000 evaluations, one body.
TEST(Ladder, EndsWhereARunIsTooMuchWork) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"semi_implicit_euler"});
    plan.precisions = {Precision::double_};
    plan.most_work = 4000;
    const Tradeoff tradeoff = swept(spring(), plan);
    const Ladder& ladder = tradeoff.ladders.front();
    EXPECT_EQ(ladder.end, "a run at higher rates is too much work");
    ASSERT_FALSE(ladder.rows.empty());
    EXPECT_EQ(ladder.rows.back().choice.rate, 400);
    EXPECT_EQ(ladder.rows.back().judgement.evaluations, 4000);
}

TEST(Ladder, EndsWhereNoMoreIsAskedFor) {
    const Ladder& ladder = ladder_of(whole_sweep(), "semi_implicit_euler", Precision::double_);
    EXPECT_EQ(ladder.end, "no higher rates were asked for");
    EXPECT_EQ(ladder.rows.back().choice.rate, 800);
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

TEST(Ladder, GoesOnPastWhatIsUnstable) {
    const Ladder& ladder = ladder_of(whole_sweep(), "velocity_verlet", Precision::double_);
    // Below ω·dt = 2 at 1.94 Hz it blows up.
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

// ---- what is best

TradeoffRow made_up(double error, double cost, bool stable = true) {
    TradeoffRow row{.choice = {&find_method("rk4"), 1, Precision::double_}};
    row.judgement.stable = stable;
    row.judgement.position_error = error;
    row.ns_per_second = cost;
    return row;
}

// A small generator of its own: few different values, so that there are ties.
class Dice {
public:
    int roll(int sides) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(sides));
    }

private:
    std::uint64_t state_ = 1;
};

using Point = std::pair<double, double>;  // cost, error

std::set<Point> undominated(const std::vector<Point>& points) {
    std::set<Point> best;
    for (const Point& one : points)
        if (std::none_of(points.begin(), points.end(), [&](const Point& other) {
                return other != one && other.first <= one.first && other.second <= one.second;
            }))
            best.insert(one);
    return best;
}

// What is below the floor counts as no error, what is unstable or untimed does not count at all.
TEST(Pareto, IsWhatNothingBeats) {
    Dice dice;
    for (int round = 0; round < 300; ++round) {
        Tradeoff tradeoff;
        tradeoff.ladders.resize(2);
        std::vector<Point> points;
        for (int i = dice.roll(15); i > 0; --i) {
            const double error = dice.roll(6) == 0 ? unknown : 1 + dice.roll(5);
            const double cost = dice.roll(6) == 0 ? unknown : 1 + dice.roll(5);
            const bool stable = dice.roll(6) != 0;
            tradeoff.ladders[static_cast<std::size_t>(i % 2)].rows.push_back(
                made_up(error, cost, stable));
            if (stable && !std::isnan(cost))
                points.push_back({cost, std::isnan(error) ? 0 : error});
        }
        const auto front = pareto(tradeoff, time_of);
        std::vector<Point> found;
        for (const TradeoffRow* row : front)
            found.push_back({row->ns_per_second,
                             row->judgement.below_floor() ? 0 : row->judgement.position_error});
        const std::set<Point> expected = undominated(points);
        EXPECT_EQ(found, std::vector<Point>(expected.begin(), expected.end())) << round;
    }
}

TEST(Pareto, GoesByTheCostThatIsAsked) {
    Tradeoff tradeoff;
    tradeoff.ladders.resize(1);
    tradeoff.ladders[0].rows = {made_up(1, 10), made_up(2, 20)};
    tradeoff.ladders[0].rows[0].judgement.evaluations = 5;
    tradeoff.ladders[0].rows[1].judgement.evaluations = 4;
    EXPECT_EQ(pareto(tradeoff, time_of).size(), 1U);
    EXPECT_EQ(pareto(tradeoff, evaluations_of).size(), 2U);
}

// ---- files

/// Numbers that are hard to write, in all places.
Tradeoff hard_numbers() {
    Tradeoff tradeoff = started(spring(), small_plan());
    tradeoff.duration = 0.1 + 0.2;
    tradeoff.title = "\"Quoted\", <b>µ</b>";
    tradeoff.reference.position_error = 5e-324;
    tradeoff.reference.velocity_error = 1.0 / 3;
    tradeoff.reference.floor = {1e-300, 2.0 / 3, 1.7976931348623157e308};
    tradeoff.reference.extent = std::nextafter(1.0, 2.0);
    tradeoff.reference.meaningful_until = 0.7 + 0.1;
    tradeoff.reference.period = std::acos(-1.0);
    tradeoff.machines.push_back({"other", 128, "cc 1.0"});
    for (std::size_t i = 0; i < 3; ++i) {
        Ladder& ladder = tradeoff.ladders[i];
        ladder.done = i != 1;
        ladder.end = ladder.done ? "so" : "";
        for (int rate = 1; rate < 20 && ladder.done; ++rate) {
            TradeoffRow row{.choice = {ladder.method, rate, ladder.precision},
                            .meets_steps = rate % 2 == 0,
                            .ns_per_second = std::exp(rate),
                            .ns_spread = rate % 3 == 0 ? unknown : 1.0 / rate};
            row.judgement = {.stable = rate % 5 != 0,
                             .position_error = rate % 4 == 0 ? unknown : std::sin(rate) * 1e-310,
                             .velocity_error = std::pow(7, -rate),
                             .phase_error = -0.0,
                             .energy_drift = std::nextafter(rate, 0.0),
                             .evaluations = std::sqrt(rate)};
            ladder.rows.push_back(row);
        }
    }
    return tradeoff;
}

TEST(TradeoffFile, ReadsBackToTheSameBits) {
    const Tradeoff written = hard_numbers();
    const Tradeoff read = parse_tradeoff(to_json(written), "tradeoff.json");
    expect_same_errors(read, written);
    EXPECT_EQ(read.scene, written.scene);
    EXPECT_EQ(read.title, written.title);
    EXPECT_EQ(read.fingerprint, written.fingerprint);
    EXPECT_EQ(read.duration, written.duration);
    EXPECT_EQ(read.today, written.today);
    EXPECT_EQ(read.looks, written.looks);
    EXPECT_EQ(read.machines, written.machines);
    EXPECT_EQ(read.reference.words, written.reference.words);
    EXPECT_EQ(read.reference.closed_form, written.reference.closed_form);
    EXPECT_TRUE(same(read.reference.position_error, written.reference.position_error));
    EXPECT_TRUE(same(read.reference.velocity_error, written.reference.velocity_error));
    EXPECT_TRUE(same(read.reference.floor.position, written.reference.floor.position));
    EXPECT_TRUE(same(read.reference.floor.velocity, written.reference.floor.velocity));
    EXPECT_TRUE(same(read.reference.floor.energy, written.reference.floor.energy));
    EXPECT_TRUE(same(read.reference.extent, written.reference.extent));
    EXPECT_TRUE(same(read.reference.meaningful_until, written.reference.meaningful_until));
    EXPECT_TRUE(same(read.reference.period, written.reference.period));
    for (std::size_t i = 0; i < written.rows().size(); ++i)
        EXPECT_TRUE(same_times(*read.rows()[i], *written.rows()[i])) << i;
    EXPECT_EQ(to_json(read), to_json(written));
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells{""};
    for (const char c : line) {
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

TEST(TradeoffFile, IsATableToo) {
    const Tradeoff tradeoff = hard_numbers();
    std::istringstream csv(to_csv(tradeoff));
    std::string line;
    std::getline(csv, line);
    const std::vector<std::string> names = cells_of(line);
    const auto front = pareto(tradeoff, time_of);
    ASSERT_FALSE(front.empty());
    std::size_t count = 0;
    for (; std::getline(csv, line); ++count) {
        ASSERT_LT(count, tradeoff.rows().size());
        const TradeoffRow& row = *tradeoff.rows()[count];
        const std::vector<std::string> cells = cells_of(line);
        ASSERT_EQ(cells.size(), names.size());
        const auto cell = [&](const std::string& name) {
            const auto at = std::find(names.begin(), names.end(), name);
            return at == names.end() ? "no column"
                                     : cells[static_cast<std::size_t>(at - names.begin())];
        };
        const auto number = [&](const std::string& name) {
            return cell(name).empty() ? unknown : std::strtod(cell(name).c_str(), nullptr);
        };
        EXPECT_EQ(cell("method"), row.choice.method->name);
        EXPECT_EQ(cell("rate"), std::to_string(row.choice.rate));
        EXPECT_EQ(cell("precision"), name_of(row.choice.precision));
        EXPECT_EQ(cell("stable"), row.judgement.stable ? "1" : "0");
        EXPECT_EQ(cell("meets_steps"), row.meets_steps ? "1" : "0");
        EXPECT_EQ(cell("below_floor"), row.judgement.below_floor() ? "1" : "0");
        EXPECT_EQ(cell("pareto"),
                  std::find(front.begin(), front.end(), &row) != front.end() ? "1" : "0");
        EXPECT_TRUE(same(number("position_error"), row.judgement.position_error)) << line;
        EXPECT_TRUE(same(number("velocity_error"), row.judgement.velocity_error)) << line;
        EXPECT_TRUE(same(number("phase_error"), row.judgement.phase_error)) << line;
        EXPECT_TRUE(same(number("energy_drift"), row.judgement.energy_drift)) << line;
        EXPECT_TRUE(same(number("evaluations"), row.judgement.evaluations)) << line;
        EXPECT_TRUE(same(number("ns_per_second"), row.ns_per_second)) << line;
        EXPECT_TRUE(same(number("ns_spread"), row.ns_spread)) << line;
    }
    EXPECT_EQ(count, tradeoff.rows().size());
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

TEST(TradeoffFile, RubbishIsRefusedInOneLineThatNamesIt) {
    const std::string good = to_json(hard_numbers());
    (void)parse_tradeoff(good, "a.json");
    const std::vector<std::string> bad{
        "",
        "{",
        "[]",
        "null",
        "\n\n\xff\xfe",
        "{\"oiler\": 3}",
        good.substr(0, good.size() / 2),
        replaced(good, "\"rows\"", "\"rowz\""),
        replaced(good, "\"ladders\"", "\"ladder\""),
        replaced(good, "\"duration\": ", "\"duration\": \"x\", \"d\": "),
        replaced(good, "\"explicit_euler\"", "\"explicit_eulr\""),
        replaced(good, "\"float\"", "\"flaot\""),
        replaced(good, "\"stable\": true", "\"stable\": 1"),
        replaced(good, "\"rate\": 1,", "\"rate\": \"1\","),
    };
    for (const std::string& text : bad)
        expect_usage([&] { (void)parse_tradeoff(text, "a.json"); },
                     holds(text, "explicit_eulr") ? "explicit_eulr" : "a.json");
}

TEST(TradeoffFile, OfAnotherVersionIsRefused) {
    const std::string version_now(version());
    expect_usage(
        [&] {
            (void)parse_tradeoff(
                replaced(to_json(hard_numbers()), "\"" + version_now + "\"", "\"0.0.1\""),
                "a.json");
        },
        "0.0.1");
}

// ---- the fingerprint

TEST(Fingerprint, IsOfAllThatDecidesOnErrors) {
    const auto print = [](const std::string& text, const SweepPlan& plan, double duration) {
        Scene scene = parse_scene(text, "test.toml");
        if (duration > 0) scene.duration = duration;
        return fingerprint(text, scene, looks_of(scene), plan);
    };
    const SweepPlan plan = small_plan();
    std::set<std::string> prints{print(article_spring, plan, 0)};
    EXPECT_EQ(print(article_spring, plan, 0), *prints.begin());
    EXPECT_EQ(print(article_spring, plan, 10), *prints.begin());
    prints.insert(print(article_spring + "# another\n", plan, 0));
    prints.insert(print(article_spring, plan, 9));
    prints.insert(print(article_spring, plan, 10.00000001));
    SweepPlan other = plan;
    other.methods.pop_back();
    prints.insert(print(article_spring, other, 0));
    std::swap(other.methods[0], other.methods[1]);
    prints.insert(print(article_spring, other, 0));
    other = plan;
    other.max_rate = 801;
    prints.insert(print(article_spring, other, 0));
    other = plan;
    other.most_work = 1e8;
    prints.insert(print(article_spring, other, 0));
    EXPECT_EQ(prints.size(), 8U);
    // All parts of one sweep have the same.
    other = plan;
    other.shard = 2;
    other.shards = 4;
    EXPECT_EQ(prints.count(print(article_spring, other, 0)), 1U);
}

TEST(Fingerprint, IsOfThePrecisionsToo) {
    const Scene scene = parse_scene(article_spring, "test.toml");
    SweepPlan plan = small_plan();
    plan.precisions = {Precision::single};
    const std::string single = fingerprint(article_spring, scene, looks_of(scene), plan);
    plan.precisions = {Precision::double_};
    EXPECT_NE(fingerprint(article_spring, scene, looks_of(scene), plan), single);
}

}  // namespace
}  // namespace oiler::test
