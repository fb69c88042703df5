// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/core/team.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/sim/row_views.hpp"
#include "oiler/sim/steps.hpp"

namespace oiler {

/// Steps the rows from `begin`, the start of a block, to `end`; prepare_flows must have been
/// called. Each block of rows is loaded into registers, stepped `count` times and stored, so that a
/// call accesses memory once. The bits do not depend on the steps per call. Returns the earliest
/// divergence, after which the columns are unusable.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_row_range(Columns<T, Axes>& columns,
                                                       const RowViews<T, Axes>& views,
                                                       const Plan<T>& plan, const Steps& steps,
                                                       std::size_t begin, std::size_t end);

/// The same for rows of which some meet planes. Adds their impacts to `impacts`, in no order.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_landing_rows(Columns<T, Axes>& columns,
                                                          const RowViews<T, Axes>& views,
                                                          const Method& method, const Plan<T>& plan,
                                                          const Steps& steps, std::size_t begin,
                                                          std::size_t end,
                                                          std::vector<RowImpact<T, Axes>>& impacts);

/// Steps rows with links: all rows are stepped together, stage by stage. A null team means this
/// thread alone.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> step_linked_rows(Columns<T, Axes>& columns,
                                                         const RowViews<T, Axes>& views,
                                                         const Plan<T>& plan, const Steps& steps,
                                                         Team* team);

}  // namespace oiler
