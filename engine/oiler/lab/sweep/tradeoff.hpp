// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// The machine on which times were measured.
struct Machine {
    std::string cpu;
    int cores = 1;
    std::string compiler;
    friend bool operator==(const Machine&, const Machine&) = default;
};

[[nodiscard]] Machine this_machine();

/// A setting, its errors and its cost.
struct TradeoffRow {
    Stepping stepping{};
    Judgement judgement{};
    /// Computing time per simulated second as played, ns: the mean over frames of the whole
    /// duration, each with the median of repeated times. In a game of 60 frames per second each
    /// step is a call, and other work is between the frames.
    double ns_per_second = unknown;
    double ns_spread = unknown;       ///< half the interquartile range
    double ns_worst_frame = unknown;  ///< ns, of the most expensive of these frames
    double ns_together = unknown;     ///< ns per simulated second at many steps per call
};

/// A method in one precision, at rates in ascending order. Files call it a ladder.
struct RateSeries {
    const Method* method = nullptr;
    Precision precision = Precision::double_;
    std::vector<TradeoffRow> rows{};
    std::string end{};  ///< why there are no higher rates
    bool done = false;
};

/// A reference without its trajectory.
struct ReferenceSummary {
    std::string words;
    bool closed_form = false;
    double position_error = 0;    ///< its own, m
    double velocity_error = 0;    ///< its own, m/s
    Uncertainty floor{};          ///< the smallest errors that it resolves
    double extent = 0;            ///< m, see Reference
    double meaningful_until = 0;  ///< s
    std::string why_no_longer{};  ///< see Reference
    double period = unknown;      ///< s, of an oscillating scene
};

[[nodiscard]] ReferenceSummary summary(const Reference& reference);

/// The methods, precisions and rates of a sweep.
struct SweepPlan {
    std::vector<const Method*> methods{};
    std::vector<Precision> precisions{Precision::single, Precision::double_};
    std::int64_t max_rate = 0;  ///< 1/s; 0 for 61,440, or more for fast motion
    double most_work = 1e9;     ///< force evaluations, each on one body or link, per run
    int shard = 1;              ///< from 1 to `shards`: every `shards`-th series
    int shards = 1;
};

/// Errors and costs of all settings of a sweep on one scene.
struct Tradeoff {
    std::string scene;  ///< its file's name without .toml
    std::string title;
    std::string fingerprint;  ///< see fingerprint()
    double duration = 0;      ///< s
    Stepping current{};       ///< the scene's own setting
    ReferenceSummary reference{};
    std::vector<Machine> machines{};
    std::vector<RateSeries> all_series{};  ///< all of the plan; series of other shards are not done
    std::string file{};                    ///< from which it was read, for messages

    [[nodiscard]] bool complete() const;
    /// Whether all stable rows were timed.
    [[nodiscard]] bool timed() const;
    [[nodiscard]] std::vector<const TradeoffRow*> rows() const;
    [[nodiscard]] const TradeoffRow* find(const Stepping& choice) const;
};

/// A row's cost, for Pareto fronts and diagrams.
using Cost = double (*)(const TradeoffRow& row);
[[nodiscard]] inline double time_of(const TradeoffRow& row) { return row.ns_per_second; }
[[nodiscard]] inline double evaluations_of(const TradeoffRow& row) {
    return row.judgement.evaluations;
}

/// The Pareto front of cost and position error, the cheapest first: no cheaper row is as accurate.
/// Errors below the reference's floor count as 0.
[[nodiscard]] std::vector<const TradeoffRow*> pareto(const Tradeoff& tradeoff, Cost cost);

/// The rates of a series from 1 Hz to `max_rate`: the divisors of 60, 60·2ⁿ and 90·2ⁿ, and the
/// scene's own rate, even above `max_rate`.
[[nodiscard]] std::vector<std::int64_t> sweep_rates(const Scene& scene, std::int64_t max_rate);

/// Errors above this fraction of the extent do not follow the method's order.
inline constexpr double largest_converging_error = 0.1;

