// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "oiler/sim/matrix.hpp"
#include "oiler/sim/vec.hpp"

namespace oiler {

// A force is one type: its numbers, the acceleration that it gives, the potential that it has, if
// any, and how it changes with state. A user gives the numbers in the units below; what the columns
// hold and the methods evaluate is the force per unit mass, so that no mass is loaded in a step.
//
// Every force has: `name`; `everywhere`, whether all bodies have the same one; `linear`, whether in
// position and velocity; `fields()`, its numbers in the order in which columns hold them;
// `per_unit_mass(m)`; `accelerate(state, t)` in m/s²; `jacobian(state)`; `potential(state)` in
// J/kg. `t` is in seconds. In addition, as far as it has them: `field(x, t)`, the part of the
// acceleration that position alone decides, and for the rest of it either `damping_rate()`, the c
// of −c·v in 1/s, or `slow(state, …)`, its exact flow on velocity while the body stays where it is.

/// How an acceleration changes with position (1/s²) and velocity (1/s).
template <Number V, int Axes>
struct Jacobian {
    Matrix<V, Axes> dx{};
    Matrix<V, Axes> dv{};
};

/// The same acceleration for every body. Potential −g·x, zero at the origin.
template <Number V, int Axes>
struct GravityForce {
    Vec<V, Axes> acceleration{};  ///< m/s²

    static constexpr std::string_view name = "gravity";
    static constexpr bool everywhere = true;
    static constexpr bool linear = true;
    static constexpr auto fields() { return std::tuple(&GravityForce::acceleration); }
    constexpr GravityForce per_unit_mass(V) const { return *this; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>&, double) const {
        return acceleration;
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>&, double) const {
        return acceleration;
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const { return {}; }
    constexpr V potential(const State<V, Axes>& state) const { return -dot(acceleration, state.x); }
};

/// A spring and damper from the body to a fixed anchor: force −k·d − b·v, d = x − anchor.
template <Number V, int Axes>
struct SpringForce {
    Vec<V, Axes> anchor{};  ///< m
    V stiffness{};          ///< k, N/m
    V damping{};            ///< b, N·s/m

    static constexpr std::string_view name = "spring";
    static constexpr bool everywhere = false;
    static constexpr bool linear = true;
    static constexpr auto fields() {
        return std::tuple(&SpringForce::anchor, &SpringForce::stiffness, &SpringForce::damping);
    }
    constexpr SpringForce per_unit_mass(V mass) const {
        return {anchor, stiffness / mass, damping / mass};
    }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x, double) const {
        return (x - anchor) * -stiffness;
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double t) const {
        return field(state.x, t) - state.v * damping;
    }
    constexpr const V& damping_rate() const { return damping; }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const {
        return {Matrix<V, Axes>::scalar(-stiffness), Matrix<V, Axes>::scalar(-damping)};
    }
    constexpr V potential(const State<V, Axes>& state) const {
        return V(0.5) * stiffness * squared_length(state.x - anchor);
    }
};

/// Drag of slow motion through a thick fluid: force −b·v.
template <Number V, int Axes>
struct LinearDragForce {
    V coefficient{};  ///< b, N·s/m

    static constexpr std::string_view name = "linear_drag";
    static constexpr bool everywhere = false;
    static constexpr bool linear = true;
    static constexpr auto fields() { return std::tuple(&LinearDragForce::coefficient); }
    constexpr LinearDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        return state.v * -coefficient;
    }
    constexpr const V& damping_rate() const { return coefficient; }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const {
        return {{}, Matrix<V, Axes>::scalar(-coefficient)};
    }
    constexpr V potential(const State<V, Axes>&) const { return V(0); }
};

/// Drag of fast motion through air: force −c·|v|·v. Where any body has it, |v|² of all must be a
/// number: speeds stay below 1.8·10¹⁹ m/s in float and 1.3·10¹⁵⁴ m/s in double.
template <Number V, int Axes>
struct QuadraticDragForce {
    V coefficient{};  ///< c, N·s²/m²

    static constexpr std::string_view name = "quadratic_drag";
    static constexpr bool everywhere = false;
    static constexpr bool linear = false;
    static constexpr auto fields() { return std::tuple(&QuadraticDragForce::coefficient); }
    constexpr QuadraticDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        using std::sqrt;
        return state.v * (-coefficient * sqrt(squared_length(state.v)));
    }
    /// v' = −c·|v|·v for `tau` s: v/(1 + c·|v|·τ).
    [[gnu::always_inline]] constexpr void slow(State<V, Axes>& state, const V& tau) const {
        using std::sqrt;
        const V speed = sqrt(squared_length(state.v));
        // Not a number where the speed is none, instead of rest.
        const V nothing = speed - speed;
        state.v = state.v * (V(1) / (V(1) + coefficient * speed * tau) + nothing);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        using std::sqrt;
        const V speed = sqrt(squared_length(state.v));
        const auto direction = state.v * quotient_or_zero(V(1), speed);
        return {{},
                Matrix<V, Axes>::scalar(-coefficient * speed) +
                    Matrix<V, Axes>::outer(direction, state.v * -coefficient)};
    }
    constexpr V potential(const State<V, Axes>&) const { return V(0); }
};

