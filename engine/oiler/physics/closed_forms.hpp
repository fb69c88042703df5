// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/state.hpp"

namespace oiler {

// Exact motions along one axis, to measure methods against. They call the C library's exp, sin and
// cos, whose last bit may differ between machines: nothing of them may reach a simulation's state.
// Instantiated for double and long double.

/// Where a body is along one axis (m) and how fast it goes (m/s).
template <class T>
struct Motion {
    T x;
    T v;
};

/// Under a constant acceleration (m/s²) after `t` s: the motion of a projectile without drag, axis
/// by axis.
template <class T>
[[nodiscard]] Motion<T> constant_acceleration(Motion<T> start, T acceleration, T t);

/// A mass m (kg) on a spring of stiffness k (N/m) and damping b (N·s/m), anchored at 0, after `t`
/// s. Over-, critically and underdamped; k = 0 and b = 0 are allowed. Accurate to a few units of
/// round-off times the number of radians turned or time constants passed, also for b ≫ √(km).
template <class T>
[[nodiscard]] Motion<T> damped_oscillator(T m, T k, T b, Motion<T> start, T t);

/// Under a constant acceleration (m/s²) and linear drag −c·v, c = b/m (1/s), after `t` s: a
/// projectile with linear drag, axis by axis; c = 0 is allowed.
template <class T>
[[nodiscard]] Motion<T> linear_drag_motion(Motion<T> start, T acceleration, T c, T t);

/// A fall from rest under gravity g (m/s², downwards) and quadratic drag −c·|v|·v, c > 0 in 1/m,
/// after `t` s; upwards is positive.
template <class T>
[[nodiscard]] Motion<T> quadratic_fall(T g, T c, T t);

/// An orbit around an attractor gm (m³/s²) at the origin, `t` s after its nearest point, at
/// (distance, 0) m with velocity (0, speed) m/s: an ellipse, so that speed² lies between
/// gm/distance and twice that. By Kepler's equation.
template <class T>
[[nodiscard]] State<T, 2> orbit(T gm, T distance, T speed, T t);

/// Whether a body goes round an attractor gm at the origin, on an ellipse of eccentricity < 0.999.
template <class T>
[[nodiscard]] bool circles(T gm, const State<T, 3>& state);

/// The same motion from any point of such an orbit, `t` s after it: by Lagrange's coefficients
/// (Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 4.3). Long double.
template <class T>
[[nodiscard]] State<T, 3> kepler(T gm, const State<T, 3>& start, T t);

}  // namespace oiler
