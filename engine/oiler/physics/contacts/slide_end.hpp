// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/state.hpp"

namespace oiler {

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
