// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "oiler/sim/vec.hpp"

namespace oiler {

// A force is one type: its numbers, the acceleration that it gives and the potential that it has,
// if any. A user gives the numbers in the units below; what the columns hold and the methods
// evaluate is the force per unit mass, so that no mass is loaded in a step.
//
// Every force has: `name`; `everywhere`, whether all bodies have the same one; `fields()`, its
// numbers in the order in which columns hold them; `per_unit_mass(m)`; `accelerate(state, t)` in
// m/s²; `potential(state)` in J/kg. `t` is in seconds.

/// The same acceleration for every body. Potential −g·x, zero at the origin.
template <Number V, int Axes>
struct GravityForce {
    Vec<V, Axes> acceleration{};  ///< m/s²

    static constexpr std::string_view name = "gravity";
    static constexpr bool everywhere = true;
    static constexpr auto fields() { return std::tuple(&GravityForce::acceleration); }
    constexpr GravityForce per_unit_mass(V) const { return *this; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>&, double) const {
        return acceleration;
    }
    constexpr V potential(const State<V, Axes>& state) const {
        V sum = acceleration[0] * state.x[0];
        for (int i = 1; i < Axes; ++i) sum = sum + acceleration[i] * state.x[i];
        return -sum;
    }
};

/// A spring and damper from the body to a fixed anchor: force −k·d − b·v, d = x − anchor.
template <Number V, int Axes>
struct SpringForce {
    Vec<V, Axes> anchor{};  ///< m
    V stiffness{};          ///< k, N/m
    V damping{};            ///< b, N·s/m

    static constexpr std::string_view name = "spring";
    static constexpr bool everywhere = false;
    static constexpr auto fields() {
        return std::tuple(&SpringForce::anchor, &SpringForce::stiffness, &SpringForce::damping);
    }
    constexpr SpringForce per_unit_mass(V mass) const {
        return {anchor, stiffness / mass, damping / mass};
    }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        return (state.x - anchor) * -stiffness - state.v * damping;
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
    static constexpr auto fields() { return std::tuple(&LinearDragForce::coefficient); }
    constexpr LinearDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        return state.v * -coefficient;
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
    static constexpr auto fields() { return std::tuple(&QuadraticDragForce::coefficient); }
    constexpr QuadraticDragForce per_unit_mass(V mass) const { return {coefficient / mass}; }

    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double) const {
        using std::sqrt;
        return state.v * (-coefficient * sqrt(squared_length(state.v)));
    }
    constexpr V potential(const State<V, Axes>&) const { return V(0); }
};

/// Every force there is; the order is the order in which accelerations are summed.
template <Number V, int Axes>
using ForceList = std::tuple<GravityForce<V, Axes>, SpringForce<V, Axes>, LinearDragForce<V, Axes>,
                             QuadraticDragForce<V, Axes>>;

inline constexpr std::size_t force_count = std::tuple_size_v<ForceList<double, 1>>;

/// How a user writes a force on a body, with as many axes of the vectors as the world has.
using Spring = SpringForce<double, 3>;
using LinearDrag = LinearDragForce<double, 3>;
using QuadraticDrag = QuadraticDragForce<double, 3>;

/// Calls `f` with each number of a force, in the order of its fields, vectors axis by axis.
template <class Force, class F>
[[gnu::always_inline]] constexpr void for_each_number(Force& force, F f) {
    const auto visit = [&]<class Field>(Field & field) __attribute__((always_inline)) {
        if constexpr (requires { field.axis; })
            std::apply([&](auto&... number) { (f(number), ...); }, field.axis);
        else
            f(field);
    };
    std::apply([&](auto... member) { (visit(force.*member), ...); }, Force::fields());
}

/// How many numbers a force has.
template <class Force>
constexpr std::size_t number_count() {
    std::size_t count = 0;
    Force force{};
    for_each_number(force, [&](auto&) { ++count; });
    return count;
}

/// The forces on one body, or on a batch of bodies: those that the scene names, and no others.
template <Number V, int Axes>
struct Forces {
    ForceList<V, Axes> list{};
    std::array<bool, force_count> present{};

    /// The sum over the forces that are present, in the order of the list, m/s².
    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) const {
        Vec<V, Axes> sum;
        bool started = false;
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            if (present[i]) {
                const Vec<V, Axes> a = std::get<i>(list).accelerate(state, t);
                sum = started ? sum + a : a;
                started = true;
            }
        });
        if (!started) sum = {generate<Axes>([](auto) { return V(0); })};
        return sum;
    }

    /// Potential energy per unit mass, J/kg.
    V potential(const State<V, Axes>& state) const {
        V sum = V(0);
        for_each_index<force_count>([&](auto i) {
            if (present[i]) sum = sum + std::get<i>(list).potential(state);
        });
        return sum;
    }
};

}  // namespace oiler
