// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/core/budget_entry.hpp"
#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// Runs the scene with the given settings and compares its errors with its budget. Returns nothing
/// for a scene without a budget or for a stopped run. Throws Error{usage} for a limit below the
/// floor: 100 × the reference's own error.
[[nodiscard]] std::vector<BudgetEntry> check_budget(
    const Scene& scene, const Settings& settings,
    const std::function<bool()>& stopped = [] { return false; },
    const std::function<void(double)>& progress = [](double) {});

/// Whether the run of a scene leaves 10 × the extent of the true motion, or is not finite. Returns
/// false for a stopped run, and for a scene whose true motion takes too much work to find.
[[nodiscard]] bool is_unstable(
    const Scene& scene, const Settings& settings,
    const std::function<bool()>& stopped = [] { return false; });

}  // namespace oiler::lab
