// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "oiler/math/matrix.hpp"
#include "oiler/physics/contacts/course.hpp"
#include "oiler/physics/contacts/plane.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// An obstacle in steps: a half-space, or a rounded box. A circle is a rounded box without sides,
/// and a segment one without a width: one rule has the gaps and normals of all of them.
template <std::floating_point T, int Axes>
struct ObstacleOf {
    PlaneOf<T, Axes> surface{};  ///< a half-space's; of a box only restitution and friction
    bool bounded = false;        ///< a rounded box
    Vec<T, Axes> centre{};       ///< m
    Matrix<T, Axes> frame = Matrix<T, Axes>::scalar(T(1));  ///< a row per side, of length 1
    Vec<T, Axes> half{};                                    ///< m, half the length of each side
    T rounding = 0;                                         ///< m, the radius of corners
    Course<T, Axes> course{};
    T belt = 0;                ///< m/s, of the surface, clockwise
    Vec<T, Axes> one_way{};    ///< of length 1, the side from which it is met; 0 for all sides
    bool solid = true;         ///< bodies do not pass it
    std::uint32_t layers = 1;  ///< one per bit; none for a removed obstacle

    [[nodiscard]] bool is_one_way() const { return one_way != Vec<T, Axes>{}; }
    /// A segment, or a plate in three axes.
    [[nodiscard]] bool is_thin() const {
        return bounded && std::ranges::count(half.axis, T(0)) == 1;
    }
};

/// Whether a one-way obstacle is met from the side of `normal`: within 60° of its direction.
template <std::floating_point T, int Axes>
[[nodiscard]] bool bears_from(const ObstacleOf<T, Axes>& obstacle, const Vec<T, Axes>& normal) {
    return dot(normal, obstacle.one_way) >= T(0.5);
}

/// The place x as seen from an obstacle that has moved for `start` s, m.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline Vec<T, Axes> place_beside(
    const ObstacleOf<T, Axes>& obstacle, const Vec<T, Axes>& x, T start) {
    return obstacle.course.moves() ? x - obstacle.course.way(start) : x;
}
/// The velocity of the belt of an obstacle where its normal is `normal`, m/s.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> belt_velocity(const ObstacleOf<T, Axes>& obstacle,
                                         const Vec<T, Axes>& normal) {
    if constexpr (Axes == 2) return Vec<T, Axes>{{normal[1], -normal[0]}} * obstacle.belt;
    return {};
}
/// The velocity of the surface there, `start` s after the start of the step.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> surface_velocity(const ObstacleOf<T, Axes>& obstacle,
                                            const Vec<T, Axes>& normal, T start) {
    const Vec<T, Axes> v = obstacle.course.velocity_at(start);
    return obstacle.belt == 0 ? v : v + belt_velocity(obstacle, normal);
}

/// A body's place beside a rounded box: the distances from the sides of the box, from its centre
/// outwards, m, negative between a side and the opposite one.
template <std::floating_point T, int Axes>
struct Beside {
    Vec<T, Axes> place;  ///< m, in the box's frame
    Vec<T, Axes> past;   ///< m, |place| − half
};
template <std::floating_point T, int Axes>
[[nodiscard]] Beside<T, Axes> beside(const ObstacleOf<T, Axes>& box, const Vec<T, Axes>& x) {
    const Vec<T, Axes> from_centre = x - box.centre;
    Beside<T, Axes> at;
    for (std::size_t i = 0; i < Axes; ++i) {
        at.place.axis[i] = dot(box.frame.row[i], from_centre);
        at.past.axis[i] = std::abs(at.place.axis[i]) - box.half.axis[i];
    }
    return at;
}

template <std::floating_point T, int Axes>
[[nodiscard]] T gap_of_box(const ObstacleOf<T, Axes>& box, const Vec<T, Axes>& x, T radius) {
    Vec<T, Axes> outside = beside(box, x).past;
    T nearest = outside.axis[0];
    for (T& past : outside.axis) {
        nearest = std::max(nearest, past);
        past = std::max(past, T(0));
    }
    return (nearest > 0 ? length(outside) : nearest) - (box.rounding + radius);
}

/// The distance of a body of `radius` (m) from an obstacle, m; negative inside it.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline T gap(const ObstacleOf<T, Axes>& obstacle,
                                                  const Vec<T, Axes>& x, T radius) {
    return obstacle.bounded ? gap_of_box(obstacle, x, radius) : gap(obstacle.surface, x, radius);
}
/// The direction from the nearest point of an obstacle to x. In the middle of a box, where several
/// sides are equally near, the first side decides.
template <std::floating_point T, int Axes>
[[nodiscard]] Vec<T, Axes> normal(const ObstacleOf<T, Axes>& obstacle, const Vec<T, Axes>& x) {
    if (!obstacle.bounded) return obstacle.surface.normal;
    const auto [place, past] = beside(obstacle, x);
    const T* const nearest = std::max_element(past.axis.begin(), past.axis.end());
    Vec<T, Axes> outside = past;
    for (T& one : outside.axis) one = std::max(one, T(0));
    const T distance = length(outside);
    Vec<T, Axes> sum{};
    for (std::size_t i = 0; i < Axes; ++i) {
        const bool is_nearest = &past.axis[i] == nearest;
        const T part = distance > 0 ? std::max(past.axis[i], T(0)) / distance : T(is_nearest);
        sum += obstacle.frame.row[i] * (place.axis[i] < 0 ? -part : part);
    }
    return sum;
}

