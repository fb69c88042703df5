// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/plan.hpp"
#include "oiler/sim/linear_columns.hpp"

namespace oiler {

/// Whether steps with the plan use exact flows.
template <std::floating_point T>
[[nodiscard]] bool needs_flows(const Plan<T>& plan) {
    const auto* const splitting = std::get_if<SplittingPlan<T>>(&plan);
    return splitting ? splitting->damping == Damping::in_drift
                     : std::holds_alternative<ExactPlan<T>>(plan);
}

/// Computes the exact flows of the plan, unless the columns have them: one response per distinct
/// damping (and stiffness) and duration. Throws Error{usage} if one overflows, which may happen in
/// a negative drift, because it runs damping backwards.
template <std::floating_point T, int Axes>
void prepare_flows(Columns<T, Axes>& columns, const LinearColumns<T, Axes>& linear,
                   const Plan<T>& plan);

}  // namespace oiler
