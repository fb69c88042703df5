// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff.hpp"

#include "lab/motions.hpp"
#include "lab/tradeoffs.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "support/test.hpp"

namespace oiler::test {
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

// ---- rates

std::vector<std::int64_t> rates_at(std::int64_t rate, std::int64_t most) {
    Scene scene;
    scene.stepping.rate.steps = rate;
    return sweep_rates(scene, most);
}

/// Whether a rate is `base` times a power of two.
bool is_doubled(std::int64_t rate, std::int64_t base) {
    while (rate > base && rate % 2 == 0) rate /= 2;
    return rate == base;
}

class Rungs : public testing::TestWithParam<std::pair<std::int64_t, std::int64_t>> {};

TEST_P(Rungs, AreDivisorsOf60AndDoublingsOf60And90) {
    const auto [own, most] = GetParam();
    const std::vector<std::int64_t> all = rates_at(own, most);
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), std::less_equal{}));
    for (std::int64_t rate = 1; rate <= 2 * std::max(own, most); ++rate) {
        const bool is_included =
            rate == own ||
            (rate <= most && (60 % rate == 0 || is_doubled(rate, 60) || is_doubled(rate, 90)));
        EXPECT_EQ(std::count(all.begin(), all.end(), rate), is_included) << rate;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Rungs,
                         testing::Values(std::pair{100, 3200}, std::pair{60, 3840},
                                         std::pair{1000, 500}, std::pair{1, 1}, std::pair{144, 89},
                                         std::pair{7, 90}, std::pair{90, 61'440},
                                         std::pair{60, 500}, std::pair{600, 250},
                                         std::pair{100, 10}, std::pair{60, 7}));

// The scene's own 1 Hz is always a rate.
TEST(RungsAt, TheLimitItselfIsOne) {
    for (const std::int64_t most : {2, 10, 30, 60, 90, 120, 180, 240, 360, 480, 720, 960}) {
        const std::vector<std::int64_t> all = rates_at(1, most);
        EXPECT_EQ(all.back(), most);
        EXPECT_LT(rates_at(1, most - 1).back(), most);
        // The rates below do not depend on the limit.
        EXPECT_EQ(std::vector(all.begin(), all.end() - 1), rates_at(1, most - 1));
    }
}

// ---- sweeping

TEST(Sweep, TakesTheRatesOfEachSeriesInOrder) {
    const std::vector<std::int64_t> rates = sweep_rates(spring().scene, 800);
    EXPECT_TRUE(whole_sweep().complete());
    EXPECT_EQ(whole_sweep().all_series.size(), 12U);
    EXPECT_EQ(whole_sweep().current,
              (Stepping{&find_method("semi_implicit_euler"), {100}, Precision::double_}));
    for (const RateSeries& series : whole_sweep().all_series) {
        EXPECT_FALSE(series.rows.empty());
        for (std::size_t i = 0; i < series.rows.size(); ++i)
            EXPECT_EQ(series.rows[i].stepping,
                      (Stepping{series.method, {rates[i]}, series.precision}));
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

// Errors between steps are known to 1 %.
TEST(Sweep, HasTheErrorsOfTheArticlesLines) {
    for (const int rate : {10, 20, 60, 100}) {
        const ArticleErrors expected(rate);
        const TradeoffRow* row =
            whole_sweep().find({&find_method("semi_implicit_euler"), {rate}, Precision::double_});
        ASSERT_NE(row, nullptr);
        EXPECT_NEAR(row->judgement.step_error, expected.at_steps, 1e-9 * expected.at_steps) << rate;
        EXPECT_NEAR(row->judgement.position_error, expected.as_drawn, 0.01 * expected.as_drawn)
            << rate;
    }
}

// Exact steps are connected by chords. A chord deviates most from an oscillation of amplitude A at
// its turning points, by up to A(1 − cos(ω·dt/2)). The first turning point is the start; a chord
// that begins there deviates by almost as much.
TEST(Sweep, HasTheErrorsOfChordsBetweenExactSteps) {
    const double w = std::sqrt(15 - 0.05 * 0.05);
    for (const int rate : {10, 60, 360}) {
        const TradeoffRow* row =
            whole_sweep().find({&find_method("exact"), {rate}, Precision::double_});
        ASSERT_NE(row, nullptr);
        const double most = 1000 * (1 - std::cos(w / (2.0 * rate)));
        EXPECT_LE(row->judgement.position_error, 1.01 * most) << rate;
        EXPECT_GE(row->judgement.position_error, 0.9 * most) << rate;
        EXPECT_FALSE(row->judgement.step_error > 1e-9) << rate;
    }
}

TEST(Sweep, StoppedAndResumedEqualsAnUninterruptedOne) {
    for (const int all_series : {1, 4, 7}) {
        Tradeoff tradeoff = started(spring(), small_plan());
        int done = 0;
        bool stopped = false;
        SweepWatch watch;
        watch.series_done = [&](const Tradeoff&) { stopped = ++done >= all_series; };
        watch.stopped = [&] { return stopped; };
        sweep(tradeoff, spring().scene, spring().reference, small_plan(), watch);
        EXPECT_FALSE(tradeoff.complete());
        Tradeoff read = parse_tradeoff(file_text(tradeoff), "tradeoff.json");
        expect_same_errors(read, tradeoff);
        sweep(read, spring().scene, spring().reference, small_plan(), {});
        EXPECT_TRUE(read.complete());
        expect_same_errors(read, whole_sweep());
    }
}

TEST(Sweep, KeepsFinishedSeries) {
    Tradeoff tradeoff = whole_sweep();
    tradeoff.all_series[2].rows[0].judgement.position_error = 42;
    int measured = 0;
    SweepWatch watch;
    watch.series_done = [&](const Tradeoff&) { ++measured; };
    sweep(tradeoff, spring().scene, spring().reference, small_plan(), watch);
    EXPECT_EQ(measured, 0);
    EXPECT_EQ(tradeoff.all_series[2].rows[0].judgement.position_error, 42);
}

TEST(Sweep, ReportsItsProgress) {
    SweepPlan plan = small_plan();
    plan.max_rate = 50;
    Tradeoff tradeoff = started(spring(), plan);
    std::vector<double> shares;
    SweepWatch watch;
    watch.progress = [&](double share) { shares.push_back(share); };
    sweep(tradeoff, spring().scene, spring().reference, plan, watch);
    EXPECT_EQ(shares.size(), tradeoff.all_series.size());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.front(), 0);
    EXPECT_NEAR(shares.back(), 1, 1e-12);
}

TEST(TimeRows, TimesStableRowsAndChangesNoError) {
    Tradeoff tradeoff = whole_sweep();
    EXPECT_FALSE(tradeoff.timed());
    std::vector<TradeoffRow*> rows;
    for (RateSeries& series : tradeoff.all_series)
        for (TradeoffRow& row : series.rows) rows.push_back(&row);
    SweepWatch watch;
    watch.ns_of_frames = made_up_clock([](const Stepping&) { return 3.0; }).ns_of_frames;
    watch.ns_per_step_together = [](const auto&, const auto&, const auto&) { return 2.0; };
    time_rows(spring().scene, rows, 1, watch);
    EXPECT_TRUE(tradeoff.timed());
    expect_same_errors(tradeoff, whole_sweep());
    for (const TradeoffRow* row : rows) {
        const auto rate = static_cast<double>(row->stepping.rate.steps);
        EXPECT_EQ(std::isnan(row->ns_per_second), !row->judgement.stable) << named(row->stepping);
        if (!row->judgement.stable) continue;
        EXPECT_NEAR(row->ns_per_second, 3 * rate, 1e-9 * rate);
        EXPECT_EQ(row->ns_together, 2 * rate);
    }
}

// ---- where series end

const RateSeries& series_of(const Tradeoff& tradeoff, const char* name, Precision precision) {
    for (const RateSeries& series : tradeoff.all_series)
        if (series.method->name == name && series.precision == precision) return series;
    throw std::invalid_argument("no such series");
}

// The distance of 0.8 m oscillates around 0.5 m with ω² = 2·15/s², each body with 0.15 m. The
// chords of exact steps deviate by up to 0.15 m·ω²·dt²/8: 1.6e-4 m at 60 Hz, 0.7e-4 m at 90 Hz.
TEST(RateSeries, EndsBelowTheFloorOfTheReference) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"kahan_li8_kdk"});
    MeasuredScene rough(
        "[scene]\naxes = 1\nrate = 60\nduration = 3.0\n[[body]]\nname = \"a\"\n"
        "position = [1.0]\n[[body]]\nname = \"b\"\nposition = [1.8]\n[[spring]]\nbody = \"a\"\n"
        "to = \"b\"\nstiffness = 15.0\nrest_length = 0.5\n",
        {.wanted = 1e-9});
    // An own error of 1e-6 m is a floor of 1e-4 m.
    for (Uncertainty& uncertainty : rough.reference.uncertainties) uncertainty.position = 1e-6;
    const Tradeoff tradeoff = swept(rough, plan);
    const RateSeries& series = series_of(tradeoff, "kahan_li8_kdk", Precision::double_);
    EXPECT_EQ(series.end, "smaller errors are below the reference's floor");
    ASSERT_GT(series.rows.size(), 1U);
    EXPECT_EQ(series.rows.back().stepping.rate.steps, 90);
    for (std::size_t i = 0; i < series.rows.size(); ++i)
        EXPECT_EQ(series.rows[i].judgement.below_floor(), i + 1 == series.rows.size()) << i;
}

