// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/contacts/support.hpp"
#include "oiler/sim/row_physics.hpp"

namespace oiler {

/// The physics of one row that slides on planes: what pushes into them is taken away, and friction
/// brakes.
template <std::floating_point T, int Axes, class Physics>
class SlidingPhysics {
public:
    using Vector = Vec<T, Axes>;
    using Motion = State<T, Axes>;
    static constexpr bool is_linear = false;

    SlidingPhysics(Physics& physics, const Support<T, Axes>& support,
                   const Friction<T, Axes>& friction)
        : physics_(physics), support_(support), friction_(friction) {}

    [[nodiscard]] Vector accelerate(const Motion& state, double t) {
        return along(physics_.accelerate(state, t), state.v);
    }
    [[nodiscard]] Vector kick(const Motion& state, double t) {
        return along(physics_.kick(state, t), state.v);
    }
    void drift(Motion& state, std::size_t flow, T tau) { physics_.drift(state, flow, tau); }
    void damp_before(Motion& state) {
        physics_.damp_before(state);
        state.v = support_.without_push(state.v);
    }
    void damp_after(Motion& state) {
        physics_.damp_after(state);
        state.v = support_.without_push(state.v);
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
        physics_.respond_to(state, along(physics_.field(state.x, t), state.v));
    }

private:
    [[nodiscard]] Vector along(const Vector& a, const Vector& v) const {
        const T grip = support_.grip(a);
        const Vector free = support_.without_push(a);
        return grip == 0 ? free : free + friction_.against(v) * grip;
    }

    Physics& physics_;
    const Support<T, Axes>& support_;
    const Friction<T, Axes>& friction_;
};

}  // namespace oiler
