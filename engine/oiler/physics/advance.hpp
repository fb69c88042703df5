// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "oiler/physics/plan.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

// Each method is written once. It steps one body or a batch of bodies (State and RowPhysics), or
// all bodies of a world with links (MotionColumns and LinkedRows). A test may pass any type that
// has `accelerate(state, t)`. RowPhysics and LinkedRows add the functions that some methods need
// beyond it.

/// to += what·s. A physics may do it itself, for example on several threads.
template <class Physics, class Vector, class T>
[[gnu::always_inline]] inline void add_scaled(Physics& physics, Vector& to, const Vector& what,
                                              const T& s) {
    if constexpr (requires { physics.add_scaled(to, what, s); })
        physics.add_scaled(to, what, s);
    else
        add_scaled(to, what, s);
}

/// A physics that applies damping outside the kicks.
template <class Physics, class State>
concept SplitsDamping = requires(Physics& physics, State& state, double t) {
    physics.kick(state, t);
};

/// A physics with damping that is not linear.
template <class Physics, class State>
concept DampsAround = requires(Physics& physics, State& state) {
    physics.damp_before(state);
    physics.damp_after(state);
};

/// One step of a splitting from time `t` (s): kicks and drifts in turn, between two half-steps of
/// the damping that is not linear.
template <SplitsSteps Plan, class State, class Physics>
[[gnu::always_inline]] inline bool advance(const Plan& plan, State& state, Physics& physics,
                                           double t) {
    constexpr bool splits_damping = SplitsDamping<Physics, State>;
    if constexpr (DampsAround<Physics, State>) physics.damp_before(state);
    repeat(
        plan.count, [&](auto i) __attribute__((always_inline)) {
            const auto& stage = plan.stages[i];
            if (stage.move == Move::kick) {
                if constexpr (splits_damping)
                    add_scaled(physics, state.v, physics.kick(state, t), stage.tau);
                else
                    add_scaled(physics, state.v, physics.accelerate(state, t), stage.tau);
            } else {
                if constexpr (splits_damping)
                    physics.drift(state, stage.flow, stage.tau);
                else
                    add_scaled(physics, state.x, state.v, stage.tau);
                t += static_cast<double>(stage.tau);
            }
        });
    if constexpr (DampsAround<Physics, State>) physics.damp_after(state);
    return true;
}

/// The rates of change at a state: the article's Derivative.
template <class State>
struct Derivative {
    decltype(State::v) dx;
    decltype(State::v) dv;
};

template <class State>
using Derivatives = std::array<Derivative<State>, Tableau::most_stages>;

/// The memory of a step of a Runge–Kutta method.
template <class State>
struct Stages {
    Derivatives<State> k;
    State initial;
    State at;
};

/// One step of a Runge–Kutta method from time `t` (s): the article's evaluate and integrate, for
/// any tableau. Each stage starts from the initial state plus the weighted rates of the stages
/// before it. The states are separate from k, whose indices would keep them in memory.
template <IsTableau Plan, class State, class Physics>
[[gnu::always_inline]] inline void advance(const Plan& plan, State& state, Physics& physics,
                                           double t, Derivatives<State>& k, State& initial,
                                           State& at) {
    initial = state;
    repeat(
        plan.count, [&](auto i) __attribute__((always_inline)) {
            at = initial;
            repeat(
                i, [&](auto j) __attribute__((always_inline)) {
                    if (!plan.uses(i, j)) return;
                    add_scaled(physics, at.x, k[j].dx, plan.a[i][j]);
                    add_scaled(physics, at.v, k[j].dv, plan.a[i][j]);
                });
            k[i].dx = at.v;
            k[i].dv = physics.accelerate(at, t + plan.c[i]);
            if (plan.b[i] == 0) return;
            add_scaled(physics, state.x, k[i].dx, plan.b[i]);
            add_scaled(physics, state.v, k[i].dv, plan.b[i]);
        });
}

