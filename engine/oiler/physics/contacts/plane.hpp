// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "oiler/physics/state.hpp"

namespace oiler {

/// A plane, met by bodies with a Contact on the side to which its normal points.
template <Number V, int Axes>
struct PlaneOf {
    Vec<V, Axes> normal{};  ///< n; of length 1 in steps
    V offset{};             ///< m; the plane is where n·x = offset
    V restitution{};        ///< from 0 to 1: the part of the normal speed that a bounce keeps
    V friction{};           ///< Coulomb's coefficient, 0 or more

    friend bool operator==(const PlaneOf&, const PlaneOf&) = default;
};

/// A plane of the public API. A normal of another length than 1 means the same plane: offset and
/// normal are divided by its length. Axes that the world lacks are zero.
using Plane = PlaneOf<double, 3>;

/// The shape of a body that meets planes.
struct Contact {
    double radius = 0;          ///< m, 0 for a point
    std::uint32_t meets = ~0U;  ///< the layers of obstacles that it meets, one per bit
};

/// The distance of a body of `radius` (m) from a plane, m; negative below it.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline T gap(const PlaneOf<T, Axes>& plane,
                                                  const Vec<T, Axes>& x, T radius) {
    return dot(plane.normal, x) - (plane.offset + radius);
}

/// The speed away from a plane, m/s.
template <std::floating_point T, int Axes>
[[nodiscard]] T leaving_speed(const PlaneOf<T, Axes>& plane, const Vec<T, Axes>& v) {
    return dot(plane.normal, v);
}

/// The velocity along the plane after friction against a push of the plane, which changes the
/// normal speed by `push`, m/s.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> braked(const PlaneOf<T, Axes>& plane, const Vec<T, Axes>& along,
                                  T push) {
    const T speed = length(along);
    const T lost = plane.friction * push;
    return lost < speed ? along * (1 - lost / speed) : Vec<T, Axes>{};
}

/// The velocity after the first part of an impact with `speed` into the plane: the body is stopped,
/// with Coulomb's friction.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> landed(const PlaneOf<T, Axes>& plane, const Vec<T, Axes>& v, T speed) {
    return braked(plane, v + plane.normal * speed, speed);
}

/// The velocity after the second part of an impact: the body is pushed off with the speed `kept`.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> pushed_off(const PlaneOf<T, Axes>& plane, const Vec<T, Axes>& along,
                                      T kept) {
    return braked(plane, along, kept) + plane.normal * kept;
}

/// The kinds of meetings of a body with an obstacle.
enum class Meeting {
    bounce,
    rest,     ///< the bounces have ended
    lifted,   ///< the body was in the obstacle, and was moved out of it
    crushed,  ///< a moving obstacle leaves the body no room: it passes until they are apart
    entered,  ///< the body begins to overlap an area
    left      ///< it no longer does
};

/// A meeting of a body with an obstacle, within a step.
template <class T, int Axes>
struct ImpactOf {
    Meeting kind;
    std::size_t obstacle;  ///< its index
    T after_start;         ///< s, since the start of the step
    Vec<T, Axes> x;        ///< m, of the body
    Vec<T, Axes> normal;   ///< of the obstacle there
    Vec<T, Axes> before;   ///< m/s
    Vec<T, Axes> after;    ///< m/s
};

/// The distance from a plane that round-off hides in a step of `duration` s, m.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline T hidden_distance(const PlaneOf<T, Axes>& plane,
                                                              const State<T, Axes>& state, T radius,
                                                              T duration) {
    return 8 * std::numeric_limits<T>::epsilon() *
           (largest(state.x) + largest(state.v) * duration + std::abs(plane.offset) + radius);
}
/// The speed towards a plane that round-off hides, m/s.
template <std::floating_point T, int Axes>
[[nodiscard]] T hidden_speed(const Vec<T, Axes>& v) {
    return 8 * std::numeric_limits<T>::epsilon() * largest(v);
}

/// Whether a body that is above a plane at the start and at the end of `duration` s may have been
/// below it between, where it turned: a tangent to its path passes through the plane. h are gaps,
/// m, and u speeds away from the plane, m/s.
template <std::floating_point T>
[[nodiscard]] bool may_dip(T h_start, T u_start, T h_end, T u_end, T duration) {
    return u_start < 0 && u_end > 0 &&
           (h_start + u_start * duration < 0 || h_end - u_end * duration < 0);
}

/// Whether a body may have met a plane in a step of `duration` s that ignored the plane. It may
/// have if it ends below the plane, if it may have been below it between (see may_dip), or if it
/// starts on or below the plane without leaving it.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline bool may_meet(const PlaneOf<T, Axes>& plane, T radius,
                                                          const State<T, Axes>& start,
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