// The chords of exact steps deviate by up to 1000 m·15/s²·dt²/8, which is below 10⁻⁶ of the extent
// of 1960 m from 978 Hz on: 2.03e-3 m at 960 Hz, 0.90e-3 m at 1440 Hz.
TEST(RateSeries, EndsWhereDrawnLinesAloneAreWrong) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"exact"});
    plan.max_rate = 10'000;
    const Tradeoff tradeoff = swept(spring(), plan);
    const RateSeries& series = series_of(tradeoff, "exact", Precision::double_);
    EXPECT_EQ(series.end, "smaller errors are those of the drawn lines, equal for all methods");
    EXPECT_EQ(series.rows.back().stepping.rate.steps, 1440);
    EXPECT_NEAR(series.rows.back().judgement.position_error, 15e3 / 8 / 1440 / 1440, 1e-5);
}

// None of the last three rows improved on the best by a tenth, and in double the same runs have
// less than half the error.
TEST(RateSeries, EndsAtRoundOff) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"rk4"});
    plan.max_rate = 1'000'000;
    const Tradeoff tradeoff = swept(spring(), plan);
    const RateSeries& series = series_of(tradeoff, "rk4", Precision::single);
    EXPECT_EQ(series.end, "round-off keeps errors from falling");
    std::vector<double> errors;
    for (const TradeoffRow& row : series.rows)
        if (row.judgement.stable && row.judgement.position_error < 0.1 * spring().reference.extent)
            errors.push_back(row.judgement.position_error);
    ASSERT_GT(errors.size(), 4U);
    const double best = *std::min_element(errors.begin(), errors.end() - 3);
    EXPECT_GE(*std::min_element(errors.end() - 3, errors.end()), 0.9 * best);
    EXPECT_LT(*(errors.end() - 4), 0.9 * *std::min_element(errors.begin(), errors.end() - 4));
    // 24 bits of 1000 m are 6e-5 m; thousands of roundings leave some hundred times that.
    EXPECT_LT(best, 0.1);
    const Stepping in_double{series.method, series.rows.back().stepping.rate, Precision::double_};
    EXPECT_LT(judge(spring().scene, Settings{in_double}, spring().reference).position_error,
              errors.back() / 2);
}