/// The sides of a box beyond which its nearest point to a body is at their end: bit i for side i.
/// None or one means a face, more an edge or a corner, round for a body with a radius. On the
/// border of a face, `heading` decides.
using Feature = unsigned;
[[nodiscard]] inline bool is_round(Feature sides) { return (sides & (sides - 1)) != 0; }
/// The one face that a point on a box without rounding is beside: of `sides`, on the border of
/// which it is, that through which it leaves fastest; else the nearest one.
template <std::floating_point T, int Axes>
[[nodiscard]] Feature sharp_feature(Feature sides, const Vec<T, Axes>& past,
                                    const Vec<T, Axes>& outwards) {
    std::size_t face = Axes;
    for (std::size_t i = 0; i < Axes; ++i) {
        if (sides != 0 && (sides >> i & 1U) == 0) continue;
        const Vec<T, Axes>& by = sides != 0 ? outwards : past;
        if (face == Axes || by.axis[i] > by.axis[face]) face = i;
    }
    return Feature{1} << face;
}
template <std::floating_point T, int Axes>
[[nodiscard]] Feature feature(const ObstacleOf<T, Axes>& box, const Vec<T, Axes>& x,
                              const Vec<T, Axes>& heading, T noise) {
    const auto [place, past] = beside(box, x);
    Vec<T, Axes> outwards;
    Feature sides = 0;
    for (std::size_t i = 0; i < Axes; ++i) {
        outwards.axis[i] = dot(box.frame.row[i], heading) * (place.axis[i] < 0 ? T(-1) : T(1));
        const bool is_past =
            std::abs(past.axis[i]) > noise ? past.axis[i] > 0 : outwards.axis[i] > 0;
        if (box.half.axis[i] == 0 || is_past) sides |= Feature{1} << i;
    }
    const bool is_sharp = *std::max_element(past.axis.begin(), past.axis.end()) <= noise;
    return is_sharp ? sharp_feature(sides, past, outwards) : sides;
}
/// The distance, m, after which another feature is the nearest one, negative if it is.
template <std::floating_point T, int Axes>
[[nodiscard]] T left_of_feature(const ObstacleOf<T, Axes>& box, const Vec<T, Axes>& x,
                                Feature sides) {
    const Vec<T, Axes> past = beside(box, x).past;
    T left = std::numeric_limits<T>::infinity();
    for (std::size_t i = 0; i < Axes; ++i)
        if (box.half.axis[i] > 0) {
            const bool is_past = (sides >> i & 1U) != 0;
            // On its only face, a body stays.
            if (is_past && !is_round(sides) && past.axis[i] <= 0) continue;
            left = std::min(left, is_past ? past.axis[i] : -past.axis[i]);
        }
    return left;
}
/// The acceleration towards the obstacle, m/s², of a body that follows a feature with velocity v:
/// v²/ρ in the directions in which its way round the feature is curved.
template <std::floating_point T, int Axes>
[[nodiscard]] T turning(const ObstacleOf<T, Axes>& box, const Vec<T, Axes>& normal, Feature sides,
                        const Vec<T, Axes>& v, T radius) {
    const Vec<T, Axes> along = v - normal * dot(normal, v);
    T square = 0;
    int round = 0;
    for (std::size_t i = 0; i < Axes; ++i) {
        if ((sides >> i & 1U) == 0) continue;
        const T speed = dot(box.frame.row[i], along);
        square += speed * speed;
        ++round;
    }
    return round < 2 || square == 0 ? T(0) : square / (box.rounding + radius);
}

/// The radius of the ball about its centre that a rounded box fills at most, m.
template <std::floating_point T, int Axes>
[[nodiscard]] T reach(const ObstacleOf<T, Axes>& box) {
    return length(box.half) + box.rounding;
}

/// The distance from an obstacle that round-off hides in a step of `duration` s, m.
template <std::floating_point T, int Axes>
[[nodiscard]] [[gnu::always_inline]] inline T hidden_distance(const ObstacleOf<T, Axes>& obstacle,
                                                              const State<T, Axes>& state, T radius,
                                                              T duration) {
    constexpr T noise = 8 * std::numeric_limits<T>::epsilon();
    const T swinging = noise * largest(obstacle.course.sway);
    if (!obstacle.bounded)
        return hidden_distance(obstacle.surface, state, radius, duration) + swinging;
    return noise * (largest(state.x) + largest(state.v) * duration + largest(obstacle.centre) +
                    reach(obstacle) + radius) +
           swinging;
}

/// The farthest that a body gets from the middle of both ends of a step of `duration` s, m: within
/// the hull of the ends and of the crossings of their tangents, wider by what the acceleration may
/// change.
template <std::floating_point T, int Axes>
[[nodiscard]] T largest_way(const State<T, Axes>& start, const State<T, Axes>& end, T duration) {
    return length(end.x - start.x) / 2 +
           (length(start.v) + length(end.v) + length(end.v - start.v) * 2) * duration / 4;
}

/// Whether a body may have met an obstacle in a step of `duration` s that ignored it.
template <std::floating_point T, int Axes>
[[nodiscard]] bool may_meet(const ObstacleOf<T, Axes>& obstacle, T radius,
                            const State<T, Axes>& start, const State<T, Axes>& end, T duration) {
    if (!obstacle.bounded)
        return obstacle.course.moves() || may_meet(obstacle.surface, radius, start, end, duration);
    const T most = reach(obstacle) + radius + largest_way(start, end, duration) +
                   obstacle.course.most_speed(duration) * duration +
                   hidden_distance(obstacle, start, radius, duration);
    return squared_length((start.x + end.x) * T(0.5) - obstacle.centre) <= most * most;
}

}  // namespace oiler
