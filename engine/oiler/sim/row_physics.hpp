// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/sim/batch.hpp"
#include "oiler/sim/columns.hpp"
#include "oiler/sim/plan.hpp"

namespace oiler {

/// One row's number, or a batch of rows'.
template <Number V, std::floating_point T>
[[gnu::always_inline]] inline V load(const Parameter<T>& parameter, std::size_t row) {
    if constexpr (std::is_same_v<V, T>)
        return parameter[row];
    else
        return parameter.shared() ? V(parameter.data()[0]) : V::load(parameter.data() + row);
}
template <Number V, std::floating_point T>
[[gnu::always_inline]] inline V load(const Column<T>& column, std::size_t row) {
    if constexpr (std::is_same_v<V, T>)
        return column[row];
    else
        return V::load(column.data() + row);
}
template <Number V, std::floating_point T>
[[gnu::always_inline]] inline void store(const V& value, Column<T>& column, std::size_t row) {
    if constexpr (std::is_same_v<V, T>)
        column[row] = value;
    else
        value.store(column.data() + row);
}

template <Number V, class T, std::size_t Axes>
[[gnu::always_inline]] inline Vec<V, int{Axes}> load(const std::array<Column<T>, Axes>& columns,
                                                     std::size_t row) {
    return {generate<Axes>([&](auto i) { return load<V>(columns[i], row); })};
}
template <Number V, class T, std::size_t Axes, int A>
[[gnu::always_inline]] inline void store(const Vec<V, A>& value,
                                         std::array<Column<T>, Axes>& columns, std::size_t row) {
    for_each_index<Axes>([&](auto i) { store(value.axis[i], columns[i], row); });
}
template <Number V, class T, int Axes>
[[gnu::always_inline]] inline State<V, Axes> load(const MotionColumns<T, Axes>& motion,
                                                  std::size_t row) {
    return {load<V>(motion.x, row), load<V>(motion.v, row)};
}
template <Number V, class T, int Axes>
[[gnu::always_inline]] inline void store(const State<V, Axes>& state,
                                         MotionColumns<T, Axes>& motion, std::size_t row) {
    store(state.x, motion.x, row);
    store(state.v, motion.v, row);
}

/// All that a method asks of the forces on one row, or on a batch of rows from `row` on.
template <Number V, int Axes>
class RowPhysics {
public:
    using T = Scalar<V>;

    RowPhysics(const Columns<T, Axes>& columns, std::size_t row, const Plan<T>& plan)
        : forces_(read_forces<V>(
              columns, [&](const Parameter<T>& parameter) { return load<V>(parameter, row); })),
          flows_(columns.flows),
          row_(row) {
        const auto* const splitting = std::get_if<SplittingPlan<T>>(&plan);
        damping_ = splitting ? splitting->damping : Damping::in_kick;
    }

    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) {
        ++evaluations_;
        return forces_.accelerate(state, t);
    }

    /// The acceleration of a kick. One that depends on position alone holds until the next drift.
    [[gnu::always_inline]] Vec<V, Axes> kick(const State<V, Axes>& state, double t) {
        if (damping_ == Damping::in_kick) return accelerate(state, t);
        if (!field_valid_) {
            ++evaluations_;
            field_ = forces_.field(state.x, t);
            field_valid_ = true;
        }
        return field_;
    }

    [[gnu::always_inline]] void drift(State<V, Axes>& state, std::size_t flow, T tau) {
        field_valid_ = false;
        if (damping_ == Damping::in_kick || !flows_.damped) {
            add_scaled(state.x, state.v, tau);
            return;
        }
        const FlowColumns<T>& of = flows_.of[flow];
        state.x = state.x + state.v * load<V>(of.reach, row_);
        state.v = state.v * load<V>(of.decay, row_);
    }

    /// A half-step of drag, before the stages and, in the other order, after them.
    [[gnu::always_inline]] void slow_before(State<V, Axes>& state, const SplittingPlan<T>& plan) {
        if (damping_ == Damping::in_kick) return;
        slow_quadratic(state, plan);
        slow_coil(state);
    }
    [[gnu::always_inline]] void slow_after(State<V, Axes>& state, const SplittingPlan<T>& plan) {
        if (damping_ == Damping::in_kick) return;
        slow_coil(state);
        slow_quadratic(state, plan);
    }

    /// The change of velocity that takes `residual` away from w − v − τ·a(x + τ·w, w).
    [[nodiscard]] Vec<V, Axes> solve(const State<V, Axes>& at, T tau,
                                     const Vec<V, Axes>& residual) {
        return oiler::solve(velocity_matrix(forces_.jacobian(at), V(1), tau), residual);
    }

    /// The exact motion under linear forces: see Response.
    [[gnu::always_inline]] void respond(State<V, Axes>& state, double t) {
        ++evaluations_;
        const Vec<V, Axes> a = forces_.field(state.x, t);
        const FlowColumns<T>& of = flows_.of[0];
        const V reach = load<V>(of.reach, row_);
        state.x = state.x + state.v * reach + a * load<V>(of.sway, row_);
        state.v = state.v * load<V>(of.decay, row_) + a * reach;
    }

    [[nodiscard]] const Forces<V, Axes>& forces() const { return forces_; }
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

private:
    [[gnu::always_inline]] void slow_quadratic(State<V, Axes>& state,
                                               const SplittingPlan<T>& plan) {
        if (const auto* drag = forces_.template find<QuadraticDragForce>())
            drag->slow(state, V(plan.half_step));
    }
    [[gnu::always_inline]] void slow_coil(State<V, Axes>& state) {
        if (const auto* coil = forces_.template find<CoilSpringForce>())
            coil->slow(state, load<V>(flows_.coil_loss, row_));
    }

    Forces<V, Axes> forces_;
    const Flows<T>& flows_;
    std::size_t row_;
    Damping damping_;
    Vec<V, Axes> field_;
    bool field_valid_ = false;
    std::int64_t evaluations_ = 0;
};

/// m·1 − τ·(τ·∂a/∂x + ∂a/∂v), of accelerations, or of forces for a mass m.
template <Number V, int Axes>
[[nodiscard]] Matrix<V, Axes> velocity_matrix(const Jacobian<V, Axes>& jacobian, const V& mass,
                                              const V& tau) {
    return Matrix<V, Axes>::scalar(mass) - (jacobian.dx * tau + jacobian.dv) * tau;
}

}  // namespace oiler