/// The convergence of a method's error with its rate. Errors above `begun` (m) are no evidence:
/// they have not begun to fall.
class Convergence {
public:
    explicit Convergence(double begun) : begun_(begun) {}

    /// Takes the error at the next higher rate.
    void take(double error) {
        if (!(error < begun_)) return;
        vain_ = error >= improvement * best_ ? vain_ + 1 : 0;
        best_ = std::fmin(best_, error);
    }
    /// Whether errors no longer fall.
    [[nodiscard]] bool stalled() const { return vain_ >= most_vain; }
    /// Forgets the rates without improvement.
    void restart() { vain_ = 0; }

private:
    /// An error above this fraction of the best so far is no improvement.
    static constexpr double improvement = 0.9;
    static constexpr int most_vain = 3;

    double begun_;
    double best_ = std::numeric_limits<double>::infinity();
    int vain_ = 0;
};

/// Whether only round-off causes a row's error: the same run in long double halves it.
[[nodiscard]] bool is_round_off(const Scene& scene, const TradeoffRow& row,
                                const Reference& reference, const std::function<bool()>& stopped);

/// A cost of a frame: takes its steps one by one. `unknown` for a divergence.
using FrameMeasure = std::function<double(World& world, std::int64_t steps)>;

/// Measures frames of a game of 60 frames per second in a run of the scene: all frames or, in a
/// long scene, groups of frames that are spread over the whole duration. Below 60 Hz, frames
/// without a step are left out. Ends early for a divergence or if stopped.
[[nodiscard]] std::vector<double> measure_frames(const Scene& scene, const Settings& settings,
                                                 const std::function<bool()>& stopped,
                                                 const FrameMeasure& measure);
/// The times of these frames as played, ns; with a coarse clock only their mean. Empty if the run is
/// unstable from the first step on.
[[nodiscard]] std::vector<double> ns_of_frames(const Scene& scene, const Settings& settings,
                                               const std::function<bool()>& stopped);
/// The cost of a step in frames of `per_frame` steps, ns: the mean over starts that are at tick 0.
/// `unknown` for a setting that is unstable from all of them.
[[nodiscard]] double ns_per_step(const std::vector<World>& starts, const Stepping& choice,
                                 std::int64_t per_frame);
/// The cost of a step at many steps per call, ns, over the whole duration; `unknown` for an
/// unstable run.
[[nodiscard]] double ns_per_step_together(const Scene& scene, const Stepping& choice,
                                          const std::function<bool()>& stopped);

/// Callbacks of a sweep: progress, stopping, and each finished series.
struct SweepWatch {
    std::function<void(double share)> progress = [](double) {};
    std::function<bool()> stopped = [] { return false; };
    std::function<void(const Tradeoff&)> series_done = [](const Tradeoff&) {};
    // All measurements of time. Tests replace them.
    std::function<std::vector<double>(const Scene&, const Settings&, const std::function<bool()>&)>
        ns_of_frames = lab::ns_of_frames;
    std::function<double(const std::vector<World>&, const Stepping&, std::int64_t per_frame)>
        ns_per_step = lab::ns_per_step;
    std::function<double(const Scene&, const Stepping&, const std::function<bool()>&)>
        ns_per_step_together = lab::ns_per_step_together;
};

/// A trade-off with all series of the plan, without rows.
[[nodiscard]] Tradeoff start_tradeoff(const Scene& scene, const Reference& reference,
                                      const SweepPlan& plan);

/// Runs each unfinished series of the plan's shard at its rates, lowest first, until errors are
/// below the reference's floor, round-off keeps them from falling, or a run is too much work. Uses
/// all cores; errors do not depend on their number.
void sweep(Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
           const SweepPlan& plan, const SweepWatch& watch);

/// Times all stable rows. Rows run one at a time and take turns.
void time_rows(const Scene& scene, const std::vector<TradeoffRow*>& rows, int rounds,
               const SweepWatch& watch);

/// Joins the shards of a sweep. Throws Error{usage} with the file of a part of another sweep, of a
/// part that is given twice, or of all parts if one is missing.
[[nodiscard]] Tradeoff merge(const std::vector<Tradeoff>& parts);

}  // namespace oiler::lab