// A spring of ω = 100·2π rad/s at 1 to 30 Hz: implicit midpoint is stable, but errors of about the
// amplitude have not begun to fall. That is not round-off. At 61,440 Hz a phase of ω·(ω·dt)²/12 rad
// per second is lost.
TEST(RateSeries, WithErrorsThatHaveNotBegunToFallGoesOn) {
    SweepPlan plan{.methods = methods_of({"implicit_midpoint"}),
                   .precisions = {Precision::double_},
                   .max_rate = 61'440};
    const MeasuredScene fast(one_axis + "duration = 0.5\n" + on_spring(1, 394784));
    const Tradeoff tradeoff = swept(fast, plan);
    const RateSeries& series = tradeoff.all_series.front();
    ASSERT_GT(series.rows.size(), 12U);
    for (std::size_t i = 0; i < 11; ++i)
        EXPECT_GT(series.rows[i].judgement.position_error, 0.5) << i;
    const double w = std::sqrt(394784.0);
    const double lost = 0.5 * w * (w / 61'440) * (w / 61'440) / 12;
    EXPECT_EQ(series.rows.back().stepping.rate.steps, 61'440);
    EXPECT_NEAR(series.rows.back().judgement.position_error, lost, 0.02 * lost);
}

// Semi-implicit Euler evaluates forces once per step: 10 s of one body at 360 Hz are 3600.
TEST(RateSeries, EndsWhereARunIsTooMuchWork) {
    SweepPlan plan = small_plan();
    plan.methods = methods_of({"semi_implicit_euler"});
    plan.precisions = {Precision::double_};
    plan.most_work = 3600;
    const Tradeoff tradeoff = swept(spring(), plan);
    const RateSeries& series = tradeoff.all_series.front();
    EXPECT_EQ(series.end, "a run at higher rates is too much work");
    ASSERT_FALSE(series.rows.empty());
    EXPECT_EQ(series.rows.back().stepping.rate.steps, 360);
    EXPECT_EQ(series.rows.back().judgement.evaluations, 3600);
}

/// The last rate of explicit Euler's series on a spring, without a given limit.
std::int64_t last_rate_on(double stiffness, const std::string& duration) {
    const MeasuredScene brief(one_axis + "duration = " + duration + "\n" + on_spring(1, stiffness));
    const Tradeoff tradeoff = swept(
        brief, {.methods = methods_of({"explicit_euler"}), .precisions = {Precision::double_}});
    EXPECT_EQ(tradeoff.all_series.front().end, "the highest rate of the sweep was reached");
    return tradeoff.all_series.front().rows.back().stepping.rate.steps;
}

// Without a limit, rates go to 1024 × 60 Hz, or to 64 × 48 per period of the fastest motion: with
// 100 periods per second to 307,200 Hz, below which 60·2¹² Hz is the highest rate.
TEST(RateSeries, GoesUpToTheFastestMotionWhereNoLimitIsGiven) {
    EXPECT_EQ(last_rate_on(15, "2.0"), 61'440);
    EXPECT_EQ(last_rate_on(394784, "0.2"), 245'760);
}

TEST(RateSeries, EndsAtTheHighestRateOfThePlan) {
    const RateSeries& series = series_of(whole_sweep(), "semi_implicit_euler", Precision::double_);
    EXPECT_EQ(series.end, "the highest rate of the sweep was reached");
    EXPECT_EQ(series.rows.back().stepping.rate.steps, 720);
}

TEST(RateSeries, OfAMethodThatCannotStepTheSceneSaysWhy) {
    const MeasuredScene orbit(
        "[scene]\naxes = 2\nrate = 100\nduration = 3.0\n[[attractor]]\nposition = [0.0, 0.0]\ngm = "
        "1.0\n"
        "[[body]]\nposition = [1.0, 0.0]\nvelocity = [0.0, 1.0]\n");
    SweepPlan plan{.methods = methods_of({"exact", "velocity_verlet"}), .max_rate = 100};
    const Tradeoff tradeoff = swept(orbit, plan);
    EXPECT_TRUE(tradeoff.complete());
    for (const Precision precision : plan.precisions) {
        const RateSeries& series = series_of(tradeoff, "exact", precision);
        EXPECT_TRUE(series.rows.empty());
        EXPECT_TRUE(holds(series.end, "exact"));
        EXPECT_TRUE(holds(series.end, "attractor"));
        EXPECT_FALSE(series_of(tradeoff, "velocity_verlet", precision).rows.empty());
    }
}

TEST(RateSeries, ContinuesPastUnstableRates) {
    const RateSeries& series = series_of(whole_sweep(), "velocity_verlet", Precision::double_);
    // Below 1.94 Hz, where ω·dt = 2, it is unstable.
    EXPECT_FALSE(series.rows.front().judgement.stable);
    EXPECT_TRUE(std::isnan(series.rows.front().judgement.position_error));
    EXPECT_TRUE(series.rows.back().judgement.stable);
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
        EXPECT_EQ(part.all_series.size(), whole_sweep().all_series.size());
        EXPECT_EQ(std::count_if(part.all_series.begin(), part.all_series.end(),
                                [](const RateSeries& series) { return series.done; }),
                  3);
        rows += part.rows().size();
    }
    EXPECT_EQ(rows, whole_sweep().rows().size());
    const Tradeoff merged = merge(parts);
    expect_same_errors(merged, whole_sweep());
    EXPECT_EQ(file_text(merged), file_text(whole_sweep()));
    EXPECT_EQ(file_text(merge({parts[2], parts[0], parts[3], parts[1]})), file_text(whole_sweep()));
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
    const auto expect_refused = [](const std::function<void(Tradeoff&)>& change) {
        std::vector<Tradeoff> wrong = shards_of(2);
        wrong[0].file = "a.json";
        wrong[1].file = "b.json";
        change(wrong[1]);
        expect_usage([&] { (void)merge(wrong); }, "b.json: not of one sweep with a.json");
    };
    expect_refused([](Tradeoff& part) { part.fingerprint = "another"; });
    expect_refused([](Tradeoff& part) { part.scene = "another"; });
    expect_refused([](Tradeoff& part) { part.title = "another"; });
    expect_refused([](Tradeoff& part) { part.duration *= 2; });
    expect_refused([](Tradeoff& part) { part.current.rate.steps *= 2; });
    expect_refused([](Tradeoff& part) { part.reference.extent *= 2; });
    expect_refused([](Tradeoff& part) { part.all_series.pop_back(); });
    expect_refused([](Tradeoff& part) { std::swap(part.all_series[0], part.all_series[2]); });
}

TEST(Merge, RefusesAPartThatIsGivenTwice) {
    std::vector<Tradeoff> parts = shards_of(3);
    parts.push_back(parts[1]);
    parts[1].file = "b.json";
    parts[3].file = "copy.json";
    expect_usage([&] { (void)merge(parts); }, "copy.json: explicit_euler in double is in b.json");
}

TEST(Merge, RefusesWhereAPartIsMissing) {
    std::vector<Tradeoff> parts = shards_of(4);
    for (std::size_t i = 0; i < 4; ++i) parts[i].file = std::to_string(i) + ".json";
    parts.erase(parts.begin() + 1);
    expect_usage(
        [&] { (void)merge(parts); },
        "0.json, 2.json, 3.json: 3 of 12 ladders (methods × precisions) are missing, first "
        "explicit_euler in double");
}

}  // namespace
}  // namespace oiler::test
