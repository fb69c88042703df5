// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t frames_per_second = 60;
/// The shortest measurement, long against a clock resolution of tens of ns.
constexpr double shortest = 100e-6;  // s
/// The largest number of steps per call. More steps per call cost no less per step.
constexpr std::int64_t most_steps_per_call = 256;

/// The longest call. Calls of expensive steps take fewer steps.
constexpr double longest_call = 50e-3;  // s

double seconds_of(World& world, std::int64_t steps) {
    const Clock::time_point begin = Clock::now();
    if (world.try_step(steps)) return unknown;
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const double high = sorted[std::min(low + 1, sorted.size() - 1)];
    return sorted[low] + (high - sorted[low]) * (at - static_cast<double>(low));
}

}  // namespace

// Runs restart when the scene ends, because a run may be unstable after that.
double ns_per_step(const Scene& scene, const Stepping& choice, std::int64_t per_call) try {
    World start = make_world(scene, Settings{choice});
    if (start.try_step()) return unknown;
    if (per_call > 1) {
        World probe = start;
        const double first = seconds_of(probe, 1);
        const double most = longest_call / std::min(first, seconds_of(probe, 1));
        if (most < static_cast<double>(per_call))
            per_call = std::max<std::int64_t>(1, std::llround(most));
    }
    const auto last = std::max<std::int64_t>(
        1 + per_call,
        static_cast<std::int64_t>(scene.duration * static_cast<double>(choice.rate.steps)));
    double seconds = 0;
    std::int64_t steps = 0;
    while (seconds < shortest) {
        World world = start;
        while (world.tick() + per_call <= last && seconds < shortest)
            seconds += seconds_of(world, per_call);
        steps += world.tick() - start.tick();
    }
    return 1e9 * seconds / static_cast<double>(steps);
} catch (const Error&) {
    return unknown;
}

std::int64_t steps_per_call(std::int64_t rate) {
    return std::clamp<std::int64_t>(rate / frames_per_second, 1, most_steps_per_call);
}

void time_rows(const Scene& scene, const std::vector<TradeoffRow*>& rows, int rounds,
               const SweepWatch& watch) {
    std::vector<TradeoffRow*> stable;
    for (TradeoffRow* row : rows)
        if (row->judgement.stable) stable.push_back(row);
    std::vector<std::vector<double>> times(stable.size());
    const auto all = static_cast<double>(stable.size()) * rounds;
    const auto ns_per_second = [&](const Stepping& choice) {
        return watch.ns_per_step(scene, choice, steps_per_call(choice.rate.steps)) *
               static_cast<double>(choice.rate.steps);
    };
    double done = 0;
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < stable.size(); ++i) {
            if (watch.stopped()) return;
            times[i].push_back(ns_per_second(stable[i]->stepping));
            watch.progress(++done / all);
        }
    for (std::size_t i = 0; i < stable.size(); ++i) {
        std::sort(times[i].begin(), times[i].end());
        stable[i]->ns_per_second = quantile(times[i], 0.5);
        stable[i]->ns_spread = (quantile(times[i], 0.75) - quantile(times[i], 0.25)) / 2;
    }
}

}  // namespace oiler::lab
