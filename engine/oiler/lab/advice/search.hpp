// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/lab/advice/candidate.hpp"
#include "oiler/lab/advice/ensemble.hpp"
#include "oiler/lab/reference/run_work.hpp"

namespace oiler::lab {

/// Tries settings from the cheapest up and skips rates that the method's order rules out, until it
/// has a setting that meets the tolerance and a runner-up.
class Search {
public:
    Search(const Scene& scene, const Reference& reference, const Requirements& requirements,
           const SweepWatch& watch);

    /// Finds the cheapest setting that meets the tolerances, and a runner-up of another method.
    /// Without tolerances: the most accurate setting within the time.
    void run();

    /// Judges a setting, once however often it is asked for. An error far above the tolerance ends
    /// its run early.
    TradeoffRow try_choice(const Stepping& choice);
    /// Judges a setting to the end of its run.
    TradeoffRow measure(const Stepping& choice);
    /// The setting of a method with the highest rate that is estimated to cost no more, or its
    /// cheapest, in the precision and with the damping that allow the highest rate.
    [[nodiscard]] Stepping within_cost(const Method& method, double cost) const;
    /// The estimated computing time for a second of the scene, ns.
    [[nodiscard]] double cost_of(const Stepping& choice) const;
    /// Whether a row is within 98 % of the tolerances, as errors between cubics are known to 1 %,
    /// and holds for perturbed starts.
    [[nodiscard]] bool meets_tolerance(const TradeoffRow& row);
    /// Why a row that is within the tolerances does not hold; empty if it does.
    [[nodiscard]] std::string objection(const TradeoffRow& row) {
        return ensemble_.objection(row.stepping);
    }

    /// The tried rows that meet the tolerance, the cheapest first.
    [[nodiscard]] std::vector<TradeoffRow> meeting_rows();
    /// The stable rows, by their errors relative to the tolerances; without tolerances, by position
    /// error. The first ones and the first of each precision are judged to the end of their runs.
    [[nodiscard]] std::vector<TradeoffRow> closest_rows();

    /// The distance by which rounding to float moves bodies, m, if it exceeds the tolerance.
    [[nodiscard]] std::optional<double> too_coarse_float() const { return too_coarse_float_; }
    [[nodiscard]] const std::vector<std::int64_t>& rates() const { return rungs_; }
    [[nodiscard]] std::size_t perturbed_starts() const { return ensemble_.size(); }
    [[nodiscard]] std::int64_t runs() const { return static_cast<std::int64_t>(rows_.size()); }

private:
    void drop_low_rungs();
    void add_candidates(const Method& method, Precision precision);
    void add_candidate(const Method& method, Precision precision, std::optional<Damping> damping);
    Candidate* cheapest_next();
    [[nodiscard]] double next_cost(const Candidate& candidate) const;
    TradeoffRow judged(const Stepping& choice, double enough);
    TradeoffRow try_next(const Candidate& candidate);
    void advance(Candidate& candidate, const TradeoffRow& row, double excess);
    [[nodiscard]] bool affordable(const Candidate& candidate, std::int64_t rate) const;
    /// Reports the share of settings that were tried or ruled out.
    void report_progress() const;
    void try_highest();
    void find_cheapest();
    void find_most_accurate();
    void refine_to_time();
    void refine();
    bool refine(const TradeoffRow& row);
    /// The stable rows in the order of closest_rows. Errors of runs that ended early are too small.
    std::vector<TradeoffRow> rows_by_excess();

    const Scene& scene_;
    const Reference& reference_;
    const Requirements& requirements_;
    const SweepWatch& watch_;
    RunWork work_;
    std::vector<std::int64_t> rungs_;
    std::optional<std::int64_t> too_low_;  ///< the highest rate that was dropped
    std::vector<Candidate> candidates_;
    Ensemble ensemble_;
    std::optional<double> too_coarse_float_;
    std::vector<TradeoffRow> rows_;
};

}  // namespace oiler::lab
