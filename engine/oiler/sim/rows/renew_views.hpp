// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// Renews the views of the columns for the plan. Fills the caches that are not valid: the sums
/// of linear forces that share a number, such as those of two springs, and the exact flows of the
/// plan. Throws Error{usage} if a flow overflows, see require_flows.
template <std::floating_point T, int Axes>
void renew_views(Columns<T, Axes>& columns, const Plan<T>& plan);

/// Throws Error{usage} if an exact flow of the plan overflows, which may happen in a negative
/// drift, because it runs damping backwards. It computes only those that may, and keeps none.
template <std::floating_point T, int Axes>
void require_flows(const Columns<T, Axes>& columns, const Plan<T>& plan);

}  // namespace oiler
