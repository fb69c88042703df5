// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/forces/force.hpp"

namespace oiler {

/// Drag of fast motion through air: force −c·|v|·v. If any body has it, |v|² of all bodies must not
/// overflow: speeds must stay below 1.8·10¹⁹ m/s in float and 1.3·10¹⁵⁴ m/s in double.
template <Number V, int Axes>
struct QuadraticDragForce {
    V coefficient{};  ///< c, N·s²/m²

    static constexpr std::string_view name = "quadratic_drag";
    static constexpr std::string_view plural = "quadratic drag";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"quadratic_drag", &QuadraticDragForce::coefficient});
    }
    constexpr QuadraticDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        using std::sqrt;
        return state.v * (-coefficient * sqrt(squared_length(state.v)));
    }
    constexpr V prepare_damping(const V& tau) const { return tau; }
    /// The exact flow of v' = −c·|v|·v for `tau` s: v/(1 + c·|v|·τ).
    [[gnu::always_inline]] constexpr void damp(State<V, Axes>& state, const V& tau) const {
        using std::sqrt;
        const V speed = sqrt(squared_length(state.v));
        // NaN where the speed is not finite, instead of 0.
        const V zero_or_nan = speed - speed;
        state.v = state.v * (V(1) / (V(1) + coefficient * speed * tau) + zero_or_nan);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        using std::sqrt;
        const V speed = sqrt(squared_length(state.v));
        const auto direction = state.v * quotient_or_zero(V(1), speed);
        return {{},
                Matrix<V, Axes>::scalar(-coefficient * speed) +
                    Matrix<V, Axes>::outer(direction, state.v * -coefficient)};
    }
    constexpr AirDrag<V, Axes> air_drag() const { return {coefficient, {}}; }
    constexpr V potential(const State<V, Axes>&) const { return V(0); }
};

}  // namespace oiler
