// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "oiler/physics/plan.hpp"
#include "oiler/sim/links/link_rows.hpp"
#include "oiler/sim/rows/row_physics.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// A function that steps the rows from `begin`, the start of a block, to `end` along one axis, in
/// batches. Returns `end`, or the first row of a batch that it did not store because a number in it
/// may no longer be finite.
template <std::floating_point T, class Rule>
using StepAxis = std::size_t (*)(const AxisRows<T>&, const Rule&, const Steps&, std::size_t begin,
                                 std::size_t end);
/// The same along all axes, for rows with forces of these kinds.
template <std::floating_point T, int Axes, class Rule>
using StepAllAxes = std::size_t (*)(Columns<T, Axes>&, const RowViews<T, Axes>&, Kinds, const Rule&,
                                    const Steps&, std::size_t begin, std::size_t end);

/// Returns the function for linear forces with these parts, for one step per call or many.
template <std::floating_point T, class Rule>
using ChooseStepAxis = StepAxis<T, Rule> (*)(const Rule&, const LinearParts&, bool one_step);

template <template <class> class F, std::floating_point T>
using OfEachRule =
    std::tuple<F<SplittingPlan<T>>, F<TableauPlan<T>>, F<ImplicitPlan<T>>, F<ExactPlan<T>>>;

/// The functions that step rows in batches.
template <std::floating_point T, int Axes>
struct Kernels {
    template <class Rule>
    using ChooseAxis = ChooseStepAxis<T, Rule>;
    template <class Rule>
    using All = StepAllAxes<T, Axes, Rule>;

    OfEachRule<ChooseAxis, T> axis;
    OfEachRule<All, T> all_axes;  ///< null for rules that step such rows one at a time
    LinkedKernels<T, Axes> linked;
};

/// The kernels for the widest registers that this machine and this build (OILER_KERNELS) have, or
/// for the instruction set in the environment variable OILER_INSTRUCTIONS. Null for long double,
/// and for the baseline of a build without kernels for it; rows are then stepped one at a time,
/// with the same bits. Throws Error{usage} for an unknown or missing instruction set.
template <std::floating_point T, int Axes>
[[nodiscard]] const Kernels<T, Axes>* kernels();

}  // namespace oiler
