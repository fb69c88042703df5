// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/core/team.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/kernels/kernels.hpp"
#include "oiler/sim/rows/row_views.hpp"

namespace oiler {

/// Everything that the steps of a call need.
template <std::floating_point T, int Axes>
struct StepCall {
    Columns<T, Axes>& columns;
    const RowViews<T, Axes>& views;
    const Method& method;
    const Plan<T>& plan;
    const Steps& steps;
    const Kernels<T, Axes>* kernels;  ///< null if rows are stepped one at a time
    Team* team;                       ///< null means this thread alone
};

/// Steps the rows from `begin`, the start of a block, to `end`. Each block of rows is loaded into
/// registers, stepped `count` times and stored, so that a call accesses memory once. The bits do
/// not depend on the steps per call. Returns the earliest divergence, after which the columns are
/// unusable.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_rows(const StepCall<T, Axes>& call, std::size_t begin,
                                                  std::size_t end);

/// Steps all rows, of which some meet planes, and lists their impacts in the columns.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_landing_rows(const StepCall<T, Axes>& call);

/// Steps all rows if there are links: together, stage by stage.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_linked_rows(const StepCall<T, Axes>& call);

}  // namespace oiler
