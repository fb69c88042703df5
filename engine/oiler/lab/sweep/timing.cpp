// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "oiler/core/error.hpp"
#include "oiler/core/timing.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t frames_per_second = 60;
/// Frames are timed in groups, spread over the duration.
constexpr std::int64_t most_groups = 32;
constexpr std::int64_t frames_of_group = 16;
/// The largest number of steps in a call. More cost no less per step.
constexpr std::int64_t most_steps = 256;
/// Whole runs of a scene are repeated for this time, s.
constexpr double least_repeating = 1e-3;
/// A setting is timed three times, if that takes no longer than four times this time, s; more often
/// until this time.
constexpr double patience = 0.5;
constexpr std::size_t fewest_rounds = 3;
/// The cost of a step from several starts is measured for this time, s, from two starts at least.
constexpr double most_starting = 20e-3;
constexpr double most_of_start = 200e-6;

/// The time that two readings of the clock take, s.
double clock_time() {
    static const double least = [] {
        double time = INFINITY;
        for (int i = 0; i < 1000; ++i) time = std::min(time, seconds_since(Clock::now()));
        return time;
    }();
    return least;
}

/// Whether the clock shows a single frame.
bool has_fine_clock() { return clock_step() < 1e-6; }

/// The mean time of work(), s, over as many calls as a coarse clock needs to show it to 2 %.
/// `unknown` if it returns false.
template <class Work>
double mean_seconds(Work work) {
    constexpr int clock_steps = 50;
    double passed = 0;
    std::int64_t calls = 0;
    for (const Clock::time_point begin = Clock::now(); passed < clock_steps * clock_step();
         passed = seconds_since(begin), ++calls)
        if (!work()) return unknown;
    return passed / static_cast<double>(calls);
}

/// The time of run(world), s, for a world that is equal to `start`.
template <class Run>
double seconds_of(const World& start, Run run) {
    World world = start;
    if (has_fine_clock()) {
        const Clock::time_point begin = Clock::now();
        return run(world) ? seconds_since(begin) : unknown;
    }
    // Another program may have slowed the copying alone.
    double time = 0;
    for (int tries = 0; tries < 3 && time <= 0; ++tries) {
        const double both = mean_seconds([&] {
            world = start;
            return run(world);
        });
        time = both - mean_seconds([&] {
                   world = start;
                   return true;
               });
    }
    return time < 0 ? 0 : time;  // `unknown` stays
}

/// The work of a game between two frames: it replaces the fastest cache's content.
class FrameWork {
public:
    void run() {
        for (std::size_t i = 0; i < memory_.size(); i += line) memory_[i] = memory_[i] + 1;
    }

private:
    static constexpr std::size_t line = 64;  // bytes
    std::vector<unsigned char> memory_ = std::vector<unsigned char>(64 * 1024);
};

/// A game's frame: steps one by one, with a body read after each. Returns false for a divergence.
bool play_frame(World& world, std::int64_t steps) {
    double seen = 0;
    for (std::int64_t step = 0; step < steps; ++step) {
        if (world.try_step()) return false;
        seen += world.position_of_row(0)[0];
    }
    asm volatile("" : : "g"(seen));  // the compiler must not drop the readings
    return true;
}

/// Returns ns, `unknown` for a divergence.
double ns_of_frame(World& world, std::int64_t steps) {
    const Clock::time_point begin = Clock::now();
    if (!play_frame(world, steps)) return unknown;
    return 1e9 * std::max(0.0, seconds_since(begin) - clock_time());
}
/// The mean over these steps of a run, ns: what a coarse clock shows. `unknown` for a divergence
/// and if stopped.
double mean_ns_of_step(
    const World& start, std::int64_t steps,
    const std::function<bool()>& stopped = [] { return false; }) {
    const double seconds = seconds_of(start, [&](World& world) {
        for (std::int64_t step = 0; step < steps; ++step)
            if (stopped() || !play_frame(world, 1)) return false;
        return true;
    });
    return 1e9 * seconds / static_cast<double>(steps);
}

FrameMeasure timed() {
    return [between = FrameWork()](World& world, std::int64_t steps) mutable {
        between.run();
        return ns_of_frame(world, steps);
    };
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The frames of a second that have a step.
std::int64_t frames_with_steps(const Rate& rate) { return std::min(rate.steps, frames_per_second); }

std::int64_t steps_of(const Scene& scene, const Rate& rate) {
    const double steps = scene.duration * static_cast<double>(rate.steps);
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(steps));
}

/// Steps as far as a tick in calls of many steps. Returns false for a divergence and if stopped.
bool step_to(World& world, std::int64_t tick, const std::function<bool()>& stopped) {
    while (world.tick() < tick) {
        if (stopped() || world.try_step(std::min(most_steps, tick - world.tick()))) return false;
    }
    return true;
}

/// The times of one row: of each frame, in each round.
class RowTimes {
public:
    RowTimes(TradeoffRow& row) : row_(row) {}

