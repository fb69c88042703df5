// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/core/json.hpp"
#include "oiler/lab/advice/growth.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {

/// The requirements on a setting: tolerances, a time budget, and the settings to choose from.
struct Requirements {
    std::optional<double> position_error{};  ///< m, the tolerance
    std::optional<double> energy_drift{};    ///< relative, the tolerance
    std::optional<double> ns_per_second{};   ///< computing time per second of the scene
    bool at_steps = false;                   ///< position_error is that at the steps, else as drawn
    std::int64_t display = 0;    ///< frames per second at which lines are drawn, 0 for any time
    std::int64_t min_rate = 30;  ///< 1/s
    std::int64_t max_rate = 1'000'000;  ///< 1/s
    std::vector<const Method*> methods{};
    double most_work = 1e9;          ///< see SweepPlan
    double most_search_work = 2e10;  ///< see WorkMeter; less than a minute
    /// Costs up to this do not decide between settings that meet the tolerance, ns per simulated
    /// second.
    double negligible_ns_per_second = 0;

    [[nodiscard]] bool has_tolerance() const { return position_error || energy_drift; }
    /// The position error that the tolerance limits, m.
    [[nodiscard]] double error_of(const Judgement& judgement) const {
        return at_steps ? judgement.step_error : judgement.position_error;
    }
};

/// A method that people commonly choose, and why it is not the advice.
struct Alternative {
    std::optional<TradeoffRow> row{};  ///< none if it cannot step the scene
    const Method* method = nullptr;
    std::string why{};
};

struct Advice {
    std::optional<TradeoffRow> best{};  ///< meets the requirements, or is the closest
    bool meets = false;
    std::size_t perturbed_starts = 0;  ///< from which the best setting was run, too
    Growth growth{};                   ///< of the best setting's error
    std::vector<TradeoffRow> ties{};   ///< settings whose cost does not differ from the best's
    /// The threads on which the best setting costs less than on one, and that cost; 1 if none.
    int threads = 1;
    double ns_on_threads = unknown;          ///< per simulated second
    std::optional<TradeoffRow> runner_up{};  ///< of another method
    std::optional<TradeoffRow> current{};    ///< the scene's own setting
    std::vector<Alternative> alternatives{};
    std::optional<TradeoffRow> cheapest{};  ///< that meets the tolerance, if another one is best
    std::vector<std::string> obstacles{};   ///< why no setting meets the requirements
    bool ended_early = false;               ///< whether some settings were too much work to try
    std::int64_t runs = 0;                  ///< number of runs that the search took
};

/// Whether two costs tie: their spreads overlap.
[[nodiscard]] bool is_tie(const TradeoffRow& a, const TradeoffRow& b);

/// "1.25 ms"; `ns` in ns.
[[nodiscard]] std::string describe_time(double ns);

/// Finds the cheapest setting within the tolerances or, without tolerances, the most accurate
/// within the time. A setting must also meet the tolerances from perturbed starts, and raise no
/// warning before the run, also at a rate 5 % lower. Among settings of equal cost, the most
/// accurate wins, then the one of the higher rate. Among those of negligible cost, the first are
/// those of 60 Hz and of the scene's own rate. The work is bounded. Tries settings from the
/// cheapest up and skips rates that the method's order rules out. Throws Error{usage} for a
/// tolerance that the reference cannot judge. The result of a stopped call is empty.
[[nodiscard]] Advice advise(const Scene& scene, const Reference& reference,
                            const Requirements& requirements, const SweepWatch& watch);

/// Throws Error{usage} for a tolerance below 100 × the reference's own error.
void require_judgeable(const Scene& scene, const Reference& reference,
                       const Requirements& requirements);

/// The largest ratio of an error to its tolerance.
[[nodiscard]] double excess(const Judgement& judgement, const Requirements& requirements);

/// Whether errors are within (1 − slack) × the tolerances.
[[nodiscard]] bool meets(const Judgement& judgement, const Requirements& requirements,
                         double slack = 0);

/// The largest error of a reference that can judge the requirements, m; 0 for the best reference.
[[nodiscard]] double required_reference_error(const Requirements& requirements);

/// The advice in sentences, the conclusion first.
[[nodiscard]] std::vector<std::string> describe(const Advice& advice, const Scene& scene,
                                                const Reference& reference,
                                                const Requirements& requirements);

[[nodiscard]] Json to_json(const Advice& advice, const Scene& scene, const Reference& reference,
                           const Requirements& requirements);

}  // namespace oiler::lab
