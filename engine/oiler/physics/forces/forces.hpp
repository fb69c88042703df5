// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "oiler/physics/forces/attractor.hpp"
#include "oiler/physics/forces/coil_spring.hpp"
#include "oiler/physics/forces/drive.hpp"
#include "oiler/physics/forces/gravity.hpp"
#include "oiler/physics/forces/linear_drag.hpp"
#include "oiler/physics/forces/quadratic_drag.hpp"
#include "oiler/physics/forces/spring.hpp"
#include "oiler/physics/forces/wind.hpp"

namespace oiler {

// A force is one type: its numbers and its physics. A user gives the numbers in the units of the
// fields. The columns hold the force per unit mass, so that a step loads no mass.
//
// Every force has: `name` and `plural`; `everywhere`, whether all bodies share one; `fields()`, its
// numbers in the order of the columns, each with its key in scene files; `per_unit_mass(m)`.
//
// A force that is linear in position and velocity has `linear_fields()`, and needs nothing else.
// Every other force has `accelerate(state, t)` in m/s²; `jacobian(state)`; `potential(state)` in
// J/kg; one or both of
// - `field(x, t)`, the part of the acceleration that depends on position and time alone;
// - `damp(state, number)`, the exact flow of the part that depends on velocity, at a fixed
//   position. `prepare_damping(tau)` returns its number for tau s;
// and, because it limits the timestep, one of
// - `line_spring()`, its spring and damper along the line to an anchor, a CoilSpringForce;
// - `air_drag()`, its quadratic drag, an AirDrag;
// - `fastest(state)`, the largest angular frequency of its motion from a state in double on, rad/s.
// `depends_on_time` marks a field that depends on t, in s. If float has too few digits for a field,
// the others are in `rests()`, which `take_rests(from)` fills.

/// All forces. Accelerations are summed in this order, after that of the linear forces.
template <Number V, int Axes>
using ForceList = std::tuple<GravityForce<V, Axes>, SpringForce<V, Axes>, LinearDragForce<V, Axes>,
                             QuadraticDragForce<V, Axes>, CoilSpringForce<V, Axes>,
                             AttractorForce<V, Axes>, WindForce<V, Axes>, DriveForce<V, Axes>>;

/// The index of a type in a list of types.
template <class Type, class... All>
constexpr std::size_t index_of(const std::tuple<All...>*) {
    const std::array<bool, sizeof...(All)> same{std::is_same_v<Type, All>...};
    return static_cast<std::size_t>(std::find(same.begin(), same.end(), true) - same.begin());
}

inline constexpr std::size_t force_count = std::tuple_size_v<ForceList<double, 1>>;

/// The forces of the public API. Axes that the world lacks are zero.
using Gravity = GravityForce<double, 3>;
using Spring = SpringForce<double, 3>;
using LinearDrag = LinearDragForce<double, 3>;
using QuadraticDrag = QuadraticDragForce<double, 3>;
using CoilSpring = CoilSpringForce<double, 3>;
using Attractor = AttractorForce<double, 3>;
using Wind = WindForce<double, 3>;
using Drive = DriveForce<double, 3>;

/// Calls `f` with each field of a force.
template <class Force, class F>
[[gnu::always_inline]] constexpr void for_each_field(F f) {
    constexpr auto fields = Force::fields();
    std::apply(
        [&](const auto&... field) __attribute__((always_inline)) { (f(field), ...); }, fields);
}

/// A force some of whose fields have further digits, in numbers of their own.
template <class Force>
concept HasRests = requires {
    Force::rests();
};

/// Calls `f` with each number of a force in the order of its fields, vectors axis by axis; then
/// with its rests.
template <class Force, class F>
[[gnu::always_inline]] constexpr void for_each_number(Force& force, F f) {
    const auto visit = [&]<class Field>(Field & field) __attribute__((always_inline)) {
        if constexpr (requires { field.axis; })
            std::apply([&](auto&... number) { (f(number), ...); }, field.axis);
        else
            f(field);
    };
    for_each_field<Force>([&](const auto& field)
                              __attribute__((always_inline)) { visit(force.*field.member); });
    if constexpr (HasRests<Force>)
        std::apply(
            [&](const auto&... rest)
                __attribute__((always_inline)) { (f(force.*rest.member), ...); },
            Force::rests());
}

/// The number of numbers in a force.
template <class Force>
constexpr std::size_t number_count() {
    std::size_t count = 0;
    Force force{};
    for_each_number(force, [&](auto&) { ++count; });
    return count;
}

/// The largest number of numbers in any force.
inline constexpr std::size_t most_numbers =
    []<class... Force>(std::type_identity<std::tuple<Force...>>) {
        return std::max({number_count<Force>()...});
    }(std::type_identity<ForceList<double, 3>>{});

template <class Force>
concept DependsOnTime = Force::depends_on_time;

/// A force whose damping has a flow of its own.
template <class Force, class State, class V>
concept Damps = requires(const Force& force, State& state, const V& number) {
    force.damp(state, number);
};

/// A force with a spring and a damper along a line.
template <class Force>
concept LineSpring = requires(const Force& force) {
    force.line_spring();
};

/// A force with quadratic drag.
template <class Force>
concept DragsInAir = requires(const Force& force) {
    force.air_drag();
};

/// Whether all numbers of two forces are equal.
template <class Force>
requires requires { Force::fields(); }
[[nodiscard]] constexpr bool operator==(const Force& a, const Force& b) {
    bool equal = true;
    for_each_field<Force>(
        [&](const auto& field) { equal = equal && a.*field.member == b.*field.member; });
    return equal;
}

/// Whether a force has any number other than 0.
template <class Force>
[[nodiscard]] constexpr bool acts(Force force) {
    bool any = false;
    for_each_number(force, [&](const auto& number) { any = any || number != 0; });
    return any;
}

/// The acceleration by one force, m/s².
template <class Force, Number V, int Axes>
[[nodiscard]] constexpr Vec<V, Axes> accelerate(const Force& force, const State<V, Axes>& state,
                                                double t) {
    if constexpr (Linear<Force>)
        return linear_form(force).accelerate(state,
                                             typename decltype(Force::linear_fields())::Parts{});
    else
        return force.accelerate(state, t);
}

/// The part of the acceleration by one force that depends on position and time alone, m/s².
template <class Force, Number V, int Axes>
[[nodiscard]] constexpr Vec<V, Axes> field(const Force& force, const Vec<V, Axes>& x, double t) {
    if constexpr (Linear<Force>)
        return linear_form(force).field(x, typename decltype(Force::linear_fields())::Parts{});
    else if constexpr (requires { force.field(x, t); })
        return force.field(x, t);
    else
        return {};
}

/// The derivatives of the acceleration by one force.
template <class Force, Number V, int Axes>
[[nodiscard]] constexpr Jacobian<V, Axes> jacobian(const Force& force,
                                                   const State<V, Axes>& state) {
    if constexpr (Linear<Force>)
        return linear_form(force).jacobian();
    else
        return force.jacobian(state);
}

/// The potential energy per unit mass in one force, J/kg.
template <class Force, Number V, int Axes>
[[nodiscard]] constexpr V potential(const Force& force, const State<V, Axes>& state) {
    if constexpr (Linear<Force>)
        return linear_form(force).potential(state.x);
    else
        return force.potential(state);
}

/// The forces on one body or a batch of bodies along one axis, if all of them are linear.
template <Number V, class Parts>
struct AxisForces {
    LinearForce<V, 1> linear;
    [[no_unique_address]] Parts parts;

