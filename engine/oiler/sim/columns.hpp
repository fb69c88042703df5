// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "oiler/sim/column.hpp"
#include "oiler/physics/forces/forces.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/physics/rate.hpp"

namespace oiler {

/// One force's numbers for all rows.
template <class Force, class T>
using ForceColumns = std::array<Parameter<T>, number_count<Force>()>;

template <class List, class T>
struct ForceColumnsOf;
template <class... Force, class T>
struct ForceColumnsOf<std::tuple<Force...>, T> {
    using type = std::tuple<std::vector<ForceColumns<Force, T>>...>;
};

/// A vector for each row.
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

/// The states of all rows: what a step changes.
template <std::floating_point T, int Axes>
struct MotionColumns {
    VecColumns<T, Axes> x{generate<Axes>([](auto i) { return Column<T>(i); })};         ///< m
    VecColumns<T, Axes> v{generate<Axes>([](auto i) { return Column<T>(Axes + i); })};  ///< m/s
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

/// Which part of an acceleration is asked for: that which position alone decides, or all.
enum class Evaluate { field, all };

/// `count` links with the numbers of `of`, the next of which joins the rows after those of the one
/// before.
template <std::floating_point T>
struct LinkRun {
    LinkRow<T> of;
    std::size_t count;
};

/// The exact flows that a plan needs, computed once for all steps with it.
template <class T>
struct Flows {
    bool valid = false;
    bool damped = false;                  ///< else drifts are straight
    std::vector<T> durations;             ///< s
    std::vector<FlowColumns<T>> of;       ///< each duration
    T half_step = 0;                      ///< s
    std::vector<Parameter<T>> coil_loss;  ///< of each coil, 1 − e^(−b·τ) over a half-step
};

template <class T>
class LinkSolver;

/// What steps of linked rows carry on from one to the next.
template <class T, int Axes>
struct LinkCache {
    bool valid = false;  ///< until bodies, masses, forces or links change
    std::vector<LinkRun<T>> runs;
    Parameter<T> inverse_mass;  ///< 1/kg, of each row
    T half_step = 0;            ///< s
    std::vector<T> loss;  ///< of each link, 1 − e^(−b·(1/m₁ + 1/m₂)·τ) over a half-step
    VecColumns<T, Axes> acceleration;             ///< m/s², scratch
    VecColumns<T, Axes> field;                    ///< m/s², at the positions of the last kick
    bool field_valid = false;                     ///< until positions change, too
    std::shared_ptr<const LinkSolver<T>> solver;  ///< where the equations are linear
    T solver_tau = 0;                             ///< s
};

/// The plan of the last step with a method of the list: the next step mostly takes the same.
template <class T>
struct PlanCache {
    const Method* method = nullptr;
    Rate rate{};
    Damping damping = Damping::in_kick;
    Plan<T> plan = ExactPlan<T>{0};
};

/// All bodies of a world: what every step touches in columns of their own, what it does not
/// (masses) apart.
template <std::floating_point T, int Axes>
struct Columns {
    std::size_t size = 0;
    MotionColumns<T, Axes> motion;
    Parameter<double> mass;  ///< kg
    /// As many of each kind as the body has that has the most.
    typename ForceColumnsOf<ForceList<T, Axes>, T>::type forces;
    std::vector<LinkRow<T>> links;
    /// How often the forces on the first row were evaluated.
    std::int64_t evaluations = 0;
    PlanCache<T> plan_cache;
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

/// One row's number, or those of a batch of rows from `row` on.
template <Number V, std::floating_point T>
[[nodiscard]] [[gnu::always_inline]] inline V load(const Parameter<T>& parameter, std::size_t row) {
    if constexpr (requires { V::load(parameter.data(row)); })
        return V::load(parameter.data(row));
    else
        return V(parameter[row]);
}

/// A Source of Forces: those on row `row`, or on a batch of rows from there on, per unit mass.
template <Number V, std::floating_point T, int Axes>
class ForcesOfRow {
public:
    ForcesOfRow(const Columns<T, Axes>& columns, std::size_t row) : columns_(columns), row_(row) {}

    template <class Force>
    [[gnu::always_inline]] std::size_t count() const {
        return stored<Force>().size();
    }
    template <class Force>
    [[gnu::always_inline]] Force get(std::size_t nth) const {
        const auto& numbers = stored<Force>()[nth];
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

/// The forces on row `row` as a value of the Number `V`.
template <Number V, std::floating_point T, int Axes>
[[nodiscard]] auto forces_of(const Columns<T, Axes>& columns, std::size_t row) {
    return Forces<V, Axes, ForcesOfRow<V, T, Axes>>(ForcesOfRow<V, T, Axes>(columns, row));
}

}  // namespace oiler
