// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "oiler/physics/plan.hpp"
#include "oiler/sim/columns.hpp"
#include "oiler/sim/step_blocks.hpp"

namespace oiler {

/// The part of an acceleration to evaluate: the part that depends on position alone, or all.
enum class Evaluate { field, all };

/// The rows that one thread writes; it begins a block.
struct RowRange {
    std::size_t begin;
    std::size_t end;

    [[nodiscard]] [[gnu::always_inline]] bool holds(std::size_t row) const {
        return row >= begin && row < end;
    }
};

/// The operations on all rows in steps of linked rows, see link_rows.hpp.
template <std::floating_point T, int Axes>
struct LinkedKernels {
    void (*accelerate)(const Columns<T, Axes>&, const RowViews<T, Axes>&,
                       const MotionColumns<T, Axes>&, Evaluate, double t, const RowRange&,
                       VecColumns<T, Axes>& out);
    void (*push_links)(const PreparedLinks<T>&, const MotionColumns<T, Axes>&, Evaluate,
                       const RowRange&, VecColumns<T, Axes>& to);
    /// Half-steps of the dampers at fixed positions, one link after the other; `reverse` begins
    /// with the last.
    void (*damp_links)(const PreparedLinks<T>&, MotionColumns<T, Axes>&, bool reverse);
    /// A drift with linear damping, see RowPhysics::drift.
    void (*drift)(const RowViews<T, Axes>&, std::size_t flow, const RowRange&,
                  MotionColumns<T, Axes>&);
    void (*add_scaled)(VecColumns<T, Axes>& to, const VecColumns<T, Axes>& what, T s,
                       const RowRange&);
    bool (*may_be_infinite)(const MotionColumns<T, Axes>&, const RowRange&);
};

/// The index of linear forces with these parts in the arrays of AxisKernels.
[[nodiscard]] constexpr std::size_t index_of(const LinearParts& parts) {
    return std::size_t{parts.constant} + 2 * std::size_t{parts.spring} +
           4 * std::size_t{parts.damping};
}

/// The functions that step rows under linear forces in batches along their axes, by
/// index_of(parts); see step_axis_batches.
template <std::floating_point T>
struct AxisKernels {
    template <class Rule>
    using StepsByParts = std::array<bool (*)(std::span<const AxisRows<T>>, const Rule&,
                                             const Steps&, AxisPlace& at, std::size_t end),
                                    8>;

    StepsByParts<SplittingPlan<T>> splitting;
    StepsByParts<TableauPlan<T>> tableau;
    StepsByParts<ImplicitPlan<T>> implicit;
    StepsByParts<ExactPlan<T>> exact;

    [[nodiscard]] const auto& of(const SplittingPlan<T>&) const { return splitting; }
    [[nodiscard]] const auto& of(const TableauPlan<T>&) const { return tableau; }
    [[nodiscard]] const auto& of(const ImplicitPlan<T>&) const { return implicit; }
    [[nodiscard]] const auto& of(const ExactPlan<T>&) const { return exact; }
};

/// The functions that step rows in batches. The first two step rows under any forces, see
/// step_batches.
template <std::floating_point T, int Axes>
struct Kernels {
    template <class Rule>
    using Step = std::size_t (*)(Columns<T, Axes>&, const RowViews<T, Axes>&, Kinds, const Rule&,
                                 const Steps&, std::size_t begin, std::size_t end);

    Step<SplittingPlan<T>> splitting;
    Step<TableauPlan<T>> tableau;
    AxisKernels<T> axis;
    LinkedKernels<T, Axes> linked;
};

/// The kernels for the widest registers that this machine and this build (OILER_KERNELS) have, or
/// for the instruction set in the environment variable OILER_INSTRUCTIONS. Null for the baseline of
/// a build without kernels for it; rows are then stepped one at a time, with the same bits. Throws
/// Error{usage} for an unknown or missing instruction set.
template <std::floating_point T, int Axes>
[[nodiscard]] const Kernels<T, Axes>* kernels();

}  // namespace oiler
