// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

#include "oiler/math/batch.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/sim/columns.hpp"

namespace oiler {

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

/// Damped bodies are put to sleep after ticks that are multiples of this.
inline constexpr std::int64_t sleep_interval = 64;

/// The threshold of sleep for velocity (m/s), acceleration (m/s²) and distance from the anchor (m):
/// 7.9·10⁻³¹ in float and 1.5·10⁻³⁰⁰ in double; if speeds are squared, 8.7·10⁻¹⁹ and 4.8·10⁻¹⁵³. It
/// is far above the subnormal numbers, which cost a hundred times as much as normal numbers.
template <std::floating_point T>
[[nodiscard]] constexpr T sleep_limit(bool squared) {
    constexpr int smallest = std::numeric_limits<T>::min_exponent - 1;
    T limit = 1;
    for (int i = squared ? smallest / 2 + 3 : smallest + 26; i < 0; ++i) limit /= 2;
    return limit;
}

/// Puts bodies with linear damping to sleep, axis by axis, if velocity and acceleration are below
/// sleep_limit: the velocity becomes 0, and a body close to its anchor moves onto it. Without
/// sleep, their numbers would become subnormal. Returns whether any velocity was below the limit.
/// Never inlined, because all methods share it and few steps need it.
template <Number V, class T, int Axes>
[[gnu::noinline]] bool put_row_to_sleep(const Columns<T, Axes>& columns, std::size_t row,
                                        State<V, Axes>& state, double t) {
    const auto forces = forces_of<V>(columns, row);
    const std::size_t springs = forces.template count<SpringForce>();
    if (springs + forces.template count<LinearDragForce>() == 0) return false;
    const T limit = sleep_limit<T>(forces.template count<QuadraticDragForce>() > 0);
    bool slow = false;
    for_each_index<Axes>([&](auto i) __attribute__((always_inline)) {
        slow = slow || any_nonzero_below(state.v.axis[i], limit);
    });
    if (!slow) return false;
    const V rate = forces.damping_rate();
    if (!any_positive(rate)) return false;
    const Vec<V, Axes> a = forces.accelerate(state, t);
    const State<V, Axes> was = state;
    for_each_index<Axes>([&](auto i) __attribute__((always_inline)) {
        const V& v = was.v.axis[i];
        if (springs > 0) {
            const V anchor = forces.template get<SpringForce>(0).anchor.axis[i];
            const V& x = was.x.axis[i];
            state.x.axis[i] =
                replace_where_sleeping(x, anchor, rate, limit, v, a.axis[i], V(x - anchor));
        }
        state.v.axis[i] = replace_where_sleeping(v, V(T(0)), rate, limit, v, a.axis[i]);
    });
    return true;
}

/// Where a plan applies forces that depend on velocity.
template <class Plan>
[[gnu::always_inline]] constexpr Damping damping_of(const Plan& plan) {
    if constexpr (SplitsSteps<Plan>)
        return plan.damping;
    else
        return Damping::in_kick;
}

/// The physics that a method steps: one row, or a batch of rows from `row` on.
template <Number V, int Axes, class Source = ForcesOfRow<V, Scalar<V>, Axes>>
class RowPhysics {
public:
    using T = Scalar<V>;

    [[gnu::always_inline]] RowPhysics(const Columns<T, Axes>& columns, std::size_t row,
                                      Damping damping)
        : columns_(columns),
          forces_(Source(columns, row)),
          flows_(columns.flows),
          row_(row),
          damping_(damping) {}

    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) {
        ++evaluations_;
        return forces_.accelerate(state, t);
    }

    /// The acceleration of a kick. If it depends on position alone, it is valid until the next
    /// drift.
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

    /// Half-steps of damping before the stages and, in reverse order, after them.
    template <class Plan>
    [[gnu::always_inline]] void damp_before(State<V, Axes>& state, const Plan& plan) {
        if (damping_ == Damping::in_kick) return;
        damp_quadratic(state, plan.half_step);
        for (std::size_t index = 0; index < coils(); ++index) damp_coil(state, index);
    }
    template <class Plan>
    [[gnu::always_inline]] void damp_after(State<V, Axes>& state, const Plan& plan) {
        if (damping_ == Damping::in_kick) return;
        for (std::size_t index = coils(); index-- > 0;) damp_coil(state, index);
        damp_quadratic(state, plan.half_step);
    }

    /// Puts the row to sleep, see put_row_to_sleep.
    [[gnu::always_inline]] void put_to_sleep(State<V, Axes>& state, double t) {
        State<V, Axes> asleep = state;
        if (!put_row_to_sleep(columns_, row_, asleep, t)) return;
        state = asleep;
        field_valid_ = false;
    }

    /// Newton's change of w for the residual of w − v − τ·a(x + τ·w, w).
    [[nodiscard]] Vec<V, Axes> solve(const State<V, Axes>& at, T tau,
                                     const Vec<V, Axes>& residual) {
        return oiler::solve(velocity_matrix(forces_.jacobian(at), V(1), tau), residual);
    }

    /// The exact motion under linear forces, see Response.
    [[gnu::always_inline]] void respond(State<V, Axes>& state, double t) {
        ++evaluations_;
        const Vec<V, Axes> a = forces_.field(state.x, t);
        const FlowColumns<T>& of = flows_.of[0];
        const V reach = load<V>(of.reach, row_);
        state.x = state.x + state.v * reach + a * load<V>(of.sway, row_);
        state.v = state.v * load<V>(of.decay, row_) + a * reach;
    }

    [[nodiscard]] const Forces<V, Axes, Source>& forces() const { return forces_; }
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

private:
    [[gnu::always_inline]] std::size_t coils() const {
        return forces_.template count<CoilSpringForce>();
    }
    [[gnu::always_inline]] void damp_quadratic(State<V, Axes>& state, T half_step) {
        for (std::size_t index = 0; index < forces_.template count<QuadraticDragForce>(); ++index)
            forces_.template get<QuadraticDragForce>(index).damp(state, V(half_step));
    }
    [[gnu::always_inline]] void damp_coil(State<V, Axes>& state, std::size_t index) {
        forces_.template get<CoilSpringForce>(index).damp(state,
                                                          load<V>(flows_.coil_loss[index], row_));
    }

    const Columns<T, Axes>& columns_;
    Forces<V, Axes, Source> forces_;
    const Flows<T>& flows_;
    std::size_t row_;
    Damping damping_;
    Vec<V, Axes> field_{};
    bool field_valid_ = false;
    std::int64_t evaluations_ = 0;
};

/// m·1 − τ·(τ·∂a/∂x + ∂a/∂v), for accelerations (m = 1) or forces.
template <Number V, int Axes>
[[nodiscard]] Matrix<V, Axes> velocity_matrix(const Jacobian<V, Axes>& jacobian, const V& mass,
                                              const V& tau) {
    return Matrix<V, Axes>::scalar(mass) - (jacobian.dx * tau + jacobian.dv) * tau;
}

}  // namespace oiler
