// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>

#include "oiler/physics/forces/attractor.hpp"
#include "oiler/physics/forces/coil_spring.hpp"
#include "oiler/physics/forces/gravity.hpp"
#include "oiler/physics/forces/linear_drag.hpp"
#include "oiler/physics/forces/quadratic_drag.hpp"
#include "oiler/physics/forces/spring.hpp"

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

/// Every force there is; the order is the order in which accelerations are summed.
template <Number V, int Axes>
using ForceList =
    std::tuple<GravityForce<V, Axes>, SpringForce<V, Axes>, LinearDragForce<V, Axes>,
               QuadraticDragForce<V, Axes>, CoilSpringForce<V, Axes>, AttractorForce<V, Axes>>;

/// Where a type stands in a list of types.
template <class Type, class... All>
constexpr std::size_t index_of(const std::tuple<All...>*) {
    const std::array<bool, sizeof...(All)> same{std::is_same_v<Type, All>...};
    return static_cast<std::size_t>(std::find(same.begin(), same.end(), true) - same.begin());
}

inline constexpr std::size_t force_count = std::tuple_size_v<ForceList<double, 1>>;

/// How a user writes a force on a body, with as many axes of the vectors as the world has.
using Spring = SpringForce<double, 3>;
using LinearDrag = LinearDragForce<double, 3>;
using QuadraticDrag = QuadraticDragForce<double, 3>;
using CoilSpring = CoilSpringForce<double, 3>;
using Attractor = AttractorForce<double, 3>;

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
/// `Source` has them: `count<Force>()` says how many of a kind, `get<Force>(n)` what the nth is.
template <Number V, int Axes, class Source>
class Forces {
public:
    [[gnu::always_inline]] explicit Forces(const Source& source) : source_(source) {}

    /// The sum over the forces, in the order of the list, m/s².
    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) const {
        return sum([&](const auto& force)
                       __attribute__((always_inline)) { return force.accelerate(state, t); });
    }
    /// The part of it that position alone decides.
    [[gnu::always_inline]] Vec<V, Axes> field(const Vec<V, Axes>& x, double t) const {
        return sum([&](const auto& force) __attribute__((always_inline)) {
            if constexpr (requires { force.field(x, t); }) return force.field(x, t);
        });
    }
    [[nodiscard]] Jacobian<V, Axes> jacobian(const State<V, Axes>& state) const {
        Jacobian<V, Axes> total;
        for_each([&](const auto& force) {
            const Jacobian<V, Axes> one = force.jacobian(state);
            total = {total.dx + one.dx, total.dv + one.dv};
        });
        return total;
    }
    /// The c of −c·v, 1/s.
    [[nodiscard]] [[gnu::always_inline]] V damping_rate() const {
        V total = V(0);
        for_each([&](const auto& force) __attribute__((always_inline)) {
            if constexpr (requires { force.damping_rate(); }) total = total + force.damping_rate();
        });
        return total;
    }
    /// Potential energy per unit mass, J/kg.
    [[nodiscard]] V potential(const State<V, Axes>& state) const {
        V total = V(0);
        for_each([&](const auto& force) { total = total + force.potential(state); });
        return total;
    }

    template <template <class, int> class Force>
    [[nodiscard]] [[gnu::always_inline]] std::size_t count() const {
        return source_.template count<Force<V, Axes>>();
    }
    template <template <class, int> class Force>
    [[nodiscard]] [[gnu::always_inline]] Force<V, Axes> get(std::size_t nth) const {
        return source_.template get<Force<V, Axes>>(nth);
    }

private:
    template <class F>
    [[gnu::always_inline]] void for_each(F f) const {
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            using Force = std::tuple_element_t<i, ForceList<V, Axes>>;
            for (std::size_t nth = 0; nth < source_.template count<Force>(); ++nth)
                f(source_.template get<Force>(nth));
        });
    }
    /// Of what `f` returns for each force; void is nothing.
    template <class F>
    [[gnu::always_inline]] Vec<V, Axes> sum(F f) const {
        Vec<V, Axes> total{generate<Axes>([](auto) { return V(0); })};
        bool started = false;
        for_each([&](const auto& force) __attribute__((always_inline)) {
            if constexpr (!std::is_void_v<decltype(f(force))>) {
                const Vec<V, Axes> a = f(force);
                for_each_index<Axes>([&](auto axis) __attribute__((always_inline)) {
                    total.axis[axis] = started ? V(total.axis[axis] + a.axis[axis]) : a.axis[axis];
                });
                started = true;
            }
        });
        return total;
    }

    Source source_;
};

}  // namespace oiler
