// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "oiler/physics/plan.hpp"
#include "oiler/sim/columns.hpp"
#include "oiler/sim/step_rows.hpp"

namespace oiler {

/// The operations on all rows in steps of linked rows, see link_rows.hpp.
template <std::floating_point T, int Axes>
struct LinkedKernels {
    void (*accelerate)(const Columns<T, Axes>&, const MotionColumns<T, Axes>&, Evaluate, double t,
                       VecColumns<T, Axes>& out);
    void (*push_links)(const LinkCache<T, Axes>&, const MotionColumns<T, Axes>&, Evaluate,
                       VecColumns<T, Axes>& to);
    void (*add_scaled)(VecColumns<T, Axes>& to, const VecColumns<T, Axes>& what, T s);
    bool (*may_be_infinite)(const MotionColumns<T, Axes>&);
};

/// The functions that step rows in batches. Each steps the rows from `begin`, a multiple of
/// row_padding, to `end`. It returns `end`, or the first row of a batch that it did not store
/// because a number in it may no longer be finite.
template <std::floating_point T, int Axes>
struct Kernels {
    template <class Rule>
    using Step = std::size_t (*)(Columns<T, Axes>&, const Rule&, const Steps&, std::size_t begin,
                                 std::size_t end);

    Step<SplittingPlan<T>> splitting;
    Step<TableauPlan<T>> tableau;
    Step<ExactPlan<T>> exact;
    LinkedKernels<T, Axes> linked;
};

/// The kernels for the widest registers that this machine and this build (OILER_KERNELS) have, or
/// for the instruction set in the environment variable OILER_INSTRUCTIONS. Null for the baseline of
/// a build without kernels for it; rows are then stepped one at a time, with the same bits. Throws
/// Error{usage} for an unknown or missing instruction set.
template <std::floating_point T, int Axes>
[[nodiscard]] const Kernels<T, Axes>* kernels();

}  // namespace oiler
