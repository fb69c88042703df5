// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/contacts/support.hpp"
#include "oiler/sim/row_physics.hpp"

namespace oiler {

/// How friction acts in a step.
template <std::floating_point T>
struct Braking {
    T half_step;  ///< s; 0 if friction that turns is a force, as in stages
    double t;     ///< s, at the start of the step
};

/// The physics of one row that slides on planes: what pushes into them is taken away, and friction
/// brakes. But for Runge–Kutta methods, friction that turns with the velocity has a flow of its own
/// in the first and the last half of the step: as a force in kicks it would have order 1, and near
/// a stop, where it turns at any rate, an implicit method would find no solution.
template <std::floating_point T, int Axes, class Physics>
class SlidingPhysics {
public:
    using Vector = Vec<T, Axes>;
    using Motion = State<T, Axes>;
    static constexpr bool is_linear = false;

    SlidingPhysics(Physics& physics, const Support<T, Axes>& support,
                   const Friction<T, Axes>& friction, const Braking<T>& braking)
        : physics_(physics),
          support_(support),
          friction_(friction),
          braking_(braking),
          by_flow_(friction.turns && braking.half_step > 0) {}

    [[nodiscard]] Vector accelerate(const Motion& state, double t) {
        return along(physics_.accelerate(state, t), state.v);
    }
    [[nodiscard]] Vector kick(const Motion& state, double t) {
        return along(physics_.kick(state, t), state.v);
    }
    void drift(Motion& state, std::size_t flow, T tau) { physics_.drift(state, flow, tau); }
    void brake_before(Motion& state) { brake(state, braking_.t); }
    void brake_after(Motion& state) {
        brake(state, braking_.t + 2 * static_cast<double>(braking_.half_step));
    }
    void damp_before(Motion& state) {
        brake_before(state);
        physics_.damp_before(state);
        state.v = support_.without_push(state.v);
    }
    void damp_after(Motion& state) {
        physics_.damp_after(state);
        state.v = support_.without_push(state.v);
        brake_after(state);
    }
    [[nodiscard]] Vector solve(const Motion& at, T tau, const Vector& residual) {
        const Jacobian<T, Axes> jacobian = physics_.forces().jacobian(at);
        const Matrix<T, Axes> rates = (jacobian.dx * tau + jacobian.dv) * tau;
        auto matrix = Matrix<T, Axes>::scalar(T(1));
        for (std::size_t j = 0; j < Axes; ++j) {
            Vector column;
            for (std::size_t i = 0; i < Axes; ++i) column.axis[i] = rates.row[i].axis[j];
            column = support_.without_push(column);
            for (std::size_t i = 0; i < Axes; ++i) matrix.row[i].axis[j] -= column.axis[i];
        }
        return oiler::solve(matrix, residual);
    }
    void respond(Motion& state, double t) {
        brake_before(state);
        physics_.respond_to(state, along(physics_.field(state.x, t), state.v));
        brake_after(state);
    }

private:
    /// The exact flow of friction over half a step.
    void brake(Motion& state, double t) {
        if (!by_flow_) return;
        const T lost = support_.grip(physics_.accelerate(state, t)) * braking_.half_step;
        const T speed = length(state.v);
        state.v = lost < speed ? state.v * (1 - lost / speed) : Vector{};
    }
    [[nodiscard]] Vector along(const Vector& a, const Vector& v) const {
        const T grip = support_.grip(a);
        const Vector free = support_.without_push(a);
        return grip == 0 || by_flow_ ? free : free + friction_.against(v) * grip;
    }

    Physics& physics_;
    const Support<T, Axes>& support_;
    const Friction<T, Axes>& friction_;
    Braking<T> braking_;
    bool by_flow_;
};

}  // namespace oiler
