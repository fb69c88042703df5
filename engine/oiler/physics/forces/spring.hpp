// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "oiler/physics/forces/jacobian.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// A spring and damper from the body to a fixed anchor: force −k·d − b·v, d = x − anchor.
template <Number V, int Axes>
struct SpringForce {
    Vec<V, Axes> anchor{};  ///< m
    V stiffness{};          ///< k, N/m
    V damping{};            ///< b, N·s/m

    static constexpr std::string_view name = "spring";
    static constexpr bool everywhere = false;
    static constexpr bool linear = true;
    static constexpr auto fields() {
        return std::tuple(&SpringForce::anchor, &SpringForce::stiffness, &SpringForce::damping);
    }
    constexpr SpringForce per_unit_mass(V mass) const {
        return {anchor, stiffness / mass, damping / mass};
    }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x, double) const {
        return (x - anchor) * -stiffness;
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double t) const {
        return field(state.x, t) - state.v * damping;
    }
    constexpr const V& damping_rate() const { return damping; }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const {
        return {Matrix<V, Axes>::scalar(-stiffness), Matrix<V, Axes>::scalar(-damping)};
    }
    constexpr V potential(const State<V, Axes>& state) const {
        return V(0.5) * stiffness * squared_length(state.x - anchor);
    }
};

}  // namespace oiler
