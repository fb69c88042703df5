// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "oiler/physics/forces/jacobian.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// One acceleration for all bodies. The potential is −g·x, zero at the origin.
template <Number V, int Axes>
struct GravityForce {
    Vec<V, Axes> acceleration{};  ///< m/s²

    static constexpr std::string_view name = "gravity";
    static constexpr bool everywhere = true;
    static constexpr bool linear = true;
    static constexpr auto fields() { return std::tuple(&GravityForce::acceleration); }
    constexpr GravityForce per_unit_mass(V) const { return *this; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>&, double) const {
        return acceleration;
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>&, double) const {
        return acceleration;
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const { return {}; }
    constexpr V potential(const State<V, Axes>& state) const { return -dot(acceleration, state.x); }
};

}  // namespace oiler
