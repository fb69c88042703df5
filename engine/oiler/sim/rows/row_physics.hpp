// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "oiler/math/batch.hpp"
#include "oiler/physics/advance.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// Damped bodies are put to sleep after ticks that are multiples of this.
inline constexpr std::int64_t sleep_interval = 64;

template <std::floating_point T>
[[nodiscard]] constexpr T power_of_two(int exponent) {
    T power = 1;
    for (int i = exponent; i < 0; ++i) power /= 2;
    return power;
}

/// The threshold of sleep for velocity (m/s), acceleration (m/s²) and distance from the centre of
/// the springs (m): 7.9·10⁻³¹ in float and 1.5·10⁻³⁰⁰ in double; if speeds are squared, 8.7·10⁻¹⁹
/// and 4.8·10⁻¹⁵³. It is far above the subnormal numbers, which cost a hundred times as much as
/// normal numbers.
template <std::floating_point T>
[[nodiscard]] constexpr T sleep_limit(bool squared) {
    constexpr int smallest = std::numeric_limits<T>::min_exponent - 1;
    constexpr T of_squares = power_of_two<T>(smallest / 2 + 3);
    constexpr T of_speeds = power_of_two<T>(smallest + 26);
    return squared ? of_squares : of_speeds;
}

/// The first number of a state that is not finite; `axis` is that of its first coordinate.
template <std::floating_point T, int Axes>
[[nodiscard]] std::optional<Divergence> find_divergence(const State<T, Axes>& state,
                                                        std::size_t row, std::int64_t tick,
                                                        int axis) {
    using Of = Divergence::Of;
    for (const Of of : {Of::position, Of::velocity})
        for (int i = 0; i < Axes; ++i)
            if (!std::isfinite((of == Of::velocity ? state.v : state.x)[i]))
                return Divergence{tick, row, axis + i, of};
    return std::nullopt;
}

/// m·1 − τ·(τ·∂a/∂x + ∂a/∂v), for accelerations (m = 1) or forces.
template <Number V, int Axes>
[[nodiscard]] Matrix<V, Axes> velocity_matrix(const Jacobian<V, Axes>& jacobian, const V& mass,
                                              const V& tau) {
    return Matrix<V, Axes>::scalar(mass) - (jacobian.dx * tau + jacobian.dv) * tau;
}

/// Puts bodies to sleep, axis by axis, if `rate` is positive and velocity and acceleration `a` are
/// below `limit`: the velocity becomes 0, and a body close to the centre of its springs moves onto
/// it.
template <Number V, int Axes, class RowForces>
void put_to_sleep_below(Scalar<V> limit, const V& rate, const Vec<V, Axes>& a,
                        const RowForces& forces, State<V, Axes>& state) {
    const State<V, Axes> was = state;
    for_each_index<Axes>([&](auto i) __attribute__((always_inline)) {
        const V& v = was.v.axis[i];
        if (forces.parts.spring) {
            const V& centre = forces.linear.centre.axis[i];
            const V& x = was.x.axis[i];
            state.x.axis[i] =
                replace_where_sleeping(x, centre, rate, limit, v, a.axis[i], V(x - centre));
        }
        state.v.axis[i] = replace_where_sleeping(v, V(Scalar<V>(0)), rate, limit, v, a.axis[i]);
    });
}

/// Puts bodies to sleep whose linear damping has a positive `rate`, see sleep_limit. Without sleep,
/// their numbers would become subnormal. `squares` is positive if formulas square speeds or
/// distances.
template <Number V, int Axes, class RowForces>
void put_row_to_sleep(const RowForces& forces, const V& rate, const V& squares,
                      const Vec<V, Axes>& a, State<V, Axes>& state) {
    using T = Scalar<V>;
    put_to_sleep_below(sleep_limit<T>(false), rate, a, forces, state);
    put_to_sleep_below(sleep_limit<T>(true), V(rate * squares), a, forces, state);
}

/// Puts a row without links to sleep. Returns whether any velocity was below the limit. Never
/// inlined, because few steps need it.
template <Number V, int Axes, class RowForces>
[[gnu::noinline]] bool put_slow_row_to_sleep(const RowForces& forces, State<V, Axes>& state,
                                             double t) {
    bool slow = false;
    for_each_index<Axes>([&](auto i) __attribute__((always_inline)) {
        slow = slow || any_nonzero_below(state.v.axis[i], sleep_limit<Scalar<V>>(true));
    });
    const V& rate = forces.linear.damping;
    if (!slow || !any_positive(rate)) return false;
    put_row_to_sleep(forces, rate, forces.squares_speeds(), forces.accelerate(state, t), state);
    return true;
}

