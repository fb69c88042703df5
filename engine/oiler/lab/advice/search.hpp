// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/sweep/convergence.hpp"

namespace oiler::lab {

/// Tries ways to step a scene in the order of what they cost, as far as their order does not rule
/// them out, until one is good enough.
class Search {
public:
    Search(const Scene& scene, const Reference& reference, const Wish& wish,
           const SweepWatch& watch);

    /// The cheapest that meets the tolerances, and a runner-up of another method; without
    /// tolerances the most accurate in the time.
    void run();

    /// Judged once.
    TradeoffRow try_choice(const Stepping& choice);
    /// An estimate in ns for a second of the scene.
    [[nodiscard]] double cost_of(const Stepping& choice) const;
    /// With a little to spare, since an independent run may look elsewhere.
    [[nodiscard]] bool good(const TradeoffRow& row) const;

    /// What was tried and is good, the cheapest first.
    [[nodiscard]] std::vector<TradeoffRow> good_rows() const;
    /// All that is stable: the one that is off by the least first, without tolerances the most
    /// accurate.
    [[nodiscard]] std::vector<TradeoffRow> nearest_rows() const;

    /// By how much rounding to float alone moves bodies, in m, where that rules out all runs in it.
    [[nodiscard]] std::optional<double> too_coarse_float() const { return too_coarse_float_; }
    [[nodiscard]] const std::vector<std::int64_t>& rates() const { return rungs_; }
    [[nodiscard]] std::int64_t runs() const { return static_cast<std::int64_t>(rows_.size()); }

private:
    /// A method in one precision, how far it was tried, and what a step of it costs in ns.
    struct Candidate {
        const Method* method = nullptr;
        Precision precision = Precision::double_;
        double alone = unknown;     ///< a call of one step
        double together = unknown;  ///< a step of many in a call
        double work_per_hertz = 0;  ///< of a run at 1 Hz
        std::size_t next = 0;       ///< rung
        Descent descent{};
        std::int64_t tried = 0;  ///< last rate at which it was stable and met its looks
        double error = unknown;  ///< m, there
        bool over = false;

        [[nodiscard]] Stepping at(std::int64_t rate) const { return {method, {rate}, precision}; }
        [[nodiscard]] double cost(std::int64_t rate) const;
    };

    void add_candidate(const Method& method, Precision precision);
    Candidate* cheapest_next();
    [[nodiscard]] double next_cost(const Candidate& candidate) const;
    TradeoffRow try_next(const Candidate& candidate);
    void go_on(Candidate& candidate, const TradeoffRow& row, double excess);
    [[nodiscard]] std::int64_t least_rate(const Candidate& candidate, const TradeoffRow& row,
                                          double excess) const;
    [[nodiscard]] bool affordable(const Candidate& candidate, std::int64_t rate) const;
    /// How many of all ways were tried or ruled out.
    void tell_progress() const;
    void try_highest();
    void find_cheapest();
    void find_most_accurate();
    void refine();
    void refine(const TradeoffRow& row);

    const Scene& scene_;
    const Reference& reference_;
    const Wish& wish_;
    const SweepWatch& watch_;
    Work work_;
    std::vector<std::int64_t> rungs_;
    std::vector<Candidate> candidates_;
    std::optional<double> too_coarse_float_;
    std::vector<TradeoffRow> rows_;
};

/// How many times the tolerances a run is off.
[[nodiscard]] double excess(const Judgement& judgement, const Wish& wish);

/// An error above this part of what the bodies move says nothing of how it falls.
inline constexpr double wild = 0.1;

}  // namespace oiler::lab