/// One step of a Runge–Kutta method. A physics of large states may keep their memory from step to
/// step.
template <IsTableau Plan, class State, class Physics>
[[gnu::always_inline]] inline bool advance(const Plan& plan, State& state, Physics& physics,
                                           double t) {
    if constexpr (requires { physics.stages(); }) {
        Stages<State>& stages = physics.stages();
        advance(plan, state, physics, t, stages.k, stages.initial, stages.at);
    } else {
        Derivatives<State> k;
        State initial;
        State at;
        advance(plan, state, physics, t, k, initial, at);
    }
    return true;
}

/// A physics of forces that are linear in position and velocity.
template <class Physics>
concept IsLinear = Physics::is_linear;

/// Newton's change of the velocity w of an implicit stage, w = v + τ·a(x + τ·w, w), from `at.v` on;
/// sets the position of the stage.
template <std::floating_point T, class State, class Physics>
[[gnu::always_inline]] inline auto newton_change(const ImplicitPlan<T>& plan, const State& state,
                                                 State& at, Physics& physics, double t) {
    at.x = state.x;
    add_scaled(physics, at.x, at.v, plan.tau);
    auto residual = at.v;
    add_scaled(physics, residual, state.v, T(-1));
    add_scaled(physics, residual, physics.accelerate(at, t), -plan.tau);
    return physics.solve(at, plan.tau, residual);
}

/// Ends a step with the velocity w of its stage.
template <std::floating_point T, class State, class Physics>
[[gnu::always_inline]] inline void end_step(const ImplicitPlan<T>& plan, State& state, State& at,
                                            Physics& physics) {
    add_scaled(physics, state.x, at.v, plan.dt);
    add_scaled(physics, at.v, state.v, T(-1));
    add_scaled(physics, state.v, at.v, 1 / plan.a);
}

inline constexpr int most_iterations = 64;

/// One step of an implicit method from time `t` (s): Newton's iteration. It has converged when a
/// change is below the round-off of w, or is small and no longer halves.
template <std::floating_point T, class State, class Physics>
[[nodiscard]] bool advance(const ImplicitPlan<T>& plan, State& state, Physics& physics, double t) {
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    const double stage_t = t + static_cast<double>(plan.tau);
    State at = state;
    T before = std::numeric_limits<T>::infinity();
    for (int i = 0; i < most_iterations; ++i) {
        const auto change = newton_change(plan, state, at, physics, stage_t);
        add_scaled(physics, at.v, change, T(-1));
        const T size = largest(change);
        const T scale = largest(at.v) + largest(state.v) + std::numeric_limits<T>::min() / epsilon;
        if (!std::isfinite(size)) return false;
        const bool small = size <= std::sqrt(epsilon) * (scale + largest(at.x) / plan.tau);
        if (size <= epsilon * scale || (small && size > before / 2)) {
            end_step(plan, state, at, physics);
            return true;
        }
        before = size;
    }
    return false;
}

/// An implicit step under linear forces. The first iteration is exact but for round-off, which the
/// second removes.
template <std::floating_point T, class State, IsLinear Physics>
[[gnu::always_inline]] inline bool advance(const ImplicitPlan<T>& plan, State& state,
                                           Physics& physics, double t) {
    const double stage_t = t + static_cast<double>(plan.tau);
    State at = state;
    for (int i = 0; i < 2; ++i)
        add_scaled(physics, at.v, newton_change(plan, state, at, physics, stage_t), T(-1));
    end_step(plan, state, at, physics);
    return true;
}

/// One step along the exact motion under linear forces.
template <std::floating_point T, class State, class Physics>
[[gnu::always_inline]] inline bool advance(const ExactPlan<T>&, State& state, Physics& physics,
                                           double t) {
    physics.respond(state, t);
    return true;
}

/// One step of any explicit method over one state; for readers and tests.
template <std::floating_point T, int Axes, class Physics>
void advance(const Plan<T>& plan, State<T, Axes>& state, Physics& physics, double t) {
    if (const auto* splitting = std::get_if<SplittingPlan<T>>(&plan))
        advance(*splitting, state, physics, t);
    else
        advance(std::get<TableauPlan<T>>(plan), state, physics, t);
}

}  // namespace oiler
