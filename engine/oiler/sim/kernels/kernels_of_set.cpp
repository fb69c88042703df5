// SPDX-License-Identifier: MIT
// The kernels for one instruction set and one precision, OILER_INSTRUCTIONS and OILER_PRECISION.
// This file is compiled once for each pair. Every function here is a template over the registers of
// its set, or always inlined, so that no two sets share a function.
#include <array>
#include <type_traits>
#include <utility>

#include "oiler/math/batch.hpp"
#include "oiler/sim/kernels/kernels.hpp"

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

template <class V, int Axes>
[[gnu::always_inline]] inline bool may_be_infinite(const State<V, Axes>& state) {
    V total = state.x.axis[0] + state.v.axis[0];
    for_each_index<Axes - 1>([&](auto i) __attribute__((always_inline)) {
        total = total + (state.x.axis[i + 1] + state.v.axis[i + 1]);
    });
    return !is_finite(total);
}

/// See StepAxis. `Fixed` is the rule, or the same with constants of compile time.
template <bool OneStep, class Parts, class Fixed, class T, class Rule>
[[gnu::flatten]] std::size_t step_axis(const AxisRows<T>& given, const Rule& rule,
                                       const Steps& steps, std::size_t begin, std::size_t end) {
    using V = std::conditional_t<OneStep, AxisBatchOfOneStep<T>, AxisBatch<T, Parts>>;
    const Fixed fixed(rule);
    const AxisRows<T> rows = given;  // no store changes a local value
    for (std::size_t row = begin; row < end; row += V::lanes) {
        auto physics = physics_of<V>(rows, row, Parts{}, damping_of(fixed));
        State<V, 1> state{{V::load(rows.x + row)}, {V::load(rows.v + row)}};
        if constexpr (OneStep)
            take_one_step(fixed, state, physics, steps);
        else
            take_steps(fixed, state, physics, steps);
        if (may_be_infinite(state)) return row;
        state.x.axis[0].store(rows.x + row);
        state.v.axis[0].store(rows.v + row);
        if (row == 0 && rows.evaluations) *rows.evaluations += physics.evaluations();
    }
    return end;
}

/// See StepAllAxes.
template <class V, class T, int Axes, class Rule>
[[gnu::flatten]] std::size_t step_all_axes(Columns<T, Axes>& columns,
                                           const RowViews<T, Axes>& views, Kinds kinds,
                                           const Rule& rule, const Steps& steps, std::size_t begin,
                                           std::size_t end) {
    for (std::size_t row = begin; row < end; row += V::lanes) {
        auto physics = physics_of<V>(views, row, kinds, damping_of(rule));
        State<V, Axes> state = load<V>(columns.motion, row);
        take_steps(rule, state, physics, steps);
        if (may_be_infinite(state)) return row;
        store(state, columns.motion, row);
        if (row == 0) columns.evaluations += physics.evaluations();
    }
    return end;
}

/// The parts of linear forces as the bits of I. Without any part, the steps for a constant force of
/// 0 cost as little.
template <std::size_t I>
using PartsOf = FixedLinearParts<I == 0 || (I & 1U) != 0, (I & 2U) != 0, (I & 4U) != 0>;

template <class Fixed, class T, class Rule>
StepAxis<T, Rule> step_axis_of(const LinearParts& parts, bool one_step) {
    static constexpr auto all = []<std::size_t... I>(std::index_sequence<I...>) {
        return std::array<StepAxis<T, Rule>, sizeof...(I)>{
            step_axis<(I & 8U) != 0, PartsOf<(I & 7U)>, Fixed, T, Rule>...};
    }
    (std::make_index_sequence<16>{});
    return all[std::size_t{parts.constant} + 2 * std::size_t{parts.spring} +
               4 * std::size_t{parts.damping} + 8 * std::size_t{one_step}];
}

template <class T, class Rule>
StepAxis<T, Rule> choose_step_axis(const Rule& rule, const LinearParts& parts, bool one_step) {
    if constexpr (std::is_same_v<Rule, SplittingPlan<T>>) {
        if (KickDriftPlan<T>::fits(rule))
            return step_axis_of<KickDriftPlan<T>, T, Rule>(parts, one_step);
        if (KickDriftKickPlan<T>::fits(rule))
            return step_axis_of<KickDriftKickPlan<T>, T, Rule>(parts, one_step);
    }
    if constexpr (std::is_same_v<Rule, TableauPlan<T>>) {
        if (ChainTableauPlan<T, 4>::fits(rule))
            return step_axis_of<ChainTableauPlan<T, 4>, T, Rule>(parts, one_step);
        if (ChainTableauPlan<T, 2>::fits(rule))
            return step_axis_of<ChainTableauPlan<T, 2>, T, Rule>(parts, one_step);
    }
    return step_axis_of<Rule, T, Rule>(parts, one_step);
}

}  // namespace

template <class T, int Axes>
const Kernels<T, Axes>& kernels() {
    static constexpr Kernels<T, Axes> all{
        {choose_step_axis<T, SplittingPlan<T>>, choose_step_axis<T, TableauPlan<T>>,
         choose_step_axis<T, ImplicitPlan<T>>, choose_step_axis<T, ExactPlan<T>>},
        {step_all_axes<Wide<T, Axes>, T, Axes, SplittingPlan<T>>,
         step_all_axes<Narrow<T, Axes>, T, Axes, TableauPlan<T>>, nullptr, nullptr},
        linked_kernels<Narrow<T, Axes>, T, Axes>()};
    return all;
}

template const Kernels<OILER_PRECISION, 1>& kernels();
template const Kernels<OILER_PRECISION, 2>& kernels();
template const Kernels<OILER_PRECISION, 3>& kernels();

}  // namespace oiler::OILER_INSTRUCTIONS