/// The kinds of force on the rows of the block of row_padding rows from `row` on.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline Kinds kinds_of_block(const Columns<T, Axes>& columns,
                                                                 std::size_t row) {
    if (columns.kinds.shared()) return columns.kinds[row];
    Kinds all = 0;
    for (std::size_t i = row; i < std::min(row + row_padding, columns.size); ++i)
        all = static_cast<Kinds>(all | columns.kinds[i]);
    return all;
}

/// The part of a rule's steps that applies forces that depend on velocity.
template <class Rule>
[[gnu::always_inline]] constexpr Damping damping_of_rule(const Rule& rule) {
    if constexpr (SplitsSteps<Rule>)
        return rule.damping;
    else
        return Damping::in_kick;
}

/// A drift of row `row`, or of a batch, with linear damping.
template <Number V, int Axes>
[[gnu::always_inline]] inline void drift(State<V, Axes>& state, const FlowView<Scalar<V>>& flow,
                                         std::size_t row) {
    state.x = state.x + state.v * flow.reach.template at<V>(row);
    state.v = state.v * flow.decay.template at<V>(row);
}

/// The forces on a row that are not linear, or on a batch of rows from `row` on. Kinds that no row
/// of the block has are left out.
template <Number V, int Axes>
class OtherForces {
public:
    using T = Scalar<V>;

    OtherForces(const RowViews<T, Axes>& views, std::size_t row, Kinds kinds)
        : views_(views), row_(row), kinds_(kinds) {}

    template <class Force>
    [[gnu::always_inline]] std::size_t count() const {
        return kinds_ & kind_bit<Force, V, Axes> ? views<Force>().size() : 0;
    }
    template <class Force>
    [[gnu::always_inline]] Force get(std::size_t index) const {
        const auto& numbers = views<Force>()[index].numbers;
        Force force;
        std::size_t next = 0;
        for_each_number(
            force, [&](V & number) __attribute__((always_inline)) {
                number = numbers[next++].template at<V>(row_);
            });
        return force;
    }
    template <class Force>
    [[gnu::always_inline]] V damping_number(std::size_t index) const {
        return views<Force>()[index].damping_number.template at<V>(row_);
    }

private:
    template <class Force>
    [[gnu::always_inline]] const auto& views() const {
        return views_.others[kind_index<Force, V, Axes>];
    }

    const RowViews<T, Axes>& views_;
    std::size_t row_;
    Kinds kinds_;
};

/// All forces on a row or a batch of rows.
template <Number V, int Axes>
using RowForces = Forces<V, Axes, LinearParts, OtherForces<V, Axes>>;

/// The physics that a method steps: one row or a batch of rows from `row` on, along one axis or
/// all.
template <Number V, int Axes, class ForcesOfRow>
class RowPhysics {
public:
    using T = Scalar<V>;
    /// Whether all forces are linear.
    static constexpr bool is_linear = !requires(ForcesOfRow forces) { forces.others; };

