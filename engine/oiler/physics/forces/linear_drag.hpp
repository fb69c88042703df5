// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/forces/linear_force.hpp"

namespace oiler {

/// Drag of slow motion through a thick fluid: force −b·v.
template <Number V, int Axes>
struct LinearDragForce {
    V coefficient{};  ///< b, N·s/m

    static constexpr std::string_view name = "linear_drag";
    static constexpr std::string_view plural = "linear drag";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"linear_drag", &LinearDragForce::coefficient});
    }
    static constexpr auto linear_fields() {
        return LinearFields{Absent{}, Absent{}, Absent{}, &LinearDragForce::coefficient};
    }
    constexpr LinearDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }
};

}  // namespace oiler
