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

// A force is one type: its numbers, its acceleration, its potential and its Jacobian. A user gives
// the numbers in the units of the fields. The columns hold the force per unit mass, so that a step
// loads no mass.
//
// Every force has: `name`; `everywhere`, whether all bodies share one; `linear`, whether it is
// linear in position and velocity; `fields()`, its numbers in the order of the columns;
// `per_unit_mass(m)`; `accelerate(state, t)` in m/s²; `jacobian(state)`; `potential(state)` in
// J/kg. `t` is in seconds.
//
// Some forces also have: `field(x, t)`, the part of the acceleration that depends on position
// alone; and for the part that depends on velocity either `damping_rate()`, the c of −c·v in 1/s,
// or `damp(state, …)`, its exact flow on velocity at a fixed position.

/// All forces. Accelerations are summed in this order.
template <Number V, int Axes>
using ForceList =
    std::tuple<GravityForce<V, Axes>, SpringForce<V, Axes>, LinearDragForce<V, Axes>,
               QuadraticDragForce<V, Axes>, CoilSpringForce<V, Axes>, AttractorForce<V, Axes>>;

/// The index of a type in a list of types.
template <class Type, class... All>
constexpr std::size_t index_of(const std::tuple<All...>*) {
    const std::array<bool, sizeof...(All)> same{std::is_same_v<Type, All>...};
    return static_cast<std::size_t>(std::find(same.begin(), same.end(), true) - same.begin());
}

inline constexpr std::size_t force_count = std::tuple_size_v<ForceList<double, 1>>;

/// The forces of the public API. Axes that the world lacks are zero.
using Spring = SpringForce<double, 3>;
using LinearDrag = LinearDragForce<double, 3>;
using QuadraticDrag = QuadraticDragForce<double, 3>;
using CoilSpring = CoilSpringForce<double, 3>;
using Attractor = AttractorForce<double, 3>;

/// Calls `f` with each number of a force in the order of its fields; vectors axis by axis.
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

/// The number of numbers in a force.
template <class Force>
constexpr std::size_t number_count() {
    std::size_t count = 0;
    Force force{};
    for_each_number(force, [&](auto&) { ++count; });
    return count;
}

/// The forces on one body or a batch of bodies. The cost is that of the forces in use. `Source` has
/// `count<Force>()`, the number of forces of a kind, and `get<Force>(index)`.
template <Number V, int Axes, class Source>
class Forces {
public:
    [[gnu::always_inline]] explicit Forces(const Source& source) : source_(source) {}

    /// The sum over the forces, in the order of the list, m/s².
    [[gnu::always_inline]] Vec<V, Axes> accelerate(const State<V, Axes>& state, double t) const {
        return sum([&](const auto& force)
                       __attribute__((always_inline)) { return force.accelerate(state, t); });
    }
    /// The part of the acceleration that depends on position alone, m/s².
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
    /// The c of the linear damping −c·v, 1/s.
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
    [[nodiscard]] [[gnu::always_inline]] Force<V, Axes> get(std::size_t index) const {
        return source_.template get<Force<V, Axes>>(index);
    }

private:
    template <class F>
    [[gnu::always_inline]] void for_each(F f) const {
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            using Force = std::tuple_element_t<i, ForceList<V, Axes>>;
            for (std::size_t index = 0; index < source_.template count<Force>(); ++index)
                f(source_.template get<Force>(index));
        });
    }
    /// Sums the results of `f` for each force; void counts as zero.
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
