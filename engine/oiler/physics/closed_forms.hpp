// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <utility>

#include "oiler/physics/state.hpp"

namespace oiler {

// Exact motions, for measuring the errors of methods. They call the C library's exp, sin and cos,
// whose last bit may differ between machines. Their results must therefore never enter the state of
// a simulation. Instantiated for double and long double.

/// Position (m) and velocity (m/s) along one axis.
template <class T>
struct Motion {
    T x;
    T v;
};

/// The motion under a constant acceleration (m/s²) after `t` s: one axis of a projectile without
/// drag.
template <class T>
[[nodiscard]] Motion<T> constant_acceleration(Motion<T> start, T acceleration, T t);

/// A mass m (kg) on a spring of stiffness k (N/m) and damping b (N·s/m), anchored at 0, after `t`
/// s. Over-, critically and underdamped; k = 0 and b = 0 are allowed. The error is a few units of
/// round-off times the number of radians or time constants, also for b ≫ √(km).
template <class T>
[[nodiscard]] Motion<T> damped_oscillator(T m, T k, T b, Motion<T> start, T t);

/// The motion under a constant acceleration (m/s²) and linear drag −c·v, c = b/m (1/s), after `t`
/// s: one axis of a projectile with linear drag. c = 0 is allowed.
template <class T>
[[nodiscard]] Motion<T> linear_drag_motion(Motion<T> start, T acceleration, T c, T t);

/// A fall from rest under gravity g (m/s², downwards) and quadratic drag −c·|v|·v, c > 0 in 1/m,
/// after `t` s; upwards is positive.
template <class T>
[[nodiscard]] Motion<T> quadratic_fall(T g, T c, T t);

/// An elliptic orbit around an attractor gm (m³/s²) at the origin, `t` s after its nearest point,
/// from Kepler's equation. The nearest point is (distance, 0) m with velocity (0, speed) m/s, where
/// speed² lies between gm/distance and twice that.
template <class T>
[[nodiscard]] State<T, 2> orbit(T gm, T distance, T speed, T t);

/// Whether the orbit around an attractor gm at the origin is an ellipse of eccentricity < 0.999.
template <class T>
[[nodiscard]] bool is_elliptic(T gm, const State<T, 3>& state);

/// An elliptic orbit around an attractor gm (m³/s²) at the origin through the state `start`, from
/// Lagrange's coefficients (Battin, An Introduction to the Mathematics and Methods of
/// Astrodynamics, 4.3). Instantiated for long double only.
template <class T>
class Ellipse {
public:
    Ellipse(T gm, const State<T, 3>& start);

    /// A solution of Kepler's equation, from which those at close times are found faster.
    struct Solution {
        T mean = 0;   ///< the change of the mean anomaly since the start, from −π to π
        T turn = 0;   ///< that of the eccentric anomaly
        T slope = 1;  ///< of the turn over the mean anomaly
    };

    [[nodiscard]] T period() const { return 2 * std::numbers::pi_v<T> / n_; }  ///< s
    /// The state `t` s after the start.
    [[nodiscard]] State<T, 3> at(T t) const;
    /// Like at(t), with Newton's iteration from a solution, which becomes that of `t`.
    State<T, 3> at(T t, Solution& solution) const;

private:
    /// Returns the sine and the cosine of the turn.
    std::pair<T, T> solve(T mean, Solution& solution) const;

    State<T, 3> start_;
    T distance_;       ///< of the start, m
    T a_;              ///< semi-major axis, m
    T n_;              ///< mean motion, 1/s
    T shape_, slant_;  ///< e·cos E and e·sin E of the start
    T root_;           ///< √(gm·a), m²/s
};

/// The state on an elliptic orbit `t` s after any of its points `start`, see Ellipse.
template <class T>
[[nodiscard]] State<T, 3> kepler(T gm, const State<T, 3>& start, T t) {
    return Ellipse<T>(gm, start).at(t);
}

}  // namespace oiler
