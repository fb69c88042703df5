// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/core/team.hpp"
#include "oiler/sim/columns.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/sim/steps.hpp"

namespace oiler {

/// Steps all rows; their flows are prepared. Each block of rows is loaded into registers, stepped
/// `count` times and stored, so that a run nobody looks into pays for memory once; one step at a
/// time gives the same bits, and so does any `team`, among which the rows are shared out; null for
/// this thread alone. Returns the earliest divergence, after which the columns are of no use.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_rows(Columns<T, Axes>& columns, const Plan<T>& plan,
                                                  const Steps& steps, Team* team);

/// The same for rows of which some are linked: all rows go stage by stage.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_linked_rows(Columns<T, Axes>& columns,
                                                         const Plan<T>& plan, const Steps& steps);

}  // namespace oiler