/// The direction of `d`, and nothing for a d so short that |d|² is 0: below 10⁻²³ m in float and
/// 10⁻¹⁶² m in double.
template <Number V, int Axes>
struct Direction {
    V length;
    V inverse_length;  ///< 0 for 0
    Vec<V, Axes> unit;

    [[gnu::always_inline]] explicit constexpr Direction(const Vec<V, Axes>& d) {
        using std::sqrt;
        length = sqrt(squared_length(d));
        inverse_length = quotient_or_zero(V(1), length);
        unit = d * inverse_length;
    }
};

/// A spring with a length of its own, from the body to a fixed anchor, that is damped along its
/// line: force −k·(d − L·d̂) − b·(v·d̂)·d̂, d = x − anchor, and nothing at d = 0. |d| stays below
/// 1.8·10¹⁹ m in float.
template <Number V, int Axes>
struct CoilSpringForce {
    Vec<V, Axes> anchor{};  ///< m
    V stiffness{};          ///< k, N/m
    V damping{};            ///< b, N·s/m
    V rest_length{};        ///< L, m

    static constexpr std::string_view name = "coil_spring";
    static constexpr bool everywhere = false;
    static constexpr bool linear = false;
    static constexpr auto fields() {
        return std::tuple(&CoilSpringForce::anchor, &CoilSpringForce::stiffness,
                          &CoilSpringForce::damping, &CoilSpringForce::rest_length);
    }
    constexpr CoilSpringForce per_unit_mass(V mass) const {
        return {anchor, stiffness / mass, damping / mass, rest_length};
    }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x, double) const {
        const Direction<V, Axes> d(x - anchor);
        return d.unit * (stiffness * (rest_length - d.length));
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        const Direction<V, Axes> d(state.x - anchor);
        return d.unit * (stiffness * (rest_length - d.length) - damping * dot(state.v, d.unit));
    }
    /// `loss` is 1 − e^(−b·τ).
    [[gnu::always_inline]] constexpr void slow(State<V, Axes>& state, const V& loss) const {
        const Direction<V, Axes> d(state.x - anchor);
        state.v = state.v - d.unit * (dot(state.v, d.unit) * loss);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        using M = Matrix<V, Axes>;
        const Direction<V, Axes> d(state.x - anchor);
        const M along = M::outer(d.unit, d.unit);
        const M across = M::scalar(V(1)) - along;
        const V along_speed = dot(state.v, d.unit);
        const auto across_velocity = state.v - d.unit * along_speed;
        const M turning =
            (across * along_speed + M::outer(d.unit, across_velocity)) * d.inverse_length;
        const V tension = stiffness * (rest_length * d.inverse_length - V(1));
        return {across * tension - along * stiffness - turning * damping, along * -damping};
    }
    constexpr V potential(const State<V, Axes>& state) const {
        const V stretch = Direction<V, Axes>(state.x - anchor).length - rest_length;
        return V(0.5) * stiffness * stretch * stretch;
    }
};

/// A point that attracts like a planet: acceleration −gm·d/|d|³, d = x − centre, whatever the
/// body's mass. Not a number at the centre. |d|³ must be one: 10⁻¹² < |d| < 10¹² m in float.
template <Number V, int Axes>
struct AttractorForce {
    Vec<V, Axes> centre{};  ///< m
    V gm{};                 ///< m³/s²

    static constexpr std::string_view name = "attractor";
    static constexpr bool everywhere = false;
    static constexpr bool linear = false;
    static constexpr auto fields() {
        return std::tuple(&AttractorForce::centre, &AttractorForce::gm);
    }
    constexpr AttractorForce per_unit_mass(V) const { return *this; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x, double) const {
        using std::sqrt;
        const Vec<V, Axes> d = x - centre;
        const V squared = squared_length(d);
        const V cubed = squared * sqrt(squared);
        // Not a number where the cube is none, instead of no attraction.
        return d * ((cubed - cubed) - quotient_unless_nothing(gm, cubed));
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double t) const {
        return field(state.x, t);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        using M = Matrix<V, Axes>;
        const Direction<V, Axes> d(state.x - centre);
        const V pull = quotient_unless_nothing(gm, d.length * d.length * d.length);
        return {M::outer(d.unit, d.unit * (V(3) * pull)) - M::scalar(pull), {}};
    }
    constexpr V potential(const State<V, Axes>& state) const {
        return -quotient_unless_nothing(gm, Direction<V, Axes>(state.x - centre).length);
    }
};

}  // namespace oiler