    void add_round(const Scene& scene, const SweepWatch& watch) {
        if (seconds_ > (rounds_.size() < fewest_rounds ? 4 * patience : patience)) return;
        const Clock::time_point begin = Clock::now();
        rounds_.push_back(watch.ns_of_frames(scene, Settings{row_.stepping}, watch.stopped));
        seconds_ += seconds_since(begin);
    }
    /// A frame's time is its median over the rounds, so that other programs disturb none.
    void conclude() {
        const auto frames = static_cast<double>(frames_with_steps(row_.stepping.rate));
        std::vector<double> means;
        for (const std::vector<double>& round : rounds_)
            if (!round.empty()) means.push_back(mean_of(round));
        if (means.empty()) return;
        std::vector<double> medians;
        for (std::size_t frame = 0; frame < rounds_.front().size(); ++frame) {
            std::vector<double> times;
            for (const std::vector<double>& round : rounds_)
                if (frame < round.size()) times.push_back(round[frame]);
            medians.push_back(median_of(std::move(times)).value);
        }
        row_.ns_per_second = frames * mean_of(medians);
        row_.ns_worst_frame = *std::ranges::max_element(medians);
        row_.ns_spread = frames * median_of(std::move(means)).spread;
    }
    [[nodiscard]] TradeoffRow& row() const { return row_; }

private:
    TradeoffRow& row_;
    std::vector<std::vector<double>> rounds_;
    double seconds_ = 0;
};

}  // namespace

std::vector<double> measure_frames(const Scene& scene, const Settings& settings,
                                   const std::function<bool()>& stopped,
                                   const FrameMeasure& measure) {
    World world = make_world(scene, settings);
    if (world.body_count() == 0) return {};
    const std::int64_t rate = settings.stepping.rate.steps;
    const std::int64_t per_second = frames_with_steps(settings.stepping.rate);
    const auto tick_of = [&](std::int64_t frame) { return frame * rate / per_second; };
    const auto frames = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(scene.duration * static_cast<double>(per_second)));
    const std::int64_t groups =
        std::min(most_groups, (frames + frames_of_group - 1) / frames_of_group);
    std::vector<double> measured;
    for (std::int64_t group = 0; group < groups; ++group) {
        const std::int64_t first = group * frames / groups;
        const std::int64_t last = std::min(first + frames_of_group, (group + 1) * frames / groups);
        if (!step_to(world, tick_of(first), stopped)) break;
        for (std::int64_t frame = first; frame < last && !stopped(); ++frame) {
            const double cost = measure(world, tick_of(frame + 1) - tick_of(frame));
            if (std::isnan(cost)) return measured;
            measured.push_back(cost);
        }
    }
    return measured;
}

std::vector<double> ns_of_frames(const Scene& scene, const Settings& settings,
                                 const std::function<bool()>& stopped) try {
    if (has_fine_clock()) return measure_frames(scene, settings, stopped, timed());
    const World start = make_world(scene, settings);
    const Rate& rate = settings.stepping.rate;
    const double step =
        start.body_count() == 0 ? unknown : mean_ns_of_step(start, steps_of(scene, rate), stopped);
    if (std::isnan(step)) return {};
    return {step * static_cast<double>(rate.steps) / static_cast<double>(frames_with_steps(rate))};
} catch (const Error&) {
    return {};
}

double ns_per_step(const std::vector<World>& starts, const Stepping& choice,
                   std::int64_t per_frame) try {
    constexpr std::size_t most_frames = 5;
    constexpr std::size_t fewest_starts = 2;
    constexpr std::int64_t steps_of_start = 64;  // with a coarse clock
    FrameMeasure measure = timed();
    std::vector<double> costs;
    const Clock::time_point begin = Clock::now();
    for (const World& start : starts) {
        if (costs.size() >= fewest_starts && seconds_since(begin) > most_starting) break;
        World world = start;
        world.set_stepping(choice);
        if (world.try_step()) continue;
        if (!has_fine_clock()) {
            if (const double step = mean_ns_of_step(world, steps_of_start); std::isfinite(step))
                costs.push_back(step * static_cast<double>(per_frame));
            continue;
        }
        std::vector<double> times;
        for (double ns = 0; times.size() < most_frames && ns < 1e9 * most_of_start;
             ns += times.back())
            times.push_back(measure(world, per_frame));
        if (const Median time = median_of(std::move(times)); std::isfinite(time.value))
            costs.push_back(time.value);
    }
    return costs.empty() ? unknown : mean_of(costs) / static_cast<double>(per_frame);
} catch (const Error&) {
    return unknown;
}

double ns_per_step_together(const Scene& scene, const Stepping& choice,
                            const std::function<bool()>& stopped) try {
    const World start = make_world(scene, Settings{choice});
    const std::int64_t last = steps_of(scene, choice.rate);
    if (start.body_count() == 0) return unknown;
    std::vector<double> runs;
    const auto is_enough = [&](double seconds) {
        return runs.size() < fewest_rounds ? seconds > patience
                                           : seconds >= least_repeating || !has_fine_clock();
    };
    for (double seconds = 0; !is_enough(seconds); seconds += runs.back()) {
        runs.push_back(
            seconds_of(start, [&](World& world) { return step_to(world, last, stopped); }));
        if (std::isnan(runs.back())) return unknown;
    }
    return 1e9 * *std::ranges::min_element(runs) / static_cast<double>(last);
} catch (const Error&) {
    return unknown;
}

void time_rows(const Scene& scene, const std::vector<TradeoffRow*>& rows, int rounds,
               const SweepWatch& watch) {
    std::vector<RowTimes> times;
    for (TradeoffRow* row : rows)
        if (row->judgement.stable) times.emplace_back(*row);
    const auto all = static_cast<double>(times.size()) * rounds;
    double done = 0;
    for (int round = 0; round < rounds; ++round)
        for (RowTimes& one : times) {
            if (watch.stopped()) return;
            one.add_round(scene, watch);
            watch.progress(++done / all);
        }
    for (RowTimes& one : times) {
        one.conclude();
        const Stepping& stepping = one.row().stepping;
        one.row().ns_together = static_cast<double>(stepping.rate.steps) *
                                watch.ns_per_step_together(scene, stepping, watch.stopped);
    }
}

}  // namespace oiler::lab
