// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "oiler/lab/advice/candidate.hpp"
#include "oiler/lab/advice/work_meter.hpp"

namespace oiler::lab {

/// Perturbed starts of a scene: positions by up to 0.1 % of the extent, velocities by up to 0.1 %
/// of the speed. A scene at rest is moved by 0.1 % of its size; there, errors up to twice that are
/// tolerated, because only instability makes them larger.
class Ensemble {
public:
    Ensemble(const Scene& scene, const Reference& reference, const Requirements& requirements,
             const std::function<bool()>& stopped, WorkMeter& meter)
        : scene_(scene),
          reference_(reference),
          requirements_(requirements),
          stopped_(stopped),
          meter_(meter) {}

    /// Why a setting that meets the tolerances is not advised: a warning before the run, at this
    /// rate or 5 % below it, or an error from a perturbed start. Empty if it holds.
    [[nodiscard]] std::string objection(const Stepping& choice);

    /// The number of starts that were judged. Those without a reference that can judge the
    /// tolerance are left out.
    [[nodiscard]] std::size_t size() const { return members_.size(); }

private:
    struct Member {
        Reference reference;
        Requirements requirements;
    };
    struct Known {
        Stepping choice;
        std::string objection;
    };

    [[nodiscard]] std::string warning(Stepping choice) const;
    void make_members();
    [[nodiscard]] std::string judge_members(const Stepping& choice);

    const Scene& scene_;
    const Reference& reference_;
    const Requirements& requirements_;
    const std::function<bool()>& stopped_;
    WorkMeter& meter_;
    std::vector<Member> members_;
    bool is_made_ = false;
    std::vector<Known> known_;
};

/// Tries settings from the cheapest up and skips rates that the method's order rules out, until it
/// has a setting that meets the tolerance and a runner-up.
class Search {
public:
    Search(const Scene& scene, const Reference& reference, const Requirements& requirements,
           const SweepWatch& watch);

    /// Finds the cheapest setting that meets the tolerances, and a runner-up of another method.
    /// Without tolerances: the most accurate setting within the time.
    void run();

    /// Judges a setting; further calls return the first result. An error far above the tolerance
    /// ends its run early.
    TradeoffRow try_choice(const Stepping& choice);
    /// The same, or nothing if the run would be too much work.
    std::optional<TradeoffRow> try_affordable(const Stepping& choice);
    /// Whether judging a setting to the end of its run takes little work, or what is left of it.
    [[nodiscard]] bool can_measure(const Stepping& choice) const;
    /// Judges a setting to the end of its run.
    TradeoffRow measure(const Stepping& choice);
    /// The setting of a method with the highest rate that is estimated to cost no more, or its
    /// cheapest, in the precision and with the damping that allow the highest rate.
    [[nodiscard]] Stepping within_cost(const Method& method, double cost) const;
    /// The estimated computing time for a second of the scene, ns.
    [[nodiscard]] double cost_of(const Stepping& choice) const;
    /// Whether a row is within 98 % of the tolerances, because errors between cubics are known to 1
    /// %, and holds for perturbed starts.
    [[nodiscard]] bool meets_tolerance(const TradeoffRow& row);
    /// Why a row that is within the tolerances does not hold; empty if it does.
    [[nodiscard]] std::string objection(const TradeoffRow& row) {
        return ensemble_.objection(row.stepping);
    }

    /// The tried rows that meet the tolerance, the cheapest first.
    [[nodiscard]] std::vector<TradeoffRow> meeting_rows();
    /// The stable rows, by their errors relative to the tolerances; without tolerances, by position
    /// error. The first ones and the first of each precision are judged to the end of their runs;
    /// those for which that is too much work are left out.
    [[nodiscard]] std::vector<TradeoffRow> closest_rows();

    /// The distance by which rounding to float moves bodies, m, if it exceeds the tolerance.
    [[nodiscard]] std::optional<double> too_coarse_float() const { return too_coarse_float_; }
    [[nodiscard]] const std::vector<std::int64_t>& rates() const { return rates_; }
    [[nodiscard]] std::size_t perturbed_starts() const { return ensemble_.size(); }
    [[nodiscard]] std::int64_t runs() const { return static_cast<std::int64_t>(rows_.size()); }
    /// Whether settings that may be cheaper or more accurate were too much work to try.
    [[nodiscard]] bool ended_early() const { return ended_early_; }

private:
    void drop_low_rates();
    [[nodiscard]] const std::vector<World>& starts(Precision precision);
    void add_candidates(const Method& method, Precision precision);
    void add_candidate(const Method& method, Precision precision, std::optional<Damping> damping);
    Candidate* cheapest_next(double most);
    [[nodiscard]] double next_cost(const Candidate& candidate) const;
    TradeoffRow judged(const Stepping& choice, double enough);
    [[nodiscard]] double work_of(const Stepping& choice) const;
    void advance(Candidate& candidate, const TradeoffRow& row, double excess);
    [[nodiscard]] bool affordable(const Stepping& choice, double kept = 0) const;
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
    WorkMeter meter_;
    bool ended_early_ = false;
    std::array<std::vector<World>, 2> starts_;  ///< in float and in double
    std::vector<std::int64_t> rates_;
    std::optional<std::int64_t> too_low_;  ///< the highest rate that was dropped
    std::vector<Candidate> candidates_;
    Ensemble ensemble_;
    std::optional<double> too_coarse_float_;
    std::vector<TradeoffRow> rows_;
};

}  // namespace oiler::lab
