// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/core/team.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/sim/row_views.hpp"
#include "oiler/sim/steps.hpp"

namespace oiler {

/// Steps all rows; prepare_flows must have been called. Each block of rows is loaded into
/// registers, stepped `count` times and stored, so that a call accesses memory once. The bits do
/// not depend on the steps per call or on the `team`, whose threads share the rows; a null team
/// means this thread alone. Returns the earliest divergence, after which the columns are unusable.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_rows(Columns<T, Axes>& columns,
                                                  const RowViews<T, Axes>& views,
                                                  const Plan<T>& plan, const Steps& steps,
                                                  Team* team);

/// Like step_rows, for rows with links: all rows are stepped together, stage by stage.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_linked_rows(Columns<T, Axes>& columns,
                                                         const RowViews<T, Axes>& views,
                                                         const Plan<T>& plan, const Steps& steps);

}  // namespace oiler
