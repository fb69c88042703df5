// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/contacts/landing.hpp"
#include "oiler/sim/columns.hpp"

namespace oiler {

/// Lets linked rows land at the end of a step from tick `tick`, because their motions depend on
/// each other: a row below a plane is moved onto it, and bounces with the normal speed that it had
/// at the start of the step. This has order 1 with every method. `velocity_before` is that at the
/// start of the step. Returns whether any state changed.
template <std::floating_point T, int Axes>
bool land_linked_rows(Columns<T, Axes>& columns, const VecColumns<T, Axes>& velocity_before,
                      std::int64_t tick, T dt) {
    using Surface = PlaneOf<T, Axes>;
    auto& contacts = columns.contacts;
    bool any = false;
    for (std::size_t row = 0; row < columns.size; ++row) {
        std::size_t index = 0;
        bool below_any = false;
        const T radius = contacts.radius[row];
        for (std::size_t i = 0; i < contacts.planes.size(); ++i) {
            const Surface& plane = contacts.planes[i];
            State<T, Axes> state = load<T>(columns.motion, row);
            const T below = -gap(plane, state.x, radius);
            if (!(below > 0)) continue;
            any = true;
            below_any = true;
            state.x += plane.normal * below;
            const Vec<T, Axes> v = state.v;
            const T speed = -leaving_speed(plane, v);
            const T fallen = -leaving_speed(plane, load<T>(velocity_before, row));
            if (speed > 0) {
                const T kept = plane.restitution * std::max(fallen, T(0));
                // Whether all later flights would end within a step.
                const bool rests = 2 * kept <= (1 - plane.restitution) * (speed - fallen);
                state.v = pushed_off(plane, landed(plane, v, speed), rests ? T(0) : kept);
                if (fallen > hidden_speed(v))
                    contacts.impacts.push_back(
                        {tick, row, index++, {Meeting::bounce, i, dt, state.x, v, state.v}});
            }
            store(state, columns.motion, row);
        }
        if (!below_any || contacts.planes.size() == 1) continue;
        // A move onto one plane may go below another.
        State<T, Axes> state = load<T>(columns.motion, row);
        lift_onto<T, Axes>(
            contacts.planes, state.x,
            [&](const Surface& plane, const Vec<T, Axes>& x) { return gap(plane, x, radius); },
            [&](const Surface& plane) { return hidden_distance(plane, state, radius, dt); },
            [](const Surface&) {});
        store(state, columns.motion, row);
    }
    return any;
}

}  // namespace oiler
