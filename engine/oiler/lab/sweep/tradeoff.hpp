// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "oiler/lab/sweep/judge.hpp"
#include "oiler/lab/sweep/machine.hpp"

namespace oiler::lab {

/// One way to step a scene: what it is wrong by and what it costs.
struct TradeoffRow {
    Stepping stepping{};
    Judgement judgement{};
    bool meets_steps = true;         ///< at every look, so that nothing is drawn between steps
    double ns_per_second = unknown;  ///< of computing for a second of the scene: a median
    double ns_spread = unknown;      ///< half of what lies between the quartiles
};

/// A method in one precision at ever higher rates.
struct Ladder {
    const Method* method = nullptr;
    Precision precision = Precision::double_;
    std::vector<TradeoffRow> rows{};
    std::string end{};  ///< why it has no more rows
    bool done = false;
};

/// What a scene was held against, without the track.
struct ReferenceSummary {
    std::string words;
    bool closed_form = false;
    double position_error = 0;    ///< its own, m
    double velocity_error = 0;    ///< m/s
    Doubt floor{};                ///< below which it cannot tell errors
    double extent = 0;            ///< m, that bodies move
    double meaningful_until = 0;  ///< s
    std::string why_no_longer{};  ///< see Reference
    double period = unknown;      ///< s, where the scene swings
};

[[nodiscard]] ReferenceSummary summary(const Reference& reference);

/// Which ladders to climb, and how far.
struct SweepPlan {
    std::vector<const Method*> methods{};
    std::vector<Precision> precisions{Precision::single, Precision::double_};
    std::int64_t max_rate = 0;  ///< 1/s; 0: 1024 times as often as the scene is looked at
    double most_work = 1e9;     ///< evaluations of forces on one body or link in a run
    int shard = 1;              ///< of `shards`: every so many-th ladder
    int shards = 1;
};

/// What a timestep costs on a scene, in every way to step it.
struct Tradeoff {
    std::string scene;  ///< its file's name without .toml
    std::string title;
    std::string fingerprint;  ///< of the scene's file and all that decides on errors
    double duration = 0;      ///< s
    Stepping today{};      ///< the scene's own choice
    Looks looks{};
    ReferenceSummary reference{};
    std::vector<Machine> machines{};
    std::vector<Ladder> ladders{};  ///< all of the plan; those of other shards are not done

    [[nodiscard]] bool complete() const;
    /// Nothing of them was left out, and all that are stable were timed.
    [[nodiscard]] bool timed() const;
    [[nodiscard]] std::vector<const TradeoffRow*> rows() const;
    [[nodiscard]] const TradeoffRow* find(const Stepping& choice) const;
};

/// A row's cost, by which a diagram is drawn: lower is better.
using Cost = double (*)(const TradeoffRow& row);
[[nodiscard]] inline double time_of(const TradeoffRow& row) { return row.ns_per_second; }
[[nodiscard]] inline double evaluations_of(const TradeoffRow& row) {
    return row.judgement.evaluations;
}

/// The rows than which no other costs less and is no more wrong, the cheapest first. Errors that
/// the reference cannot tell count as none.
[[nodiscard]] std::vector<const TradeoffRow*> pareto(const Tradeoff& tradeoff, Cost cost);

/// From 1 Hz to `max_rate`: the divisors of how often the scene is looked at, multiples of it that
/// are up to twice the one before, and the scene's own rate in any case.
[[nodiscard]] std::vector<std::int64_t> rungs(const Scene& scene, const Looks& looks,
                                              std::int64_t max_rate);

/// Measures the cost of one step in ns, where one call takes `at_once` steps, or fewer where a call
/// takes long. Returns `unknown` for an unstable run.
[[nodiscard]] double ns_per_step(const Scene& scene, const Stepping& choice,
                                 std::int64_t at_once);
/// How often a game that shows 60 frames per second steps in a call, but for very high rates.
[[nodiscard]] std::int64_t steps_at_once(std::int64_t rate);

/// How a sweep tells its caller how far it is, may be stopped, and hands over what is done.
struct SweepWatch {
    std::function<void(double share)> progress = [](double) {};
    std::function<bool()> stopped = [] { return false; };
    std::function<void(const Tradeoff&)> ladder_done = [](const Tradeoff&) {};
    /// Measures all costs; tests give costs of their own.
    std::function<double(const Scene&, const Stepping&, std::int64_t at_once)> ns_per_step =
        lab::ns_per_step;
};

/// All ladders of the plan, none climbed.
[[nodiscard]] Tradeoff start_tradeoff(const Scene& scene, const Looks& looks,
                                      const Reference& reference, const SweepPlan& plan);

/// Climbs each ladder of the plan's shard that is not done: until errors are too small to be told,
/// round-off keeps them from falling, or a run becomes too much work. On all cores; errors do not
/// depend on how many.
void sweep(Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
           const SweepPlan& plan, const SweepWatch& watch);

/// Times all stable rows, alone on the machine and taking turns, as a game would step that shows 60
/// frames per second.
void time_rows(const Scene& scene, const std::vector<TradeoffRow*>& rows, int rounds,
               const SweepWatch& watch);

/// The ladders of parts of one sweep. Throws Error{usage} where they are not of the same one, or
/// some are missing.
[[nodiscard]] Tradeoff merge(const std::vector<Tradeoff>& parts);

}  // namespace oiler::lab
