// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <type_traits>
#include <variant>

#include "oiler/physics/methods/methods.hpp"

namespace oiler {

template <std::floating_point T>
struct ScaledStage {
    Move move = Move::kick;
    T tau = 0;             ///< s
    std::size_t flow = 0;  ///< index of a drift in the plan's `drifts`
};

/// The stages of a splitting, scaled by dt, in T.
template <std::floating_point T>
struct SplittingPlan {
    SplittingPlan(const Splitting& rule, T dt, Damping given) : damping(given), half_step(dt / 2) {
        for (const Stage& stage : rule.stages()) {
            const T tau = static_cast<T>(stage.coefficient) * dt;
            stages[count++] = {stage.move, tau, stage.move == Move::drift ? flow_of(tau) : 0};
        }
    }

    Damping damping;
    T half_step;
    std::array<ScaledStage<T>, Splitting::most_stages> stages;
    std::size_t count = 0;
    /// The distinct lengths of the drifts, s.
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

template <class Plan>
concept SplitsSteps = requires(const Plan& plan) {
    plan.stages[0].move;
    plan.damping;
};

/// The coefficients of a tableau, scaled by dt, in T.
template <std::floating_point T>
struct TableauPlan {
    TableauPlan(const Tableau& rule, T dt) : count(rule.count) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < i; ++j) a[i][j] = static_cast<T>(rule.a[i][j]) * dt;
            b[i] = static_cast<T>(rule.b[i]) * dt;
            c[i] = static_cast<double>(rule.c[i]) * static_cast<double>(dt);
        }
    }
    /// Whether stage i uses the rates of stage j.
    [[nodiscard]] bool uses(std::size_t i, std::size_t j) const { return a[i][j] != 0; }

    std::array<std::array<T, Tableau::most_stages>, Tableau::most_stages> a;
    std::array<T, Tableau::most_stages> b;
    std::array<double, Tableau::most_stages> c;
    std::size_t count;
};

template <class Plan>
concept IsTableau = requires(const Plan& plan) {
    plan.a[0][0] + plan.b[0];
};

template <std::floating_point T>
struct ImplicitPlan {
    T a;    ///< coefficient of the stage
    T tau;  ///< a·dt, s
    T dt;   ///< s
};

template <std::floating_point T>
struct ExactPlan {
    T dt;  ///< s
};

/// A method prepared for one dt.
template <std::floating_point T>
using Plan = std::variant<SplittingPlan<T>, TableauPlan<T>, ImplicitPlan<T>, ExactPlan<T>>;

/// Replaces a plan in place: it is large, and shorter steps need one each.
template <std::floating_point T>
void replace_plan(Plan<T>& plan, const Method& method, T dt, Damping damping) {
    std::visit(
        [&]<class Rule>(const Rule& rule) {
            if constexpr (std::is_same_v<Rule, Splitting>)
                plan.template emplace<SplittingPlan<T>>(rule, dt, damping);
            else if constexpr (std::is_same_v<Rule, Tableau>)
                plan.template emplace<TableauPlan<T>>(rule, dt);
            else if constexpr (std::is_same_v<Rule, ImplicitStage>)
                plan = ImplicitPlan<T>{static_cast<T>(rule.a), static_cast<T>(rule.a) * dt, dt};
            else
                plan = ExactPlan<T>{dt};
        },
        method.rule);
}

template <std::floating_point T>
[[nodiscard]] Plan<T> make_plan(const Method& method, T dt, Damping damping) {
    Plan<T> plan = ExactPlan<T>{dt};
    replace_plan(plan, method, dt, damping);
    return plan;
}

/// Where steps of the plan apply forces that depend on velocity.
template <std::floating_point T>
[[nodiscard]] Damping damping_of(const Plan<T>& plan) {
    const auto* const splitting = std::get_if<SplittingPlan<T>>(&plan);
    return splitting ? splitting->damping : Damping::in_kick;
}

template <std::floating_point T>
[[nodiscard]] Plan<T> make_plan(const Method& method, T dt) {
    return make_plan(method, dt, method.damping);
}

}  // namespace oiler
