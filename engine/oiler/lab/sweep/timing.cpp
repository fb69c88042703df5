// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/core/timing.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double frames_per_second = 60;
/// The largest number of steps in a frame and in a call. More cost no less per step.
constexpr std::int64_t most_steps = 256;
/// The shortest and the longest measurement, s; a clock's resolution is tens of ns.
constexpr double shortest_timing = 200e-6;
constexpr double longest_timing = 50e-3;
constexpr std::size_t fewest_timings = 5;
constexpr std::size_t most_timings = 300;

/// The time that two readings of the clock take, s.
double clock_time() {
    static const double least = [] {
        double time = INFINITY;
        for (int i = 0; i < 1000; ++i) time = std::min(time, seconds_since(Clock::now()));
        return time;
    }();
    return least;
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

/// A game's frame: steps one by one, with a body read after each. Returns seconds, `unknown` for a
/// divergence.
double seconds_of_frame(World& world, std::int64_t steps) {
    double seen = 0;
    const Clock::time_point begin = Clock::now();
    for (std::int64_t step = 0; step < steps; ++step) {
        if (world.try_step()) return unknown;
        seen += world.position_of_row(0)[0];
    }
    asm volatile("" : : "g"(seen));  // the compiler must not drop the readings
    return std::max(0.0, seconds_since(begin) - clock_time());
}

/// Steps worlds from `start` in pieces of `steps` to the scene's end, again and again, until a
/// measurement is long enough. A run may be unstable after the scene's end. Calls `measure` for
/// each piece.
template <class Measure>
void repeat_scene(const World& start, double duration, std::int64_t steps, Measure measure) {
    const auto last = std::max<std::int64_t>(
        start.tick() + steps,
        static_cast<std::int64_t>(
            std::floor(duration * static_cast<double>(start.settings().stepping.rate.steps))));
    double seconds = 0;
    std::size_t pieces = 0;
    const auto is_enough = [&] {
        return seconds > longest_timing || pieces >= most_timings ||
               (seconds >= shortest_timing && pieces >= fewest_timings);
    };
    while (!is_enough()) {
        World world = start;
        for (; world.tick() + steps <= last && !is_enough(); ++pieces) {
            const double taken = measure(world);
            if (std::isnan(taken)) return;
            seconds += taken;
        }
    }
}

}  // namespace

double ns_per_step(const Scene& scene, const Settings& settings, std::int64_t per_frame) try {
    World start = make_world(scene, settings);
    if (start.body_count() == 0 || start.try_step()) return unknown;
    FrameWork between;
    std::vector<double> frames;
    repeat_scene(start, scene.duration, per_frame, [&](World& world) {
        between.run();
        frames.push_back(seconds_of_frame(world, per_frame));
        return frames.back();
    });
    if (frames.empty() || std::isnan(frames.back())) return unknown;
    return 1e9 * median_of(std::move(frames)).value / static_cast<double>(per_frame);
} catch (const Error&) {
    return unknown;
}

double ns_per_step_together(const Scene& scene, const Stepping& choice) try {
    World start = make_world(scene, Settings{choice});
    if (start.body_count() == 0 || start.try_step()) return unknown;
    World probe = start;
    const double first = seconds_of_frame(probe, 1);
    const std::int64_t steps = std::clamp<std::int64_t>(
        std::llround(longest_timing / std::max(first, 1e-9)), 1, most_steps);
    std::vector<double> calls;
    repeat_scene(start, scene.duration, steps, [&](World& world) {
        const Clock::time_point begin = Clock::now();
        calls.push_back(world.try_step(steps) ? unknown : seconds_since(begin));
        return calls.back();
    });
    if (calls.empty() || std::isnan(calls.back())) return unknown;
    return 1e9 * median_of(std::move(calls)).value / static_cast<double>(steps);
} catch (const Error&) {
    return unknown;
}

double ns_per_second(const Scene& scene, const Stepping& choice, const SweepWatch& watch) {
    const auto rate = static_cast<double>(choice.rate.steps);
    const double in_frame = rate / frames_per_second;
    const double few = std::floor(in_frame);
    if (few >= static_cast<double>(most_steps))
        return rate * watch.ns_per_step(scene, Settings{choice}, most_steps);
    const auto frame = [&](double steps) {
        return steps == 0 ? 0
                          : steps * watch.ns_per_step(scene, Settings{choice},
                                                      static_cast<std::int64_t>(steps));
    };
    const double share = in_frame - few;
    const double more = share > 0 ? share * frame(few + 1) : 0;
    return frames_per_second * ((1 - share) * frame(few) + more);
}

void time_rows(const Scene& scene, const std::vector<TradeoffRow*>& rows, int rounds,
               const SweepWatch& watch) {
    std::vector<TradeoffRow*> stable;
    for (TradeoffRow* row : rows)
        if (row->judgement.stable) stable.push_back(row);
    std::vector<std::vector<double>> times(stable.size());
    const auto all = static_cast<double>(stable.size()) * rounds;
    double done = 0;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < stable.size(); ++i) {
            if (watch.stopped()) return;
            times[i].push_back(ns_per_second(scene, stable[i]->stepping, watch));
            watch.progress(++done / all);
        }
    for (std::size_t i = 0; i < stable.size(); ++i) {
        TradeoffRow& row = *stable[i];
        const Median time = median_of(std::move(times[i]));
        row.ns_per_second = time.value;
        row.ns_spread = time.spread;
        row.ns_together = static_cast<double>(row.stepping.rate.steps) *
                          watch.ns_per_step_together(scene, row.stepping);
    }
}

}  // namespace oiler::lab
