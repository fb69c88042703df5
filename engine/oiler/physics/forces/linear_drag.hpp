// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "oiler/physics/forces/jacobian.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// Drag of slow motion through a thick fluid: force −b·v.
template <Number V, int Axes>
struct LinearDragForce {
    V coefficient{};  ///< b, N·s/m

    static constexpr std::string_view name = "linear_drag";
    static constexpr bool everywhere = false;
    static constexpr bool linear = true;
    static constexpr auto fields() { return std::tuple(&LinearDragForce::coefficient); }
    constexpr LinearDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        return state.v * -coefficient;
    }
    constexpr const V& damping_rate() const { return coefficient; }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const {
        return {{}, Matrix<V, Axes>::scalar(-coefficient)};
    }
    constexpr V potential(const State<V, Axes>&) const { return V(0); }
};

}  // namespace oiler
