// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/columns.hpp"
#include "oiler/physics/plan.hpp"

namespace oiler {

/// Whether steps with the plan follow flows at all.
template <std::floating_point T>
[[nodiscard]] bool needs_flows(const Plan<T>& plan) {
    const auto* const splitting = std::get_if<SplittingPlan<T>>(&plan);
    return splitting ? splitting->damping == Damping::in_drift
                     : std::holds_alternative<ExactPlan<T>>(plan);
}

/// Computes the exact flows that the plan needs, unless the columns have them: one response for
/// each distinct damping (and stiffness) and length. Throws Error{usage} where one overflows, since
/// a negative drift runs damping backwards.
template <std::floating_point T, int Axes>
void prepare_flows(Columns<T, Axes>& columns, const Plan<T>& plan);

}  // namespace oiler
