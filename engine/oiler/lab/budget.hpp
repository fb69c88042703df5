// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// One limit of a scene's budget and the measured value.
struct BudgetLine {
    std::string name;     ///< "position_error" or "energy_drift"
    std::string unit;     ///< "m", or empty
    double most = 0;      ///< the limit
    double measured = 0;  ///< infinite for an unstable run, `floor` for an error below it
    double floor = 0;     ///< 100 × the reference's own error
    bool kept = false;
};

/// Runs the scene with the given settings and compares its errors with its budget. Returns no lines
/// for a scene without a budget or for a stopped run. Throws Error{usage} for a limit below 100 ×
/// the reference's own error.
[[nodiscard]] std::vector<BudgetLine> check_budget(
    const Scene& scene, const Settings& settings,
    const std::function<bool()>& stopped = [] { return false; });

/// Whether the run of a scene leaves 10 × the extent of the true motion, or is not finite. Returns
/// false for a stopped run, and for a scene whose true motion takes too much work to find.
[[nodiscard]] bool is_unstable(
    const Scene& scene, const Settings& settings,
    const std::function<bool()>& stopped = [] { return false; });

/// "position_error 19.8 m of 25 m: kept"
[[nodiscard]] std::string describe(const BudgetLine& line);

}  // namespace oiler::lab
