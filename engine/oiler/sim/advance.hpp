// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <type_traits>
#include <utility>
#include <variant>

#include "oiler/sim/methods.hpp"
#include "oiler/sim/vec.hpp"

namespace oiler {

/// A splitting's stages times dt, in T.
template <std::floating_point T>
struct SplittingPlan {
    struct ScaledStage {
        Move move;
        T tau;  ///< s
    };

    SplittingPlan(const Splitting& rule, T step) {
        for (const Stage& stage : rule.stages)
            stages[count++] = {stage.move, static_cast<T>(stage.coefficient) * step};
    }

    std::array<ScaledStage, Splitting::most_stages> stages;
    std::size_t count = 0;
};

/// A tableau's coefficients times dt, in T.
template <std::floating_point T>
struct TableauPlan {
    TableauPlan(const Tableau& rule, T step) : count(rule.b.size()) {
        std::size_t next = 0;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < i; ++j) a[i][j] = static_cast<T>(rule.a[next++]) * step;
            b[i] = static_cast<T>(rule.b[i]) * step;
            c[i] = static_cast<double>(rule.c[i]) * static_cast<double>(step);
        }
    }

    std::array<std::array<T, Tableau::most_stages>, Tableau::most_stages> a;
    std::array<T, Tableau::most_stages> b;
    std::array<double, Tableau::most_stages> c;
    std::size_t count;
};

/// A method made ready for one dt.
template <std::floating_point T>
using Plan = std::variant<SplittingPlan<T>, TableauPlan<T>>;

template <std::floating_point T>
[[nodiscard]] Plan<T> make_plan(const Method& method, T dt) {
    return std::visit(
        [&]<class Rule>(const Rule& rule) -> Plan<T> {
            if constexpr (std::is_same_v<Rule, Splitting>)
                return Plan<T>(std::in_place_type<SplittingPlan<T>>, rule, dt);
            else
                return Plan<T>(std::in_place_type<TableauPlan<T>>, rule, dt);
        },
        method.rule);
}

/// One step of a splitting from time `t` (s): kicks and drifts in turn. `Physics` has
/// `accelerate(state, t)`.
template <Number V, int Axes, class Physics>
[[gnu::always_inline]] inline void advance(const SplittingPlan<Scalar<V>>& plan,
                                           State<V, Axes>& state, const Physics& physics,
                                           double t) {
    for (std::size_t i = 0; i < plan.count; ++i) {
        const V tau(plan.stages[i].tau);
        if (plan.stages[i].move == Move::kick) {
            state.v = state.v + physics.accelerate(state, t) * tau;
        } else {
            state.x = state.x + state.v * tau;
            t += static_cast<double>(plan.stages[i].tau);
        }
    }
}

/// The rates of change at some state: the article's Derivative.
template <Number V, int Axes>
struct Derivative {
    Vec<V, Axes> dx;
    Vec<V, Axes> dv;
};

/// One step of a Runge–Kutta method from time `t` (s): each stage evaluates the derivatives where
/// the stages before it lead, and their weighted sum moves the state.
template <Number V, int Axes, class Physics>
[[gnu::always_inline]] inline void advance(const TableauPlan<Scalar<V>>& plan,
                                           State<V, Axes>& state, const Physics& physics,
                                           double t) {
    std::array<Derivative<V, Axes>, Tableau::most_stages> k;
    for (std::size_t i = 0; i < plan.count; ++i) {
        State<V, Axes> at = state;
        for (std::size_t j = 0; j < i; ++j) {
            const V tau(plan.a[i][j]);
            at.x = at.x + k[j].dx * tau;
            at.v = at.v + k[j].dv * tau;
        }
        k[i] = {at.v, physics.accelerate(at, t + plan.c[i])};
    }
    for (std::size_t i = 0; i < plan.count; ++i) {
        const V tau(plan.b[i]);
        state.x = state.x + k[i].dx * tau;
        state.v = state.v + k[i].dv * tau;
    }
}

/// One step of any method over one state: what a reader or a test calls.
template <std::floating_point T, int Axes, class Physics>
void advance(const Plan<T>& plan, State<T, Axes>& state, const Physics& physics, double t) {
    std::visit([&](const auto& rule) { advance(rule, state, physics, t); }, plan);
}

}  // namespace oiler
