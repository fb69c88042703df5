// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/forces/quadratic_drag.hpp"

namespace oiler {

/// Drag through moving air: force −c·|u|·u, u = v − w, for wind of velocity w.
template <Number V, int Axes>
struct WindForce {
    Vec<V, Axes> velocity{};  ///< w, m/s
    V coefficient{};          ///< c, N·s²/m²

    static constexpr std::string_view name = "wind";
    static constexpr std::string_view plural = "wind";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"velocity", &WindForce::velocity},
                          KeyedField{"drag", &WindForce::coefficient});
    }
    constexpr WindForce per_unit_mass(V mass) const { return {velocity, coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double t) const {
        return drag().accelerate(in_air(state), t);
    }
    constexpr V prepare_damping(const V& tau) const { return tau; }
    /// The exact flow for `tau` s, see QuadraticDragForce::damp.
    [[gnu::always_inline]] constexpr void damp(State<V, Axes>& state, const V& tau) const {
        State<V, Axes> moving = in_air(state);
        drag().damp(moving, tau);
        state.v = moving.v + velocity;
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        return drag().jacobian(in_air(state));
    }
    constexpr AirDrag<V, Axes> air_drag() const { return {coefficient, velocity}; }
    constexpr V potential(const State<V, Axes>&) const { return V(0); }

private:
    [[gnu::always_inline]] constexpr QuadraticDragForce<V, Axes> drag() const {
        return {coefficient};
    }
    [[gnu::always_inline]] constexpr State<V, Axes> in_air(const State<V, Axes>& state) const {
        return {state.x, state.v - velocity};
    }
};

}  // namespace oiler
