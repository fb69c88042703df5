// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>

#include "oiler/sim/force_types.hpp"
#include "oiler/sim/vec.hpp"

namespace oiler {

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
template <Number V, int Axes>
struct Forces {
    ForceList<V, Axes> list{};
    std::array<bool, force_count> present{};

    /// The sum over the forces that are present, in the order of the list, m/s².
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
        for_each_present([&](const auto& force) {
            const Jacobian<V, Axes> one = force.jacobian(state);
            total = {total.dx + one.dx, total.dv + one.dv};
        });
        return total;
    }
    /// The c of −c·v, 1/s.
    [[nodiscard]] V damping_rate() const {
        V total = V(0);
        for_each_present([&](const auto& force) {
            if constexpr (requires { force.damping_rate(); }) total = total + force.damping_rate();
        });
        return total;
    }
    /// Potential energy per unit mass, J/kg.
    [[nodiscard]] V potential(const State<V, Axes>& state) const {
        V total = V(0);
        for_each_present([&](const auto& force) { total = total + force.potential(state); });
        return total;
    }

    /// Null where the force is not there.
    template <template <class, int> class Force>
    [[nodiscard]] [[gnu::always_inline]] const Force<V, Axes>* find() const {
        constexpr std::size_t at =
            index_of<Force<V, Axes>>(static_cast<ForceList<V, Axes>*>(nullptr));
        return present[at] ? &std::get<at>(list) : nullptr;
    }

private:
    template <class F>
    [[gnu::always_inline]] void for_each_present(F f) const {
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            if (present[i]) f(std::get<i>(list));
        });
    }
    /// Of what `f` returns for each force that is present; void is nothing.
    template <class F>
    [[gnu::always_inline]] Vec<V, Axes> sum(F f) const {
        Vec<V, Axes> total{generate<Axes>([](auto) { return V(0); })};
        bool started = false;
        for_each_present([&](const auto& force) __attribute__((always_inline)) {
            if constexpr (!std::is_void_v<decltype(f(force))>) {
                const Vec<V, Axes> a = f(force);
                total = started ? total + a : a;
                started = true;
            }
        });
        return total;
    }
};

}  // namespace oiler
