// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>

#include "oiler/math/sine.hpp"
#include "oiler/math/vec.hpp"

namespace oiler {

/// The motion of an obstacle over a step, in s since its start: a cubic and an oscillation. It is
/// known at all times, so that a bounce on a moving obstacle keeps the method's order.
template <std::floating_point T, int Axes>
struct Course {
    using Vec = oiler::Vec<T, Axes>;

    Vec velocity{};      ///< m/s, at the start of the step, without the oscillation
    Vec acceleration{};  ///< m/s²
    Vec jerk{};          ///< m/s³
    Vec sway{};          ///< m, amplitude of the oscillation
    T frequency = 0;     ///< Hz
    T turns = 0;         ///< phase at the start of the step, in turns
    Vec jump{};          ///< m/s, of the velocity at the start of the step

    [[nodiscard]] [[gnu::always_inline]] bool moves() const {
        return velocity != Vec{} || accelerates();
    }
    [[nodiscard]] [[gnu::always_inline]] bool accelerates() const {
        return acceleration != Vec{} || jerk != Vec{} || sway != Vec{};
    }
    [[nodiscard]] Vec way(T s) const {
        Vec way = velocity * s;
        if (!accelerates()) return way;
        way += acceleration * (s * s / 2) + jerk * (s * s * s / 6);
        if (sway != Vec{})
            way += sway * (sine_of_turns(turns + frequency * s) - sine_of_turns(turns));
        return way;
    }
    [[nodiscard]] Vec velocity_at(T s) const {
        if (!accelerates()) return velocity;
        return velocity + acceleration * s + jerk * (s * s / 2) +
               sway * (angular() * sine_of_turns(turns + frequency * s + T(0.25)));
    }
    [[nodiscard]] Vec acceleration_at(T s) const {
        if (!accelerates()) return {};
        return acceleration + jerk * s -
               sway * (angular() * angular() * sine_of_turns(turns + frequency * s));
    }
    /// The largest speed, m/s, and acceleration, m/s², in the first s seconds.
    [[nodiscard]] T most_speed(T s) const {
        return length(velocity) + most_acceleration(s) * s + length(sway) * angular();
    }
    [[nodiscard]] T most_acceleration(T s) const {
        return length(acceleration) + length(jerk) * s + length(sway) * angular() * angular();
    }

private:
    [[nodiscard]] T angular() const { return frequency * two_pi; }
    static constexpr T two_pi = T(6.283185307179586476925286766559L);
};

}  // namespace oiler
