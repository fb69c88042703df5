// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "oiler/physics/forces/force.hpp"

namespace oiler {

/// The parts of a linear force that act; the others are not evaluated.
struct LinearParts {
    bool constant = false;
    bool spring = false;
    bool damping = false;
};

/// LinearParts as compile-time constants.
template <bool Constant, bool Spring, bool Damping>
struct FixedLinearParts {
    static constexpr bool constant = Constant;
    static constexpr bool spring = Spring;
    static constexpr bool damping = Damping;
};

/// The sum of all linear forces on a body, per unit mass: acceleration g − k·(x − centre) − c·v.
/// Each axis is independent of the others.
template <Number V, int Axes>
struct LinearForce {
    Vec<V, Axes> constant{};  ///< g, m/s²
    Vec<V, Axes> centre{};    ///< m
    V stiffness{};            ///< k, 1/s²
    V damping{};              ///< c, 1/s

    /// The part of the acceleration that depends on position alone, m/s².
    template <class Parts>
    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>& x,
                                                        const Parts& parts) const {
        if (!parts.spring) return parts.constant ? constant : zero();
        const Vec<V, Axes> pull = (x - centre) * -stiffness;
        return parts.constant ? constant + pull : pull;
    }
    template <class Parts>
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             const Parts& parts) const {
        if (!parts.damping) return field(state.x, parts);
        const Vec<V, Axes> drag = state.v * -damping;
        const Vec<V, Axes> moving = parts.spring ? (state.x - centre) * -stiffness + drag : drag;
        return parts.constant ? constant + moving : moving;
    }
    constexpr Jacobian<V, Axes> jacobian() const {
        return {Matrix<V, Axes>::scalar(-stiffness), Matrix<V, Axes>::scalar(-damping)};
    }
    /// J/kg; zero for the spring at its centre and for the constant force at the origin.
    constexpr V potential(const Vec<V, Axes>& x) const {
        return V(0.5) * stiffness * squared_length(x - centre) - dot(constant, x);
    }

    /// The force with the sum of both accelerations.
    friend constexpr LinearForce operator+(const LinearForce& a, const LinearForce& b) {
        LinearForce sum{a.constant + b.constant, a.centre, a.stiffness + b.stiffness,
                        a.damping + b.damping};
        if (a.stiffness == 0) {
            sum.centre = b.centre;
        } else if (sum.stiffness == 0) {
            sum.constant = sum.constant + (a.centre - b.centre) * a.stiffness;
        } else if (b.stiffness != 0) {
            sum.centre = a.centre + (b.centre - a.centre) * (b.stiffness / sum.stiffness);
        }
        return sum;
    }

private:
    static constexpr Vec<V, Axes> zero() {
        return {generate<Axes>([](auto) { return V(0); })};
    }
};

/// A number that a linear force does not have.
struct Absent {};

/// The fields of a force type that are the numbers of its LinearForce, or Absent.
template <class Constant, class Centre, class Stiffness, class Damping>
struct LinearFields {
    Constant constant;
    Centre centre;
    Stiffness stiffness;
    Damping damping;

    template <class Field>
    static constexpr bool has = !std::is_same_v<Field, Absent>;
    using Parts = FixedLinearParts<has<Constant>, has<Stiffness>, has<Damping>>;
};

template <class Constant, class Centre, class Stiffness, class Damping>
LinearFields(Constant, Centre, Stiffness, Damping)
    -> LinearFields<Constant, Centre, Stiffness, Damping>;

/// A force that is linear in position and velocity.
template <class Force>
concept Linear = requires {
    Force::linear_fields();
};

/// A force in the form that steps use.
template <Number V, int Axes, template <class, int> class Force>
requires Linear<Force<V, Axes>>
[[gnu::always_inline]] constexpr LinearForce<V, Axes> linear_form(const Force<V, Axes>& force) {
    constexpr auto fields = Force<V, Axes>::linear_fields();
    using Parts = typename decltype(fields)::Parts;
    LinearForce<V, Axes> form{};
    if constexpr (Parts::constant) form.constant = force.*fields.constant;
    if constexpr (Parts::spring) form.centre = force.*fields.centre;
    if constexpr (Parts::spring) form.stiffness = force.*fields.stiffness;
    if constexpr (Parts::damping) form.damping = force.*fields.damping;
    return form;
}

}  // namespace oiler
