// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// One number of a scene's budget, held against what was measured.
struct BudgetLine {
    std::string name;     ///< "position_error" or "energy_drift"
    std::string unit;     ///< "m", or empty
    double most = 0;      ///< what the budget allows
    double measured = 0;  ///< infinite for an unstable run; where too small to be told, `told_from`
    double told_from = 0;  ///< a hundred times the reference's own error
    bool kept = false;
};

/// Measures the scene, stepped so, over its duration against its budget; nothing where it has none.
/// Throws Error{usage} for a budget so tight that the reference's own error would decide.
[[nodiscard]] std::vector<BudgetLine> check_budget(
    const Scene& scene, const Settings& settings,
    const std::function<bool()>& stopped = [] { return false; });

/// "position_error 19.8 m of 25 m: kept"
[[nodiscard]] std::string words_of(const BudgetLine& line);

}  // namespace oiler::lab
