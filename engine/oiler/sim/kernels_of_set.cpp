// SPDX-License-Identifier: MIT
// The kernels for one instruction set and one precision, OILER_INSTRUCTIONS and OILER_PRECISION.
// This file is compiled once for each pair. Every function here is a template over the registers of
// its set, or always inlined, so that no two sets share a function.
#include <algorithm>

#include "oiler/math/batch.hpp"
#include "oiler/sim/kernels.hpp"
#include "oiler/sim/link_rows.hpp"

namespace oiler::OILER_INSTRUCTIONS {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif
template <class T>
using Register = Pack<T, register_bytes>;

/// Registers per batch along one axis: enough to hide the latency of dependent operations. Springs
/// and dampers have long chains of them, for which spilling some registers of a small set pays.
template <class T, class Parts>
using AxisBatch =
    Batch<Register<T>, register_bytes == 64 || Parts::spring || Parts::damping ? 8 : 4>;
/// One step per call is bound by loads and stores, so that spilling costs more than latency.
template <class T>
using AxisBatchOfOneStep = Batch<Register<T>, 4>;

/// The largest number of registers per batch that leaves registers free for intermediate results,
/// with forces along all axes.
template <class T, int Axes>
constexpr std::size_t most_packs() {
    constexpr std::size_t room = register_bytes == 64 ? 24 : 12;
    std::size_t packs = 1;
    while (2 * Axes * packs * 2 <= room && 2 * packs * Register<T>::lanes <= row_padding)
        packs *= 2;
    return packs;
}
template <class T, int Axes>
using Wide = Batch<Register<T>, most_packs<T, Axes>()>;
/// Runge–Kutta methods hold several states.
template <class T, int Axes>
using Narrow = Batch<Register<T>, (most_packs<T, Axes>() + 1) / 2>;

template <class Parts, class Fixed, class T, class Rule>
[[gnu::flatten, gnu::noinline]] std::size_t step_axis(const AxisRows<T>& rows, const Rule& rule,
                                                      const Steps& steps, std::size_t begin,
                                                      std::size_t end) {
    const Fixed fixed(rule);
    if (steps.count == 1)
        return step_axis_batches<AxisBatchOfOneStep<T>, Parts, true>(rows, fixed, steps, begin,
                                                                     end);
    return step_axis_batches<AxisBatch<T, Parts>, Parts, false>(rows, fixed, steps, begin, end);
}

/// Steps the rows from `at` to `end` along their axes. Returns false at a batch that it did not
/// store because a number in it may no longer be finite.
template <class Parts, class Fixed, class T, class Rule>
bool step_axes(std::span<const AxisRows<T>> axes, const Rule& rule, const Steps& steps,
               AxisPlace& at, std::size_t end) {
    for (; at.begin < end; at = {at.begin + rows_per_axis, 0, at.begin + rows_per_axis}) {
        const std::size_t stop = std::min(at.begin + rows_per_axis, end);
        for (; at.axis < axes.size(); ++at.axis, at.row = at.begin) {
            if (at.row >= stop) continue;
            at.row = step_axis<Parts, Fixed>(axes[at.axis], rule, steps, at.row, stop);
            if (at.row < stop) return false;
        }
    }
    return true;
}

template <class Parts, class T>
bool step_axes_splitting(std::span<const AxisRows<T>> axes, const SplittingPlan<T>& rule,
                         const Steps& steps, AxisPlace& at, std::size_t end) {
    if (KickDriftPlan<T>::fits(rule))
        return step_axes<Parts, KickDriftPlan<T>>(axes, rule, steps, at, end);
    if (KickDriftKickPlan<T>::fits(rule))
        return step_axes<Parts, KickDriftKickPlan<T>>(axes, rule, steps, at, end);
    return step_axes<Parts, SplittingPlan<T>>(axes, rule, steps, at, end);
}

template <class Parts, class T>
bool step_axes_tableau(std::span<const AxisRows<T>> axes, const TableauPlan<T>& rule,
                       const Steps& steps, AxisPlace& at, std::size_t end) {
    if (ChainTableauPlan<T, 4>::fits(rule))
        return step_axes<Parts, ChainTableauPlan<T, 4>>(axes, rule, steps, at, end);
    if (ChainTableauPlan<T, 2>::fits(rule))
        return step_axes<Parts, ChainTableauPlan<T, 2>>(axes, rule, steps, at, end);
    return step_axes<Parts, TableauPlan<T>>(axes, rule, steps, at, end);
}

/// The parts of linear forces with index I, see index_of. Without any part, the steps for a
/// constant force of 0 cost as little.
template <std::size_t I>
using PartsOf = FixedLinearParts<I == 0 || (I & 1U) != 0, (I & 2U) != 0, (I & 4U) != 0>;

template <class T, std::size_t... I>
constexpr AxisKernels<T> axis_kernels(std::index_sequence<I...>) {
    return {{step_axes_splitting<PartsOf<I>, T>...},
            {step_axes_tableau<PartsOf<I>, T>...},
            {step_axes<PartsOf<I>, ImplicitPlan<T>, T, ImplicitPlan<T>>...},
            {step_axes<PartsOf<I>, ExactPlan<T>, T, ExactPlan<T>>...}};
}

template <class V, class T, int Axes, class Rule>
[[gnu::flatten]] std::size_t step_all_axes(Columns<T, Axes>& columns,
                                           const RowViews<T, Axes>& views, Kinds kinds,
                                           const Rule& rule, const Steps& steps, std::size_t begin,
                                           std::size_t end) {
    return step_batches<V>(columns, views, kinds, rule, steps, begin, end);
}

}  // namespace

template <class T, int Axes>
const Kernels<T, Axes>& kernels() {
    using V = Wide<T, Axes>;
    static constexpr Kernels<T, Axes> all{step_all_axes<V, T, Axes, SplittingPlan<T>>,
                                          step_all_axes<Narrow<T, Axes>, T, Axes, TableauPlan<T>>,
                                          axis_kernels<T>(std::make_index_sequence<8>{}),
                                          linked_kernels<Narrow<T, Axes>, T, Axes>()};
    return all;
}

template const Kernels<OILER_PRECISION, 1>& kernels();
template const Kernels<OILER_PRECISION, 2>& kernels();
template const Kernels<OILER_PRECISION, 3>& kernels();

}  // namespace oiler::OILER_INSTRUCTIONS
