// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <type_traits>
#include <variant>

#include "oiler/sim/methods.hpp"

namespace oiler {

/// A splitting's stages times dt, in T.
template <std::floating_point T>
struct SplittingPlan {
    struct ScaledStage {
        Move move;
        T tau;             ///< s
        std::size_t flow;  ///< of a drift, its place in `drifts`
    };

    SplittingPlan(const Splitting& rule, T dt, Damping given) : damping(given), half_step(dt / 2) {
        for (const Stage& stage : rule.stages()) {
            const T tau = static_cast<T>(stage.coefficient) * dt;
            stages[count++] = {stage.move, tau, stage.move == Move::drift ? flow_of(tau) : 0};
        }
    }

    Damping damping;
    T half_step;
    std::array<ScaledStage, Splitting::most_stages> stages;
    std::size_t count = 0;
    /// The lengths of the drifts, each once, s.
    std::array<T, Splitting::most_stages> drifts;
    std::size_t drift_count = 0;

private:
    std::size_t flow_of(T tau) {
        std::size_t flow = 0;
        while (flow < drift_count && drifts[flow] != tau) ++flow;
        if (flow == drift_count) drifts[drift_count++] = tau;
        return flow;
    }
};

/// A tableau's coefficients times dt, in T.
template <std::floating_point T>
struct TableauPlan {
    TableauPlan(const Tableau& rule, T dt) : count(rule.count) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < i; ++j) a[i][j] = static_cast<T>(rule.a[i][j]) * dt;
            b[i] = static_cast<T>(rule.b[i]) * dt;
            c[i] = static_cast<double>(rule.c[i]) * static_cast<double>(dt);
        }
    }

    std::array<std::array<T, Tableau::most_stages>, Tableau::most_stages> a;
    std::array<T, Tableau::most_stages> b;
    std::array<double, Tableau::most_stages> c;
    std::size_t count;
};

template <std::floating_point T>
struct ImplicitPlan {
    T a;    ///< of the stage
    T tau;  ///< a·dt, s
    T dt;   ///< s
};

template <std::floating_point T>
struct ExactPlan {
    T dt;  ///< s
};

/// A method made ready for one dt.
template <std::floating_point T>
using Plan = std::variant<SplittingPlan<T>, TableauPlan<T>, ImplicitPlan<T>, ExactPlan<T>>;

template <std::floating_point T>
[[nodiscard]] Plan<T> make_plan(const Method& method, T dt, Damping damping) {
    return std::visit(
        [&]<class Rule>(const Rule& rule) -> Plan<T> {
            if constexpr (std::is_same_v<Rule, Splitting>)
                return SplittingPlan<T>(rule, dt, damping);
            else if constexpr (std::is_same_v<Rule, Tableau>)
                return TableauPlan<T>(rule, dt);
            else if constexpr (std::is_same_v<Rule, ImplicitStage>)
                return ImplicitPlan<T>{static_cast<T>(rule.a), static_cast<T>(rule.a) * dt, dt};
            else
                return ExactPlan<T>{dt};
        },
        method.rule);
}

template <std::floating_point T>
[[nodiscard]] Plan<T> make_plan(const Method& method, T dt) {
    return make_plan(method, dt, method.damping);
}

}  // namespace oiler
