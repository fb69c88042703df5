// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "oiler/sim/column.hpp"
#include "oiler/sim/forces.hpp"

namespace oiler {

/// A force's numbers for all rows.
template <class Force, class T>
struct ForceColumns {
    bool present = false;
    std::array<Parameter<T>, number_count<Force>()> numbers;
};

template <class List, class T>
struct ForceColumnsOf;
template <class... Force, class T>
struct ForceColumnsOf<std::tuple<Force...>, T> {
    using type = std::tuple<ForceColumns<Force, T>...>;
};

/// A vector for each row.
template <class T, int Axes>
using VecColumns = std::array<Column<T>, Axes>;

template <class T, std::size_t Axes>
void add_scaled(std::array<Column<T>, Axes>& to, const std::array<Column<T>, Axes>& what, T s) {
    for (std::size_t i = 0; i < Axes; ++i)
        for (std::size_t row = 0; row < to[i].size(); ++row)
            to[i][row] = to[i][row] + what[i][row] * s;
}

template <class T, std::size_t Axes>
[[nodiscard]] T largest(const std::array<Column<T>, Axes>& columns) {
    T size = 0;
    for (const Column<T>& column : columns)
        for (std::size_t row = 0; row < column.size(); ++row)
            size = larger(size, std::abs(column[row]));
    return size;
}

/// The states of all rows: what a step changes.
template <std::floating_point T, int Axes>
struct MotionColumns {
    VecColumns<T, Axes> x;  ///< m
    VecColumns<T, Axes> v;  ///< m/s
};

/// A spring between two rows, per the user's units: it is shared by two masses.
template <std::floating_point T>
struct LinkRow {
    std::size_t a;
    std::size_t b;
    T stiffness;    ///< N/m
    T damping;      ///< N·s/m
    T rest_length;  ///< m
};

/// What the exact flows of one length do to each row, see Response.
template <class T>
struct FlowColumns {
    Parameter<T> reach;
    Parameter<T> sway;
    Parameter<T> decay;
};

/// The exact flows that a plan needs, computed once for all steps with it.
template <class T>
struct Flows {
    bool valid = false;
    bool damped = false;             ///< else drifts are straight
    std::vector<T> durations;        ///< s
    std::vector<FlowColumns<T>> of;  ///< each duration
    T half_step = 0;                 ///< s
    Parameter<T> coil_loss;          ///< 1 − e^(−b·τ) over a half-step
};

template <class T>
class LinkSolver;

/// What steps of linked rows carry on from one to the next.
template <class T, int Axes>
struct LinkCache {
    bool valid = false;           ///< until bodies, masses, forces or links change
    std::vector<T> inverse_mass;  ///< 1/kg, of each row
    T half_step = 0;              ///< s
    std::vector<T> loss;  ///< of each link, 1 − e^(−b·(1/m₁ + 1/m₂)·τ) over a half-step
    VecColumns<T, Axes> field;                    ///< m/s², at the positions of the last kick
    bool field_valid = false;                     ///< until positions change, too
    std::shared_ptr<const LinkSolver<T>> solver;  ///< where the equations are linear
    T solver_tau = 0;                             ///< s
};

/// All bodies of a world: what every step touches in columns of their own, what it does not
/// (masses) apart.
template <std::floating_point T, int Axes>
struct Columns {
    std::size_t size = 0;
    MotionColumns<T, Axes> motion;
    Parameter<double> mass;  ///< kg
    typename ForceColumnsOf<ForceList<T, Axes>, T>::type forces;
    std::vector<LinkRow<T>> links;
    /// How often the forces on the first row were evaluated.
    std::int64_t evaluations = 0;
    /// What a step makes of the forces, as long as they stay as they are.
    Flows<T> flows;
    LinkCache<T, Axes> link_cache;

    void forces_changed() {
        flows.valid = false;
        link_cache.valid = false;
        link_cache.field_valid = false;
    }
    void state_changed() { link_cache.field_valid = false; }
};

/// Row `row` as a value of the Number `V` (double for measuring, T for reading).
template <Number V, std::floating_point T, int Axes>
[[nodiscard]] State<V, Axes> state_of(const Columns<T, Axes>& columns, std::size_t row) {
    return {{generate<Axes>([&](auto i) { return V(columns.motion.x[i][row]); })},
            {generate<Axes>([&](auto i) { return V(columns.motion.v[i][row]); })}};
}

/// The forces on some rows, per unit mass, of which `read` makes each number of its Parameter.
template <Number V, std::floating_point T, int Axes, class Read>
[[nodiscard]] [[gnu::always_inline]] inline Forces<V, Axes> read_forces(
    const Columns<T, Axes>& columns, Read read) {
    Forces<V, Axes> forces;
    for_each_index<force_count>([&](auto i) {
        const auto& stored = std::get<i>(columns.forces);
        forces.present[i] = stored.present;
        std::size_t next = 0;
        if (stored.present)
            for_each_number(std::get<i>(forces.list),
                            [&](V& number) { number = read(stored.numbers[next++]); });
    });
    return forces;
}

/// Those on row `row`, as the step evaluates them.
template <Number V, std::floating_point T, int Axes>
[[nodiscard]] Forces<V, Axes> forces_of(const Columns<T, Axes>& columns, std::size_t row) {
    return read_forces<V>(columns,
                          [&](const Parameter<T>& parameter) { return V(parameter[row]); });
}

}  // namespace oiler
