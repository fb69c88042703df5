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

/// A splitting whose stages are compile-time constants, so that they all stay in registers.
template <std::floating_point T, Damping Treatment, Move... Moves>
struct FixedSplittingPlan {
    [[nodiscard]] static bool fits(const SplittingPlan<T>& plan) {
        std::size_t i = 0;
        return plan.count == count && plan.damping == Treatment &&
               ((plan.stages[i++].move == Moves) && ...);
    }
    [[gnu::always_inline]] explicit FixedSplittingPlan(const SplittingPlan<T>& plan)
        : half_step(plan.half_step) {
        std::size_t i = 0;
        stages = {ScaledStage<T>{Moves, plan.stages[i].tau, plan.stages[i++].flow}...};
    }

    static constexpr Damping damping = Treatment;
    static constexpr std::integral_constant<std::size_t, sizeof...(Moves)> count{};
    T half_step;
    std::array<ScaledStage<T>, count> stages;
};

/// The most common methods: the article's, with damping in the kick, and velocity Verlet.
template <std::floating_point T>
using KickDriftPlan = FixedSplittingPlan<T, Damping::in_kick, Move::kick, Move::drift>;
template <std::floating_point T>
using KickDriftKickPlan =
    FixedSplittingPlan<T, Damping::in_drift, Move::kick, Move::drift, Move::kick>;

/// A tableau with a compile-time number of stages, where each stage uses only the one before it.
template <std::floating_point T, std::size_t Stages>
struct ChainTableauPlan : TableauPlan<T> {
    [[nodiscard]] static bool fits(const TableauPlan<T>& plan) {
        bool chain = plan.count == Stages;
        for (std::size_t i = 0; i < plan.count; ++i)
            for (std::size_t j = 0; j + 1 < i; ++j) chain = chain && !plan.uses(i, j);
        return chain;
    }
    [[gnu::always_inline]] explicit ChainTableauPlan(const TableauPlan<T>& plan)
        : TableauPlan<T>(plan) {}

    [[nodiscard]] static constexpr bool uses(std::size_t i, std::size_t j) { return i == j + 1; }
    static constexpr std::integral_constant<std::size_t, Stages> count{};
};

/// Whether steps end with a drift, which carries a velocity that is not finite into the position.
template <class Rule>
constexpr bool ends_with_drift = false;
template <class T>
constexpr bool ends_with_drift<KickDriftPlan<T>> = true;

template <class V, int Axes>
[[gnu::always_inline]] inline bool may_be_infinite(const State<V, Axes>& state) {
    V total = state.x.axis[0] + state.v.axis[0];
    for_each_index<Axes - 1>([&](auto i) __attribute__((always_inline)) {
        total = total + (state.x.axis[i + 1] + state.v.axis[i + 1]);
    });
    return !is_finite(total);
}

/// See StepAxis. `Fixed` is the Rule of the plan, or the same with constants of compile time.
template <bool OneStep, class Parts, class Fixed, class Rule, class T>
[[gnu::flatten]] std::size_t step_axis(const AxisRows<T>& given, const Plan<T>& plan,
                                       const Steps& steps, std::size_t begin, std::size_t end) {
    using V = std::conditional_t<OneStep, AxisBatchOfOneStep<T>, AxisBatch<T, Parts>>;
    const Fixed fixed(*std::get_if<Rule>(&plan));
    const AxisRows<T> rows = given;  // no store changes a local value
    for (std::size_t row = begin; row < end; row += V::lanes) {
        auto physics = physics_of<V>(rows, row, Parts{}, damping_of_rule(fixed));
        State<V, 1> state{{V::load(rows.x + row)}, {V::load(rows.v + row)}};
        if constexpr (OneStep)
            advance(fixed, state, physics, steps.rate.time(steps.first));
        else
            take_steps(fixed, state, physics, steps);
        if (ends_with_drift<Fixed> ? !is_finite(state.x.axis[0]) : may_be_infinite(state))
            return row;
        state.x.axis[0].store(rows.x + row);
        state.v.axis[0].store(rows.v + row);
        if (row == 0 && rows.evaluations) *rows.evaluations += physics.evaluations();
    }
    return end;
}

/// See StepAllAxes.
template <class V, class Rule, class T, int Axes>
[[gnu::flatten]] std::size_t step_all_axes(Columns<T, Axes>& columns, Kinds kinds,
                                           const Steps& steps, std::size_t begin, std::size_t end) {
    const Rule& rule = *std::get_if<Rule>(&columns.plan_cache.plan);
    for (std::size_t row = begin; row < end; row += V::lanes) {
        auto physics = physics_of<V>(columns.views, row, kinds, damping_of_rule(rule));
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

/// See RowKernels::axis.
template <class T, class Rule, class Fixed = Rule>
constexpr auto along_axis = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<StepAxis<T>, sizeof...(I)>{
        step_axis<(I & 8U) != 0, PartsOf<(I & 7U)>, Fixed, Rule, T>...};
}
(std::make_index_sequence<16>{});

template <class T, int Axes>
[[gnu::flatten]] RowKernels<T, Axes> kernels_for(const Plan<T>& plan) {
    using S = SplittingPlan<T>;
    using R = TableauPlan<T>;
    if (const auto* const rule = std::get_if<S>(&plan)) {
        const auto* axis = &along_axis<T, S>;
        if (KickDriftPlan<T>::fits(*rule)) axis = &along_axis<T, S, KickDriftPlan<T>>;
        if (KickDriftKickPlan<T>::fits(*rule)) axis = &along_axis<T, S, KickDriftKickPlan<T>>;
        return {axis, step_all_axes<Wide<T, Axes>, S, T, Axes>};
    }
    if (const auto* const rule = std::get_if<R>(&plan)) {
        const auto* axis = &along_axis<T, R>;
        if (ChainTableauPlan<T, 4>::fits(*rule)) axis = &along_axis<T, R, ChainTableauPlan<T, 4>>;
        if (ChainTableauPlan<T, 2>::fits(*rule)) axis = &along_axis<T, R, ChainTableauPlan<T, 2>>;
        return {axis, step_all_axes<Narrow<T, Axes>, R, T, Axes>};
    }
    if (std::get_if<ImplicitPlan<T>>(&plan)) return {&along_axis<T, ImplicitPlan<T>>, nullptr};
    return {&along_axis<T, ExactPlan<T>>, nullptr};
}

}  // namespace

template <class T, int Axes>
const Kernels<T, Axes>& kernels() {
    static constexpr Kernels<T, Axes> all{kernels_for<T, Axes>,
                                          linked_kernels<Narrow<T, Axes>, T, Axes>()};
    return all;
}

template const Kernels<OILER_PRECISION, 1>& kernels();
template const Kernels<OILER_PRECISION, 2>& kernels();
template const Kernels<OILER_PRECISION, 3>& kernels();

}  // namespace oiler::OILER_INSTRUCTIONS
