// SPDX-License-Identifier: MIT
// Costs of rows from a made-up clock, so that each number is known.
#include "lab/measured_scenes.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

TradeoffRow row_at(std::int64_t rate, bool stable = true) {
    TradeoffRow row{.stepping = {&find_method("rk4"), {rate}, Precision::double_}};
    row.judgement.stable = stable;
    return row;
}

/// A watch whose costs at many steps per call are 1 ns.
SweepWatch quick_watch() {
    SweepWatch watch;
    watch.ns_per_step_together = [](const auto&, const auto&) { return 1.0; };
    return watch;
}

/// A clock that returns these costs of a step in turn, and repeats.
SweepWatch clock_of(const std::vector<double>& ns) {
    SweepWatch watch = quick_watch();
    watch.ns_per_step = [ns, calls = std::size_t{0}](const auto&, const auto&,
                                                     std::int64_t) mutable {
        return ns[calls++ % ns.size()];
    };
    return watch;
}

void time_row(TradeoffRow& row, int rounds, const SweepWatch& watch) {
    const Scene scene;
    time_rows(scene, {&row}, rounds, watch);
}

// Sorted: 1, 2, 3, 4 and 100 ns. The median is 3 ns, the quartiles are 2 and 4 ns: half the
// interquartile range is 1 ns. 50 Hz are 50 steps per second.
TEST(TimeRow, HasTheMedianAndHalfTheInterquartileRange) {
    TradeoffRow row = row_at(50);
    time_row(row, 5, clock_of({4, 1, 100, 3, 2}));
    EXPECT_DOUBLE_EQ(row.ns_per_second, 50 * 3);
    EXPECT_DOUBLE_EQ(row.ns_spread, 50 * 1);
    EXPECT_DOUBLE_EQ(row.ns_together, 50 * 1);
}

// The quartiles of 10 and 20 ns are 12.5 and 17.5 ns.
TEST(TimeRow, HasQuartilesBetweenTwoMeasurements) {
    TradeoffRow row = row_at(1);
    time_row(row, 2, clock_of({20, 10}));
    EXPECT_DOUBLE_EQ(row.ns_per_second, 15);
    EXPECT_DOUBLE_EQ(row.ns_spread, 2.5);
}

TEST(TimeRow, ReplacesItsTimesIfTimedAgain) {
    TradeoffRow row = row_at(10);
    time_row(row, 3, clock_of({500, 700, 900}));
    time_row(row, 3, clock_of({6, 6, 6}));
    EXPECT_DOUBLE_EQ(row.ns_per_second, 60);
    EXPECT_EQ(row.ns_spread, 0);
}

// Rows take turns, so that a slowdown of the machine affects all of them.
TEST(TimeRows, TakeTurns) {
    TradeoffRow first = row_at(1);
    TradeoffRow unstable = row_at(1, false);
    TradeoffRow second = row_at(1);
    const Scene scene;
    time_rows(scene, {&first, &unstable, &second}, 3, clock_of({1, 10, 2, 20, 3, 30}));
    EXPECT_EQ(first.ns_per_second, 2);
    EXPECT_EQ(second.ns_per_second, 20);
    EXPECT_TRUE(std::isnan(unstable.ns_per_second));
}

// A frame of 1/60 s has four steps at 240 Hz, and one or none at 30 Hz. At 150 Hz, frames of two
// and of three steps alternate. The made-up step costs as many ns as its frame has steps, at most
// 256.
TEST(TimeRow, HasTheCostOfAGamesFrames) {
    SweepWatch watch = quick_watch();
    watch.ns_per_step = [](const auto&, const auto&, std::int64_t per_frame) {
        return static_cast<double>(per_frame);
    };
    for (const auto& [rate, ns] :
         std::vector<std::pair<std::int64_t, double>>{{30, 30 * 1},
                                                      {60, 60 * 1},
                                                      {120, 120 * 2},
                                                      {150, 30 * 2 * 2 + 30 * 3 * 3},
                                                      {240, 240 * 4},
                                                      {15'360, 15'360 * 256},
                                                      {60'000, 60'000 * 256}}) {
        TradeoffRow row = row_at(rate);
        time_row(row, 1, watch);
        EXPECT_NEAR(row.ns_per_second, ns, 1e-9 * ns) << rate;
    }
}

// 119 Hz must not cost more than 120 Hz if all steps cost the same.
TEST(TimeRow, GrowsWithTheRate) {
    SweepWatch watch = quick_watch();
    watch.ns_per_step = [](const auto&, const auto&, std::int64_t) { return 10.0; };
    double before = 0;
    for (std::int64_t rate = 1; rate < 400; ++rate) {
        TradeoffRow row = row_at(rate);
        time_row(row, 1, watch);
        EXPECT_NEAR(row.ns_per_second, 10.0 * static_cast<double>(rate), 1e-6);
        EXPECT_GT(row.ns_per_second, before);
        before = row.ns_per_second;
    }
}

// The clock gets the row's method, rate and precision.
TEST(TimeRow, IsTimedWithItsOwnSetting) {
    const Stepping choice{&find_method("velocity_verlet"), {75}, Precision::single};
    Stepping timed;
    SweepWatch watch = quick_watch();
    watch.ns_per_step = [&](const auto&, const Settings& given, std::int64_t) {
        timed = given.stepping;
        return 1.0;
    };
    TradeoffRow row{.stepping = choice};
    time_row(row, 1, watch);
    EXPECT_EQ(timed, choice);
}

}  // namespace
}  // namespace oiler::test
