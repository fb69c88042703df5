// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

#include "oiler/physics/contacts/course.hpp"
#include "oiler/physics/contacts/support.hpp"

namespace oiler {

/// A slide along obstacles: friction acts against its direction, and the first of their surfaces
/// may accelerate. Times `tau` are s since its start.
template <std::floating_point T, int Axes>
struct Friction {
    using Vector = Vec<T, Axes>;
    using Support = oiler::Support<T, Axes>;

    Vector direction;  ///< at the start of a step, of length 1, relative to the surface
    Vector surface;    ///< m/s
    bool turns;        ///< whether the body may slide in two directions
    const Course<T, Axes>* course = nullptr;  ///< of the surface; null if it does not accelerate
    T start = 0;                              ///< s, of the slide, in the course's time

    [[nodiscard]] Vector against(const Vector& v) const {
        const Vector slip = v - surface;
        return turns && dot(slip, direction) > 0 ? -normalised(slip) : -direction;
    }
    /// The most that friction can hold against an acceleration of the body, m/s².
    [[nodiscard]] T grip(const Support& support, const Vector& a, T tau) const {
        return course ? support.grip(a - acceleration_change(tau)) : support.grip(a);
    }
    /// The acceleration of a body along the obstacles, without friction.
    [[nodiscard]] Vector borne(const Support& support, const Vector& a, T tau) const {
        if (!course) return support.without_push(a);
        const Vector change = acceleration_change(tau);
        return support.without_push(a - change) + change;
    }
    /// The same with friction.
    [[nodiscard]] Vector braked(const Support& support, const Vector& a, const Vector& v,
                                T tau) const {
        const T most = grip(support, a, tau);
        const Vector free = borne(support, a, tau);
        return most == 0 ? free : free + against(v) * most;
    }
    /// The velocity of a body that goes along all obstacles.
    [[nodiscard]] Vector following(const Support& support, const Vector& v, T tau) const {
        if (!course) return support.following(v);
        const Vector change = course->velocity_at(start + tau) - course->velocity_at(start);
        return support.following(v - change) + change;
    }
    [[nodiscard]] Vector acceleration_change(T tau) const {
        return course->acceleration_at(start + tau) - course->acceleration_at(start);
    }
};

/// How a slide ends under a constant pull along a plane, weaker than friction.
template <std::floating_point T, int Axes>
struct SlideEnd {
    T time;            ///< s
    Vec<T, Axes> way;  ///< m
};

/// The end of v' = p − g·v/|v| with accelerations |p| < g of pull and grip. The quantity
/// g·|v| + p·v falls by g² − p² per second; the way follows from the derivatives of v·|v| and
/// (p·v)·v.
template <std::floating_point T, int Axes>
[[nodiscard]] SlideEnd<T, Axes> slide_end(const Vec<T, Axes>& v, const Vec<T, Axes>& pull, T grip) {
    const T speed = length(v);
    const T along = dot(v, pull);
    const T surplus = grip * grip - dot(pull, pull);
    const T both = (2 * grip * speed + along) / (4 * grip * grip - dot(pull, pull));
    return {(grip * speed + along) / surplus,
            v * both + pull * ((3 * along * both + speed * speed) / (4 * surplus))};
}

}  // namespace oiler
