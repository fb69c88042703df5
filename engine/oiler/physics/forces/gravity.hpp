// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/forces/linear_force.hpp"

namespace oiler {

/// One acceleration for all bodies. The potential is −g·x, zero at the origin.
template <Number V, int Axes>
struct GravityForce {
    Vec<V, Axes> acceleration{};  ///< m/s²

    static constexpr std::string_view name = "gravity";
    static constexpr std::string_view plural = "gravity";
    static constexpr bool everywhere = true;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"acceleration", &GravityForce::acceleration});
    }
    static constexpr auto linear_fields() {
        return LinearFields{&GravityForce::acceleration, Absent{}, Absent{}, Absent{}};
    }
    constexpr GravityForce per_unit_mass(V) const { return *this; }
};

}  // namespace oiler
