// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/contacts/landing.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// The landing of a linked row at the end of a step of `dt` s from tick `tick`: a row below a plane
/// is moved onto it, and bounces with the normal speed that it had at the start of the step.
/// `before` is the state at the start of the step. Returns whether the state changed.
template <std::floating_point T, int Axes>
bool land_linked_row(Columns<T, Axes>& columns, const State<T, Axes>& before, std::size_t row,
                     std::int64_t tick, T dt) {
    using Surface = PlaneOf<T, Axes>;
    auto& contacts = columns.contacts;
    const std::span<const Surface> planes(contacts.planes);
    const T radius = contacts.radius[row];
    const auto gap_of = [&](const Surface& plane, const Vec<T, Axes>& x) {
        return gap(plane, x, radius);
    };
    State<T, Axes> state = load<T>(columns.motion, row);
    PlaneSet met = 0;
    std::size_t index = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const Surface& plane = planes[i];
        const T below = -gap_of(plane, state.x);
        if (!(below > 0)) continue;
        met |= PlaneSet{1} << i;
        state.x += plane.normal * below;
        const Vec<T, Axes> v = state.v;
        const T speed = -leaving_speed(plane, v);
        if (!(speed > 0)) continue;
        const T fallen = -leaving_speed(plane, before.v);
        const T kept = plane.restitution * std::max(fallen, T(0));
        // Whether all later flights would end within a step.
        const bool rests = 2 * kept <= (1 - plane.restitution) * (speed - fallen);
        state.v = pushed_off(plane, landed(plane, v, speed), rests ? T(0) : kept);
        if (fallen > hidden_speed(v))
            contacts.impacts.push_back(
                {tick, row, index++, {Meeting::bounce, i, dt, state.x, v, state.v}});
    }
    if (met == 0) return false;
    if (planes.size() > 1) {
        // A bounce or a move off one plane may go into another.
        state.v = Support<T, Axes>::against(state.v, planes, met).without_push(state.v);
        lift_onto(
            planes, state.x, gap_of,
            [&](const Surface& plane) { return hidden_distance(plane, state, radius, dt); },
            [](const Surface&) {});
    }
    // Friction holds a body at rest where it is.
    if (before.v == Vec<T, Axes>{} && state.v == Vec<T, Axes>{}) state.x = before.x;
    store(state, columns.motion, row);
    return true;
}

/// Lets linked rows land at the end of a step, because their motions depend on each other. This has
/// order 1 with every method. Returns whether any state changed.
template <std::floating_point T, int Axes>
bool land_linked_rows(Columns<T, Axes>& columns, const MotionColumns<T, Axes>& before,
                      std::int64_t tick, T dt) {
    bool any = false;
    for (std::size_t row = 0; row < columns.size; ++row)
        any |= land_linked_row(columns, load<T>(before, row), row, tick, dt);
    return any;
}

}  // namespace oiler
