// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "oiler/sim/columns.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/sim/step_rows.hpp"

namespace oiler {

/// What steps of linked rows do to all of them, see link_rows.hpp.
template <std::floating_point T, int Axes>
struct LinkedKernels {
    void (*accelerate)(const Columns<T, Axes>&, const MotionColumns<T, Axes>&, Evaluate, double t,
                       VecColumns<T, Axes>& out);
    void (*push_links)(const LinkCache<T, Axes>&, const MotionColumns<T, Axes>&, Evaluate,
                       VecColumns<T, Axes>& to);
    void (*add_scaled)(VecColumns<T, Axes>& to, const VecColumns<T, Axes>& what, T s);
    bool (*may_be_infinite)(const MotionColumns<T, Axes>&);
};

/// What steps rows in batches. Each takes rows from `begin`, a multiple of row_padding, to `end`,
/// and returns the first row of a batch that it left as it was because a number in it may have
/// stopped being finite, or `end`.
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

/// The kernels for the widest registers of this machine that this build has (OILER_KERNELS), or for
/// those that the environment variable OILER_INSTRUCTIONS names. Null for the baseline of a build
/// without kernels for it: rows are then stepped one at a time, to the same bits. Throws
/// Error{usage} for a name that is none of these.
template <std::floating_point T, int Axes>
[[nodiscard]] const Kernels<T, Axes>* kernels();

}  // namespace oiler
