// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "oiler/physics/forces/forces.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/physics/rate.hpp"
#include "oiler/sim/column.hpp"

namespace oiler {

/// The numbers of one force for all rows.
template <class Force, class T>
using ForceColumns = std::array<Parameter<T>, number_count<Force>()>;

template <class List, class T>
struct ForceColumnsOf;
template <class... Force, class T>
struct ForceColumnsOf<std::tuple<Force...>, T> {
    using type = std::tuple<std::vector<ForceColumns<Force, T>>...>;
};

/// One vector per row.
template <class T, int Axes>
using VecColumns = std::array<Column<T>, Axes>;

template <class T, std::size_t Axes>
[[nodiscard]] T largest(const std::array<Column<T>, Axes>& columns) {
    T size = 0;
    for (const Column<T>& column : columns)
        for (std::size_t row = 0; row < column.size(); ++row)
            size = larger(size, std::abs(column[row]));
    return size;
}

/// The states of all rows: the numbers that a step changes.
template <std::floating_point T, int Axes>
struct MotionColumns {
    VecColumns<T, Axes> x{generate<Axes>([](auto i) { return Column<T>(i); })};         ///< m
    VecColumns<T, Axes> v{generate<Axes>([](auto i) { return Column<T>(Axes + i); })};  ///< m/s
};

/// A spring between two rows. Its numbers are not per unit mass, because it acts on two masses.
template <std::floating_point T>
struct LinkRow {
    std::size_t a;
    std::size_t b;
    T stiffness;    ///< N/m
    T damping;      ///< N·s/m
    T rest_length;  ///< m
};

/// The Response of each row over one duration.
template <class T>
struct FlowColumns {
    Parameter<T> reach;
    Parameter<T> sway;
    Parameter<T> decay;
};

/// The part of an acceleration to evaluate: the part that depends on position alone, or all.
enum class Evaluate { field, all };

/// `count` links with the same numbers between consecutive rows; `of` is the first. Each link joins
/// the rows after those of the link before it.
template <std::floating_point T>
struct LinkRun {
    LinkRow<T> of;
    std::size_t count;
};

/// The exact flows of a plan, computed once for all its steps.
template <class T>
struct Flows {
    bool valid = false;
    bool damped = false;                  ///< otherwise drifts are x += τ·v
    std::vector<T> durations;             ///< s
    std::vector<FlowColumns<T>> of;       ///< per duration
    T half_step = 0;                      ///< s
    std::vector<Parameter<T>> coil_loss;  ///< per coil spring: 1 − e^(−b·τ) over a half-step
};

template <class T>
class LinkSolver;

/// The data that steps of linked rows reuse in the next step.
template <class T, int Axes>
struct LinkCache {
    bool valid = false;  ///< false after a change of bodies, masses, forces or links
    std::vector<LinkRun<T>> runs;
    Parameter<T> inverse_mass;  ///< 1/kg, per row
    T half_step = 0;            ///< s
    std::vector<T> loss;  ///< per link: 1 − e^(−b·(1/m₁ + 1/m₂)·τ) over a half-step
    VecColumns<T, Axes> acceleration;             ///< m/s², scratch
    VecColumns<T, Axes> field;                    ///< m/s², at the positions of the last kick
    bool field_valid = false;                     ///< also false after a change of positions
    std::shared_ptr<const LinkSolver<T>> solver;  ///< kept while the equations are linear
    T solver_tau = 0;                             ///< s
};

/// The plan of the last step with a method of the list; most steps reuse it.
template <class T>
struct PlanCache {
    const Method* method = nullptr;
    Rate rate{};
    Damping damping = Damping::in_kick;
    Plan<T> plan = ExactPlan<T>{0};
};

/// All bodies of a world. Numbers that every step needs are in separate columns from those that it
/// does not need (masses).
template <std::floating_point T, int Axes>
struct Columns {
    std::size_t size = 0;
    MotionColumns<T, Axes> motion;
    Parameter<double> mass;  ///< kg
    /// The number of forces of each kind is that of the body with the most.
    typename ForceColumnsOf<ForceList<T, Axes>, T>::type forces;
    std::vector<LinkRow<T>> links;
    /// The number of evaluations of the forces on the first row.
    std::int64_t evaluations = 0;
    PlanCache<T> plan_cache;
    /// Caches that are valid until the forces change.
    Flows<T> flows;
    LinkCache<T, Axes> link_cache;

    void forces_changed() {
        flows.valid = false;
        link_cache.valid = false;
        link_cache.field_valid = false;
    }
    void state_changed() { link_cache.field_valid = false; }
};

/// The state of row `row` in the Number `V`.
template <Number V, std::floating_point T, int Axes>
[[nodiscard]] State<V, Axes> state_of(const Columns<T, Axes>& columns, std::size_t row) {
    return {{generate<Axes>([&](auto i) { return V(columns.motion.x[i][row]); })},
            {generate<Axes>([&](auto i) { return V(columns.motion.v[i][row]); })}};
}

/// The number of one row, or of a batch of rows from `row` on.
template <Number V, std::floating_point T>
[[nodiscard]] [[gnu::always_inline]] inline V load(const Parameter<T>& parameter, std::size_t row) {
    if constexpr (requires { V::load(parameter.data(row)); })
        return V::load(parameter.data(row));
    else
        return V(parameter[row]);
}

/// A Source of Forces: the forces per unit mass on row `row`, or on a batch of rows from `row` on.
template <Number V, std::floating_point T, int Axes>
class ForcesOfRow {
public:
    ForcesOfRow(const Columns<T, Axes>& columns, std::size_t row) : columns_(columns), row_(row) {}

    template <class Force>
    [[gnu::always_inline]] std::size_t count() const {
        return stored<Force>().size();
    }
    template <class Force>
    [[gnu::always_inline]] Force get(std::size_t index) const {
        const auto& numbers = stored<Force>()[index];
        Force force;
        std::size_t next = 0;
        for_each_number(
            force, [&](V & number)
                       __attribute__((always_inline)) { number = load<V>(numbers[next++], row_); });
        return force;
    }

private:
    template <class Force>
    [[gnu::always_inline]] const auto& stored() const {
        constexpr std::size_t at = index_of<Force>(static_cast<ForceList<V, Axes>*>(nullptr));
        return std::get<at>(columns_.forces);
    }

    const Columns<T, Axes>& columns_;
    std::size_t row_;
};

/// The forces on row `row` in the Number `V`.
template <Number V, std::floating_point T, int Axes>
[[nodiscard]] auto forces_of(const Columns<T, Axes>& columns, std::size_t row) {
    return Forces<V, Axes, ForcesOfRow<V, T, Axes>>(ForcesOfRow<V, T, Axes>(columns, row));
}

}  // namespace oiler