    /// `load_forces` returns the forces of the row; they are large and constructed in place.
    template <class LoadForces>
    [[gnu::always_inline]] RowPhysics(LoadForces load_forces, const FlowView<T>* flows,
                                      std::size_t row, Damping damping)
        : forces_(load_forces()), flows_(flows), row_(row), damping_(damping) {}

    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) {
        ++evaluations_;
        return forces_.accelerate(state, t);
    }

    /// The acceleration of a kick. If it depends on position alone, it is valid until the next
    /// drift.
    [[gnu::always_inline]] Vec<V, Axes> kick(const State<V, Axes>& state, double t) {
        if (damping_ == Damping::in_kick) return accelerate(state, t);
        if (!field_valid_) {
            field_ = field(state.x, t);
            field_valid_ = true;
        }
        return field_;
    }

    [[gnu::always_inline]] void drift(State<V, Axes>& state, std::size_t flow, T tau) {
        field_valid_ = false;
        if (damping_ == Damping::in_kick || !forces_.parts.damping) {
            add_scaled(state.x, state.v, tau);
            return;
        }
        oiler::drift(state, flows_[flow], row_);
    }

    /// Half-steps of the damping that is not linear, before the stages and, in reverse order, after
    /// them.
    [[gnu::always_inline]] void damp_before(State<V, Axes>& state) requires(!is_linear) {
        // The times of the last kick of a step and of the first of the next may differ in a bit.
        if (forces_.depend_on_time()) field_valid_ = false;
        if (damping_ == Damping::in_drift) forces_.damp(state);
    }
    [[gnu::always_inline]] void damp_after(State<V, Axes>& state) requires(!is_linear) {
        if (damping_ == Damping::in_drift) forces_.damp_in_reverse(state);
    }

    /// Puts the row to sleep, see put_row_to_sleep.
    [[gnu::always_inline]] void put_to_sleep(State<V, Axes>& state, double t) {
        if (!forces_.parts.damping) return;
        State<V, Axes> asleep = state;
        const ForcesOfRow forces = forces_;
        if (!put_slow_row_to_sleep(forces, asleep, t)) return;
        state = asleep;
        field_valid_ = false;
    }

    /// Newton's change of w for the residual of w − v − τ·a(x + τ·w, w).
    [[nodiscard]] [[gnu::always_inline]] Vec<V, Axes> solve(const State<V, Axes>& at, T tau,
                                                            const Vec<V, Axes>& residual) {
        if constexpr (is_linear) {
            const LinearForce<V, Axes>& force = forces_.linear;
            V slope = V(T(1));
            if (forces_.parts.damping) slope = slope + force.damping * V(tau);
            if (forces_.parts.spring) slope = slope + force.stiffness * V(tau * tau);
            return {V(residual.axis[0] / slope)};
        } else {
            return oiler::solve(velocity_matrix(forces_.jacobian(at), V(1), tau), residual);
        }
    }

    /// The part of the acceleration that depends on position and time alone, m/s².
    [[gnu::always_inline]] Vec<V, Axes> field(const Vec<V, Axes>& x, double t) {
        ++evaluations_;
        return forces_.field(x, t);
    }

    /// The exact motion under linear forces, see Response.
    [[gnu::always_inline]] void respond(State<V, Axes>& state, double t) {
        respond_to(state, field(state.x, t));
    }
    /// Like respond, with another acceleration `a` at the start, m/s².
    [[gnu::always_inline]] void respond_to(State<V, Axes>& state, const Vec<V, Axes>& a) const {
        const V reach = flows_->reach.template at<V>(row_);
        state.x = state.x + state.v * reach + a * flows_->sway.template at<V>(row_);
        state.v = state.v * flows_->decay.template at<V>(row_) + a * reach;
    }

    [[nodiscard]] const ForcesOfRow& forces() const { return forces_; }
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

private:
    ForcesOfRow forces_;
    const FlowView<T>* flows_;
    std::size_t row_;
    Damping damping_;
    Vec<V, Axes> field_;
    bool field_valid_ = false;
    std::int64_t evaluations_ = 0;
};

template <Number V, class Parts>
[[nodiscard]] [[gnu::always_inline]] inline auto physics_of(const AxisRows<Scalar<V>>& rows,
                                                            std::size_t row, const Parts& parts,
                                                            Damping damping) {
    return RowPhysics<V, 1, AxisForces<V, Parts>>(
        [&]() __attribute__((always_inline)) {
            return AxisForces<V, Parts>{rows.forces.template load_at<V>(row, parts), parts};
        },
        rows.flows, row, damping);
}

template <Number V, std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline auto physics_of(const RowViews<T, Axes>& views,
                                                            std::size_t row, Kinds kinds,
                                                            Damping damping) {
    const LinearParts parts = views.parts(kinds);
    return RowPhysics<V, Axes, RowForces<V, Axes>>(
        [&]() __attribute__((always_inline)) {
            return RowForces<V, Axes>{views.template load_at<V>(row, parts), parts,
                                      OtherForces<V, Axes>(views, row, kinds)};
        },
        views.flows.data(), row, damping);
}

/// Whether bodies are put to sleep after tick `tick`. It depends on the tick alone, so that results
/// do not depend on the number of steps per call.
[[nodiscard]] constexpr bool is_sleep_tick(std::int64_t tick) { return tick % sleep_interval == 0; }

/// All steps of a row or a batch. Returns false if an implicit method found no solution.
template <class Rule, class V, int Axes, class Physics>
[[gnu::always_inline]] inline bool take_steps(const Rule& rule, State<V, Axes>& state,
                                              Physics& physics, const Steps& steps) {
    const std::int64_t end = steps.first + steps.count;
    for (std::int64_t tick = steps.first; tick < end;) {
        const std::int64_t stop = std::min(end, (tick / sleep_interval + 1) * sleep_interval);
        for (; tick < stop; ++tick)
            if (!advance(rule, state, physics, steps.rate.time(tick))) return false;
        if (is_sleep_tick(tick)) physics.put_to_sleep(state, steps.rate.time(tick));
    }
    return true;
}

}  // namespace oiler