    [[gnu::always_inline]] Vec<V, 1> accelerate(const State<V, 1>& state, double) const {
        return linear.accelerate(state, parts);
    }
    [[gnu::always_inline]] Vec<V, 1> field(const Vec<V, 1>& x, double) const {
        return linear.field(x, parts);
    }
    /// See Forces::squares_speeds.
    [[nodiscard]] V squares_speeds() const { return V(Scalar<V>(0)); }
};

/// The forces on one body or a batch of bodies: the sum of the linear ones, and the others.
/// `Others` has `count<Force>()`, the number of forces of a kind; `get<Force>(index)`; and
/// `damping_number<Force>(index)`, the result of prepare_damping for a half-step.
template <Number V, int Axes, class Parts, class Others>
struct Forces {
    LinearForce<V, Axes> linear;
    Parts parts;
    Others others;

    /// The sum over the forces, m/s².
    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) const {
        Vec<V, Axes> total = linear.accelerate(state, parts);
        for_each_other([&](const auto& force) __attribute__((always_inline)) {
            total = total + force.accelerate(state, t);
        });
        return total;
    }
    /// The part of the acceleration that depends on position and time alone, m/s².
    [[gnu::always_inline]] Vec<V, Axes> field(const Vec<V, Axes>& x, double t) const {
        Vec<V, Axes> total = linear.field(x, parts);
        for_each_other([&](const auto& force) __attribute__((always_inline)) {
            if constexpr (requires { force.field(x, t); }) total = total + force.field(x, t);
        });
        return total;
    }
    /// Half-steps of damping at a fixed position, one force after the other.
    [[gnu::always_inline]] void damp(State<V, Axes>& state) const {
        for_each_kind([&](auto kind) __attribute__((always_inline)) {
            for (std::size_t i = 0; i < count<kind>(); ++i) damp_by<kind>(state, i);
        });
    }
    /// Half-steps of damping in the reverse order.
    [[gnu::always_inline]] void damp_in_reverse(State<V, Axes>& state) const {
        for_each_kind<true>([&](auto kind) __attribute__((always_inline)) {
            for (std::size_t i = count<kind>(); i-- > 0;) damp_by<kind>(state, i);
        });
    }
    [[nodiscard]] Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        Jacobian<V, Axes> total = linear.jacobian();
        for_each_other([&](const auto& force) {
            const Jacobian<V, Axes> one = force.jacobian(state);
            total = {total.dx + one.dx, total.dv + one.dv};
        });
        return total;
    }
    /// Positive for bodies with damping that is not linear, whose formulas have squares of speeds;
    /// 0 for others.
    [[nodiscard]] V squares_speeds() const {
        V total = V(Scalar<V>(0));
        for_each_other([&]<class One>(const One& force) {
            if constexpr (Damps<One, State<V, Axes>, V>)
                for_each_number(force, [&](const V& number) { total = total + number * number; });
        });
        return total;
    }
    /// Whether the field depends on time.
    [[nodiscard]] [[gnu::always_inline]] bool depend_on_time() const {
        bool any = false;
        for_each_kind([&](auto kind) __attribute__((always_inline)) {
            if constexpr (DependsOnTime<Force<kind>>) any = any || count<kind>() > 0;
        });
        return any;
    }

private:
    template <std::size_t kind>
    using Force = std::tuple_element_t<kind, ForceList<V, Axes>>;

    /// Calls f(kind) for each kind of force that is not linear, from the first or from the last.
    template <bool Reverse = false, class F>
    [[gnu::always_inline]] void for_each_kind(F f) const {
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            constexpr std::size_t kind = Reverse ? force_count - 1 - i : i;
            if constexpr (!Linear<Force<kind>>) f(std::integral_constant<std::size_t, kind>{});
        });
    }
    template <std::size_t kind>
    [[gnu::always_inline]] std::size_t count() const {
        return others.template count<Force<kind>>();
    }
    template <std::size_t kind>
    [[gnu::always_inline]] void damp_by(State<V, Axes>& state, std::size_t i) const {
        if constexpr (Damps<Force<kind>, State<V, Axes>, V>)
            others.template get<Force<kind>>(i).damp(
                state, others.template damping_number<Force<kind>>(i));
    }
    template <class F>
    [[gnu::always_inline]] void for_each_other(F f) const {
        for_each_kind([&](auto kind) __attribute__((always_inline)) {
            for (std::size_t i = 0; i < count<kind>(); ++i) f(others.template get<Force<kind>>(i));
        });
    }
};

}  // namespace oiler
