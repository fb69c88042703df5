// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/forces/force.hpp"
#include "oiler/physics/response.hpp"

namespace oiler {

/// A spring with a rest length from the body to a fixed anchor, damped along its line: force
/// −k·(d − L·d̂) − b·(v·d̂)·d̂, d = x − anchor, and 0 at d = 0. |d| must stay below 1.8·10¹⁹ m in
/// float.
template <Number V, int Axes>
struct CoilSpringForce {
    Vec<V, Axes> anchor{};  ///< m
    V stiffness{};          ///< k, N/m
    V damping{};            ///< b, N·s/m
    V rest_length{};        ///< L, m

    static constexpr std::string_view name = "coil_spring";
    static constexpr std::string_view plural = "coil springs";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"anchor", &CoilSpringForce::anchor},
                          KeyedField{"stiffness", &CoilSpringForce::stiffness},
                          KeyedField{"damping", &CoilSpringForce::damping},
                          KeyedField{"rest_length", &CoilSpringForce::rest_length});
    }
    constexpr CoilSpringForce per_unit_mass(V mass) const {
        return {anchor, stiffness / mass, damping / mass, rest_length};
    }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x, double) const {
        const Direction<V, Axes> d(x - anchor);
        return d.unit * (stiffness * (rest_length - d.length));
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        const Direction<V, Axes> d(state.x - anchor);
        return d.unit * (stiffness * (rest_length - d.length) - damping * dot(state.v, d.unit));
    }
    /// 1 − e^(−b·τ) for τ s.
    V prepare_damping(const V& tau) const {
        return damping * oscillator_response(V(0), damping, tau).reach;
    }
    /// The exact flow of the damper on a fixed position, for the `loss` of prepare_damping.
    [[gnu::always_inline]] constexpr void damp(State<V, Axes>& state, const V& loss) const {
        const Direction<V, Axes> d(state.x - anchor);
        state.v = state.v - d.unit * (dot(state.v, d.unit) * loss);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        using M = Matrix<V, Axes>;
        const Direction<V, Axes> d(state.x - anchor);
        const M along = M::outer(d.unit, d.unit);
        const M across = M::scalar(V(1)) - along;
        const V along_speed = dot(state.v, d.unit);
        const auto across_velocity = state.v - d.unit * along_speed;
        const M turning =
            (across * along_speed + M::outer(d.unit, across_velocity)) * d.inverse_length;
        const V tension = stiffness * (rest_length * d.inverse_length - V(1));
        return {across * tension - along * stiffness - turning * damping, along * -damping};
    }
    constexpr CoilSpringForce line_spring() const { return *this; }
    constexpr V potential(const State<V, Axes>& state) const {
        const V stretch = Direction<V, Axes>(state.x - anchor).length - rest_length;
        return V(0.5) * stiffness * stretch * stretch;
    }
};

}  // namespace oiler
