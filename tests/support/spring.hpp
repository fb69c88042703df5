// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "oiler/sim/bodies.hpp"

// The article's spring: 1 kg at 1000 m, at rest.
inline constexpr double stiffness = 15;  // N/m
inline constexpr double damping = 0.1;   // N·s/m
inline constexpr double start_x = 1000;  // m
inline const double omega = std::sqrt(stiffness);
inline constexpr double round_off = std::numeric_limits<double>::epsilon() / 2;

inline oiler::Bodies article_spring(double b,
                                    oiler::Precision precision = oiler::Precision::double_) {
    oiler::Bodies bodies(1, precision);
    bodies.add({.position = {start_x, 0, 0}}, oiler::Spring{.stiffness = stiffness, .damping = b});
    return bodies;
}

/// The largest error of the spring's position (m) by round-off in `steps` steps. A step makes at
/// most `operations` roundings of numbers up to the `amplitude` (m; velocities over ω), and later
/// steps do not amplify them.
inline double drift_of_rounding(int steps, int operations, double amplitude) {
    return steps * operations * round_off * amplitude;
}
