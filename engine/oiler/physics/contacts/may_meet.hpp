// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "oiler/physics/contacts/plane.hpp"

namespace oiler {

/// The distance from a plane that round-off hides in a step of `duration` s, m.
template <std::floating_point T, int Axes>
[[nodiscard]] T hidden_distance(const PlaneOf<T, Axes>& plane, const State<T, Axes>& state,
                                T radius, T duration) {
    return 8 * std::numeric_limits<T>::epsilon() *
           (largest(state.x) + largest(state.v) * duration + std::abs(plane.offset) + radius);
}
/// The speed towards a plane that round-off hides, m/s.
template <std::floating_point T, int Axes>
[[nodiscard]] T hidden_speed(const Vec<T, Axes>& v) {
    return 8 * std::numeric_limits<T>::epsilon() * largest(v);
}

/// Whether a body that is above a plane at the start and at the end of `duration` s may have been
/// below it between, where it turned: a tangent to its path cuts the plane. h are gaps, m, and u
/// speeds away from the plane, m/s.
template <std::floating_point T>
[[nodiscard]] bool may_dip(T h_start, T u_start, T h_end, T u_end, T duration) {
    return u_start < 0 && u_end > 0 &&
           (h_start + u_start * duration < 0 || h_end - u_end * duration < 0);
}

/// Whether a step of `duration` s that ignored a plane brought the body below it, may have done so
/// where the body turned, or began on or below it without leaving it.
template <std::floating_point T, int Axes>
[[nodiscard]] bool may_meet(const PlaneOf<T, Axes>& plane, T radius, const State<T, Axes>& start,
                            const State<T, Axes>& end, T duration) {
    const T noise = hidden_distance(plane, start, radius, duration);
    const T h = gap(plane, start.x, radius);
    const T u = leaving_speed(plane, start.v);
    const T h_end = gap(plane, end.x, radius);
    const T u_end = leaving_speed(plane, end.v);
    const bool began_on = h <= noise && (u <= hidden_speed(start.v) || h < -noise);
    return h_end < 0 || began_on || may_dip(h, u, h_end, u_end, duration);
}

}  // namespace oiler
