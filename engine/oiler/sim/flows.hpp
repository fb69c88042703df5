// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/columns.hpp"
#include "oiler/sim/plan.hpp"

namespace oiler {

/// Computes the exact flows that the plan needs, unless the columns have them: one response for
/// each distinct damping (and stiffness) and length. Throws Error{usage} where one overflows, since
/// a negative drift runs damping backwards.
template <std::floating_point T, int Axes>
void prepare_flows(Columns<T, Axes>& columns, const Plan<T>& plan);

}  // namespace oiler
