// SPDX-License-Identifier: MIT
#include "oiler/physics/closed_forms.hpp"

#include <cmath>
#include <numbers>

namespace oiler {
namespace {

/// γ < ω0: x = e^(−γt)·(x0·cos ωt + (v0 + γx0)·sin ωt / ω).
template <class T>
Motion<T> underdamped(T gamma, T stiffness, T omega, Motion<T> start, T t) {
    const T decay = std::exp(-gamma * t);
    const T c = std::cos(omega * t);
    const T s = std::sin(omega * t) / omega;
    return {decay * (start.x * c + (start.v + gamma * start.x) * s),
            decay * (start.v * c - (stiffness * start.x + gamma * start.v) * s)};
}

/// γ ≥ ω0, with δ = √(γ² − ω0²) and the rates of decay fast = γ + δ and slow = ω0²/fast. This form
/// of slow does not cancel as γ − δ does. x = x0·e^(−slow·t) + (v0 + slow·x0)·(e^(−slow·t) −
/// e^(−fast·t))/2δ.
template <class T>
Motion<T> overdamped(T gamma, T stiffness, T delta, Motion<T> start, T t) {
    const T fast = gamma + delta;
    const T slow = fast > 0 ? stiffness / fast : T(0);
    const T slow_decay = std::exp(-slow * t);
    const T fast_decay = std::exp(-fast * t);
    const T spread = 2 * delta;
    const T difference = spread > 0 ? -std::expm1(-spread * t) / spread : t;
    const T w = start.v + slow * start.x;
    const T x = slow_decay * (start.x + w * difference);
    return {x, w * fast_decay - slow * x};
}

/// (1 − e^(−z))/z, 1 at 0.
template <class T>
T phi1(T z) {
    return z == 0 ? T(1) : -std::expm1(-z) / z;
}

/// (z − 1 + e^(−z))/z², ½ at 0. For |z| ≤ 1, where the formula cancels, by its series.
template <class T>
T phi2(T z) {
    if (std::abs(z) > T(1)) return (z + std::expm1(-z)) / (z * z);
    T term = T(0.5);
    T sum = term;
    for (int n = 3; n < 30; ++n) {
        term *= -z / static_cast<T>(n);
        sum += term;
    }
    return sum;
}

}  // namespace

template <class T>
Motion<T> constant_acceleration(Motion<T> start, T acceleration, T t) {
    return {start.x + start.v * t + acceleration * t * t / 2, start.v + acceleration * t};
}

template <class T>
Motion<T> damped_oscillator(T m, T k, T b, Motion<T> start, T t) {
    const T gamma = b / (2 * m);
    const T stiffness = k / m;
    const T omega0 = std::sqrt(stiffness);
    const T discriminant = (omega0 - gamma) * (omega0 + gamma);
    return discriminant > 0 ? underdamped(gamma, stiffness, std::sqrt(discriminant), start, t)
                            : overdamped(gamma, stiffness, std::sqrt(-discriminant), start, t);
}

template <class T>
Motion<T> linear_drag_motion(Motion<T> start, T acceleration, T c, T t) {
    const T z = c * t;
    return {start.x + start.v * t * phi1(z) + acceleration * t * t * phi2(z),
            start.v * std::exp(-z) + acceleration * t * phi1(z)};
}

template <class T>
Motion<T> quadratic_fall(T g, T c, T t) {
    const T terminal = std::sqrt(g / c);
    const T z = g * t / terminal;
    return {-(z + std::log1p(std::exp(-2 * z)) - std::log(T(2))) / c, -terminal * std::tanh(z)};
}

template <class T>
State<T, 2> orbit(T gm, T distance, T speed, T t) {
    const T a = 1 / (2 / distance - speed * speed / gm);
    const T e = 1 - distance / a;
    const T n = std::sqrt(gm / a) / a;
    // Newton's iteration for E − e·sin E = M from above, where it cannot overshoot (Danby, 1988).
    const T mean = n * t;
    T eccentric = mean + e;
    for (int i = 0; i < 64; ++i)
        eccentric -= (eccentric - e * std::sin(eccentric) - mean) / (1 - e * std::cos(eccentric));
    const T minor = a * std::sqrt((1 - e) * (1 + e));
    const T rate = n / (1 - e * std::cos(eccentric));
    return {{a * (std::cos(eccentric) - e), minor * std::sin(eccentric)},
            {-a * rate * std::sin(eccentric), minor * rate * std::cos(eccentric)}};
}

template <class T>
bool is_elliptic(T gm, const State<T, 3>& state) {
    const T distance = std::sqrt(squared_length(state.x));
    const T inverse_a = 2 / distance - squared_length(state.v) / gm;
    const T along = dot(state.x, state.v);
    const T twice_area = distance * distance * squared_length(state.v) - along * along;
    const T flatness = twice_area * inverse_a / gm;  // 1 − e²
    return distance > 0 && inverse_a > 0 && flatness > T(0.002);
}

template <class T>
Ellipse<T>::Ellipse(T gm, const State<T, 3>& start)
    : start_(start),
      distance_(std::sqrt(squared_length(start.x))),
      a_(1 / (2 / distance_ - squared_length(start.v) / gm)),
      n_(std::sqrt(gm / a_) / a_),
      shape_(1 - distance_ / a_),
      slant_(dot(start.x, start.v) / std::sqrt(gm * a_)),
      root_(std::sqrt(gm * a_)) {}

template <class T>
State<T, 3> Ellipse<T>::at(T t) const {
    Solution none;
    return at(t, none);
}

template <class T>
State<T, 3> Ellipse<T>::at(T t, Solution& solution) const {
    const T mean = std::remainder(n_ * t, 2 * std::numbers::pi_v<T>);
    const auto [sine, cosine] = solve(mean, solution);
    const T versine = cosine > 0 ? sine * sine / (1 + cosine) : 1 - cosine;
    const T f = 1 - a_ / distance_ * versine;
    const T g = (mean - (solution.turn - sine)) / n_;
    const Vec<T, 3> x = start_.x * f + start_.v * g;
    const T now = std::sqrt(squared_length(x));
    const T f_rate = -root_ / (now * distance_) * sine;
    return {x, start_.x * f_rate + start_.v * (1 - a_ / now * versine)};
}

// Halley's cubic iteration, with bisection where a step leaves the bracket: the changes of the mean
// and the eccentric anomaly are within 3 of each other.
template <class T>
std::pair<T, T> Ellipse<T>::solve(T mean, Solution& solution) const {
    constexpr T last_step = 1e-7L;
    constexpr int most_steps = 100;
    T low = mean - 3;
    T high = mean + 3;
    T turn = solution.turn + solution.slope * (mean - solution.mean);
    if (!(turn > low && turn < high)) turn = mean;
    for (int step = 0;; ++step) {
        const T sine = std::sin(turn);
        const T cosine = std::cos(turn);
        const T miss = turn - shape_ * sine + slant_ * (1 - cosine) - mean;
        const T slope = 1 - shape_ * cosine + slant_ * sine;
        const T bend = (shape_ * sine + slant_ * cosine) / 2;
        const T by = -miss * slope / (slope * slope - miss * bend);
        if (std::abs(by) <= last_step || step == most_steps) {
            solution = {mean, turn + by, 1 / slope};
            return {sine + by * (cosine - by / 2 * sine), cosine - by * (sine + by / 2 * cosine)};
        }
        (miss > 0 ? high : low) = turn;
        turn = turn + by > low && turn + by < high ? turn + by : (low + high) / 2;
    }
}

template bool is_elliptic(long double, const State<long double, 3>&);
template class Ellipse<long double>;
template Motion<double> constant_acceleration(Motion<double>, double, double);
template Motion<double> damped_oscillator(double, double, double, Motion<double>, double);
template Motion<double> linear_drag_motion(Motion<double>, double, double, double);
template Motion<double> quadratic_fall(double, double, double);
template State<double, 2> orbit(double, double, double, double);
template Motion<long double> quadratic_fall(long double, long double, long double);
template State<long double, 2> orbit(long double, long double, long double, long double);
template Motion<long double> constant_acceleration(Motion<long double>, long double, long double);
template Motion<long double> damped_oscillator(long double, long double, long double,
                                               Motion<long double>, long double);
template Motion<long double> linear_drag_motion(Motion<long double>, long double, long double,
                                                long double);

}  // namespace oiler
