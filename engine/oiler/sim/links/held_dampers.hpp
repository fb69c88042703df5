// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/links/link_force.hpp"

namespace oiler {

/// The state of a damper's row relative to its other end.
template <std::floating_point T, int Axes>
[[nodiscard]] State<T, Axes> relative(const MotionColumns<T, Axes>& motion,
                                      const HeldDamper<T, Axes>& damper) {
    State<T, Axes> state = load<T>(motion, damper.row);
    state.x -= damper.other ? load<T>(motion.x, *damper.other) : damper.point;
    if (damper.other) state.v -= load<T>(motion.v, *damper.other);
    return state;
}

template <std::floating_point T, int Axes>
[[nodiscard]] CoilSpringForce<T, Axes> force_of(const HeldDamper<T, Axes>& damper) {
    return {.damping = damper.damping};
}

/// The dampers of the ropes that are taut.
template <std::floating_point T, int Axes>
[[nodiscard]] std::vector<HeldDamper<T, Axes>> held_dampers(const Columns<T, Axes>& columns) {
    std::vector<HeldDamper<T, Axes>> held;
    const auto hold = [&](const auto& link, const HeldDamper<T, Axes>& damper) {
        if (link.pulls_only && link.damping > 0 &&
            !LinkForce<T, Axes>(link).is_slack(relative(columns.motion, damper).x))
            held.push_back(damper);
    };
    for (const LinkRow<T>& link : columns.links) hold(link, {link.a, link.b, link.damping, {}});
    for (const PointLinkRow<T, Axes>& link : columns.point_links)
        hold(link, {link.row, std::nullopt, link.damping, link.point});
    return held;
}

/// Adds the accelerations by the dampers of the rows of a range.
template <std::floating_point T, int Axes>
void push_held(const std::vector<HeldDamper<T, Axes>>& held, const MotionColumns<T, Axes>& motion,
               const Parameter<T>& inverse_mass, const RowRange& rows, VecColumns<T, Axes>& to) {
    for (const HeldDamper<T, Axes>& damper : held) {
        const Vec<T, Axes> force = force_of(damper).accelerate(relative(motion, damper), 0);
        const auto push = [&](std::uint32_t row, const Vec<T, Axes>& by) {
            if (rows.holds(row))
                store(Vec<T, Axes>(load<T>(to, row) + by * inverse_mass[row]), to, row);
        };
        push(damper.row, force);
        if (damper.other) push(*damper.other, -force);
    }
}

}  // namespace oiler
