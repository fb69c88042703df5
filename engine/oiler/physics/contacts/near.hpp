// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "oiler/physics/contacts/obstacle.hpp"
#include "oiler/physics/contacts/support.hpp"

namespace oiler {

/// An obstacle that a body may meet in a step, and the plane that touches it at the nearest point.
template <std::floating_point T, int Axes>
struct Near : TouchOf<T, Axes> {
    ObstacleOf<T, Axes> obstacle;  ///< where it is at the start of the step
    std::size_t index = 0;         ///< of the obstacle in its world
    Feature sides = 0;             ///< the feature of a box that the body is beside
    bool hidden = false;           ///< the nearest point is in another obstacle
    bool met = false;              ///< the body has bounced on it in this step
    bool resting = false;          ///< the body has not left it since its last rest on it
    bool dips = false;    ///< a leg of a method of order 1 is in it, although its speed leaves
    int bounces = 0;      ///< in this step
    bool lifted = false;  ///< the body has just been lifted out of it
    bool passed = false;  ///< the body went through it from a side from which it is not met
    bool moves = obstacle.course.moves();
    bool yields = moves;  ///< bodies that are deep in it pass
    bool bears = false;   ///< it may bear the body: touched, and not left
    bool leaves = false;  ///< touched, and left

    /// The depth, m, from which on a body of `radius` m passes, instead of being lifted: it came
    /// from a side from which it does not meet the obstacle, or was crushed.
    [[nodiscard]] T deepest(T noise, T radius) const {
        if (obstacle.is_one_way()) return noise;
        return yields ? std::max(noise, radius / 16) : std::numeric_limits<T>::infinity();
    }
    [[nodiscard]] bool is_moved() const { return moves || obstacle.belt != 0; }

    Near(const ObstacleOf<T, Axes>& of, std::size_t at)
        : TouchOf<T, Axes>{of.surface, {}, T(0)}, obstacle(of), index(at) {
        if (is_moved()) this->velocity = surface_velocity(of, of.surface.normal, T(0));
    }
};

/// The gap (m) of a body at x, `start` s after the start of the step.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline T gap(const Near<T, Axes>& near, const Vec<T, Axes>& x,
                                                  T start, T radius) {
    return gap(near.obstacle, place_beside(near.obstacle, x, start), radius);
}

/// Renews the touching plane of a box for a body at x, `start` s after the start of the step.
template <std::floating_point T, int Axes>
void renew_normal(Near<T, Axes>& near, const Vec<T, Axes>& x, T start) {
    if (near.obstacle.bounded)
        near.normal = normal(near.obstacle, place_beside(near.obstacle, x, start));
    if (near.is_moved()) near.velocity = surface_velocity(near.obstacle, near.normal, start);
}
/// Renews the feature of a box beside which a body at x, as seen from the box, heads somewhere. On
/// the border of a face, the normal is that of the face.
template <std::floating_point T, int Axes>
void renew_sides(Near<T, Axes>& near, const Vec<T, Axes>& x, const Vec<T, Axes>& heading, T noise) {
    near.sides = feature(near.obstacle, x, heading, noise);
    for (std::size_t i = 0; i < Axes; ++i)
        if (near.sides == Feature{1} << i) {
            const Vec<T, Axes>& side = near.obstacle.frame.row[i];
            near.normal = dot(side, near.normal) < 0 ? -side : side;
        }
}
/// A velocity relative to the surface, seen from the world. A zero keeps its sign.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> with_surface(const TouchOf<T, Axes>& touch, const Vec<T, Axes>& v) {
    return touch.velocity == Vec<T, Axes>{} ? v : v + touch.velocity;
}
/// Turns a box to a face that no other obstacle covers, where a point at x is on the borders of
/// several of its faces: a step through a covered one, behind the others, ends in another obstacle
/// of those that the point touches. A box whose faces there are all covered is hidden.
template <std::floating_point T, int Axes>
void turn_to_open_face(Near<T, Axes>& near, std::span<const Near<T, Axes>> nears,
                       const Vec<T, Axes>& x, T start) {
    const T noise = 2 * hidden_distance(near.obstacle, State<T, Axes>{x, {}}, T(0), T(0));
    const auto [place, past] = beside(near.obstacle, place_beside(near.obstacle, x, start));
    Vec<T, Axes> behind{};
    std::array<Vec<T, Axes>, Axes> out{};
    Feature borders = 0;
    for (std::size_t i = 0; i < Axes; ++i) {
        if (past.axis[i] < -noise) continue;
        borders |= Feature{1} << i;
        out[i] = near.obstacle.frame.row[i] * (place.axis[i] < 0 ? T(-1) : T(1));
        behind -= out[i] * (4 * noise);
    }
    if (!is_round(borders)) return;
    Feature open = 0;
    for (std::size_t i = 0; i < Axes; ++i) {
        if ((borders >> i & 1U) == 0) continue;
        const Vec<T, Axes> there = x + behind + out[i] * (8 * noise);
        const bool is_covered = std::ranges::any_of(nears, [&](const Near<T, Axes>& other) {
            return &other != &near && other.bears && gap(other, there, start, T(0)) < -noise;
        });
        if (!is_covered) open |= Feature{1} << i;
    }
    near.hidden = open == 0;
    if (near.hidden || (near.sides & open) != 0) return;
    near.sides = open & ~(open - 1);
    for (std::size_t i = 0; i < Axes; ++i)
        if (near.sides == Feature{1} << i) near.normal = out[i];
}

/// Hides obstacles whose nearest point to a body lies in another one that the body touches: that
/// one is as near, so that a body does not notice the joints between boxes. Of two that have the
/// nearest points of each other, a face hides a corner, else the lower index the higher one. No
/// half-space is hidden, and none that moves out of the other one.
///
/// The features are known. `touches(near)` tells whether the body at x, `start` s after the start
/// of the step, touches it.
template <std::floating_point T, int Axes, class Touches>
void hide_joints(std::span<Near<T, Axes>> nears, const Vec<T, Axes>& x, T start, T radius,
                 Touches touches) {
    using One = Near<T, Axes>;
    const auto contains = [&](const One& one, const One& other) {
        const Vec<T, Axes> point = x - other.normal * (gap(other, x, start, radius) + radius);
        const T noise = hidden_distance(one.obstacle, State<T, Axes>{x, {}}, radius, T(0));
        return gap(one, point, start, T(0)) <= noise;
    };
    const auto precedes = [&](const One& one, const One& other) {
        const bool corner = is_round(one.sides);
        return corner == is_round(other.sides) ? one.index < other.index : !corner;
    };
    const auto moves_out_of = [&](const One& near, const One& other) {
        const Vec<T, Axes> v = near.obstacle.course.velocity_at(start);
        const T noise = 1024 * std::numeric_limits<T>::epsilon() * largest(v);
        return dot(near.normal, v - other.obstacle.course.velocity_at(start)) > noise;
    };
    for (One& near : nears) near.hidden = false;
    // The nearest point of all that a point touches is the point itself.
    if (radius == 0) {
        for (One& near : nears) near.bears = touches(near);
        for (One& near : nears)
            if (near.bears && near.obstacle.bounded && near.obstacle.rounding == 0)
                turn_to_open_face(near, std::span<const One>(nears), x, start);
        return;
    }
    for (One& near : nears) {
        if (!near.obstacle.bounded || !touches(near)) continue;
        near.hidden = std::ranges::any_of(nears, [&](const One& other) {
            return &other != &near && !other.hidden && touches(other) && contains(other, near) &&
                   !moves_out_of(near, other) && !(contains(near, other) && precedes(near, other));
        });
    }
}

}  // namespace oiler
