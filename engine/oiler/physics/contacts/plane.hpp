// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

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

/// A set of planes of a world: bit i stands for plane i.
using PlaneSet = std::uint32_t;
inline constexpr std::size_t most_planes = 32;

/// What makes a body meet planes.
struct Contact {
    double radius = 0;  ///< m, 0 for a point
};

/// The distance of a body of `radius` (m) from a plane, m; negative below it.
template <std::floating_point T, int Axes>
[[nodiscard]] T gap(const PlaneOf<T, Axes>& plane, const Vec<T, Axes>& x, T radius) {
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

}  // namespace oiler
