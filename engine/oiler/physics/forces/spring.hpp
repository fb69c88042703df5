// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/forces/linear_force.hpp"

namespace oiler {

/// A spring and damper from the body to a fixed anchor: force −k·d − b·v, d = x − anchor.
template <Number V, int Axes>
struct SpringForce {
    Vec<V, Axes> anchor{};  ///< m
    V stiffness{};          ///< k, N/m
    V damping{};            ///< b, N·s/m

    static constexpr std::string_view name = "spring";
    static constexpr std::string_view plural = "springs";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"anchor", &SpringForce::anchor},
                          KeyedField{"stiffness", &SpringForce::stiffness},
                          KeyedField{"damping", &SpringForce::damping});
    }
    static constexpr auto linear_fields() {
        return LinearFields{Absent{}, &SpringForce::anchor, &SpringForce::stiffness,
                            &SpringForce::damping};
    }
    constexpr SpringForce per_unit_mass(V mass) const {
        return {anchor, stiffness / mass, damping / mass};
    }
};

}  // namespace oiler
