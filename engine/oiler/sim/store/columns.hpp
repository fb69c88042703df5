// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "oiler/physics/advance.hpp"
#include "oiler/physics/forces/forces.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/physics/rate.hpp"
#include "oiler/physics/state.hpp"
#include "oiler/sim/store/column.hpp"
#include "oiler/sim/store/links.hpp"
#include "oiler/sim/store/obstacles.hpp"
#include "oiler/sim/store/row_views.hpp"

namespace oiler {

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

template <class T, int Axes>
void clear_padding(MotionColumns<T, Axes>& motion) {
    for (auto* vector : {&motion.x, &motion.v})
        for (Column<T>& column : *vector) column.clear_padding();
}

template <Number V, std::floating_point T>
[[gnu::always_inline]] inline V load(const Column<T>& column, std::size_t row) {
    return load_from<V>(column.data() + row);
}
template <Number V, std::floating_point T>
[[gnu::always_inline]] inline void store(const V& value, Column<T>& column, std::size_t row) {
    store_to<V>(value, column.data() + row);
}

template <Number V, class T, std::size_t Axes>
[[gnu::always_inline]] inline Vec<V, int{Axes}> load(const std::array<Column<T>, Axes>& columns,
                                                     std::size_t row) {
    return {generate<Axes>([&](auto i) { return load<V>(columns[i], row); })};
}
template <Number V, class T, std::size_t Axes, int A>
[[gnu::always_inline]] inline void store(const Vec<V, A>& value,
                                         std::array<Column<T>, Axes>& columns, std::size_t row) {
    for_each_index<Axes>([&](auto i) { store(value.axis[i], columns[i], row); });
}
template <Number V, class T, int Axes>
[[gnu::always_inline]] inline State<V, Axes> load(const MotionColumns<T, Axes>& motion,
                                                  std::size_t row) {
    return {load<V>(motion.x, row), load<V>(motion.v, row)};
}
template <Number V, class T, int Axes>
[[gnu::always_inline]] inline void store(const State<V, Axes>& state,
                                         MotionColumns<T, Axes>& motion, std::size_t row) {
    store(state.x, motion.x, row);
    store(state.v, motion.v, row);
}

/// The forces from outside over the next step, such as a thrust.
template <std::floating_point T, int Axes>
struct AppliedForces {
    VecColumns<T, Axes> acceleration;  ///< m/s²; without rows until the first force
    std::vector<std::size_t> rows;     ///< those on which a force was applied, perhaps twice

    [[nodiscard]] bool empty() const { return rows.empty(); }
    void add(std::size_t row, const Vec<T, Axes>& change, std::size_t row_count) {
        for (std::size_t i = 0; i < Axes; ++i) {
            while (acceleration[i].size() < row_count) acceleration[i].push(T(0));
            acceleration[i][row] += change.axis[i];
        }
        rows.push_back(row);
    }
    /// The sum of the accelerations of a row, m/s².
    [[nodiscard]] Vec<T, Axes> sum(std::size_t row) const {
        if (row >= acceleration[0].size()) return {};
        return {generate<Axes>([&](auto axis) { return acceleration[axis][row]; })};
    }
    void clear() {
        for (const std::size_t row : rows)
            for (Column<T>& column : acceleration) column[row] = T(0);
        rows.clear();
    }
    void push_row() {
        if (acceleration[0].size() > 0)
            for (Column<T>& column : acceleration) column.push(T(0));
    }
    /// Removes `row`, to whose place row `last` moves.
    void swap_remove(std::size_t row, std::size_t last) {
        if (acceleration[0].size() == 0) return;
        for (Column<T>& column : acceleration) column.swap_remove(row);
        std::erase(rows, row);
        std::replace(rows.begin(), rows.end(), last, row);
    }
};

/// An impact of the body in a row.
template <std::floating_point T, int Axes>
struct RowImpact {
    std::int64_t tick;  ///< at the start of the step
    std::size_t row;
    std::size_t index;  ///< among the impacts of the row in the step
    ImpactOf<T, Axes> impact;

    [[nodiscard]] friend bool operator<(const RowImpact& a, const RowImpact& b) {
        return std::tie(a.tick, a.impact.after_start, a.row, a.index) <
               std::tie(b.tick, b.impact.after_start, b.row, b.index);
    }
};

/// The obstacles of a world and the rows that meet them.
template <std::floating_point T, int Axes>
struct Contacts {
    static constexpr T no_contact = -std::numeric_limits<T>::infinity();

    Obstacles<T, Axes> obstacles;
    Obstacles<T, Axes> areas;  ///< which bodies pass
    Parameter<T> radius;       ///< m; no_contact for rows that pass through obstacles
    /// Per row; rows at the end that meet all layers may be missing.
    std::vector<std::uint32_t> layers_met;
    std::size_t rows = 0;               ///< the number of rows with a contact
    std::vector<std::uint8_t> settled;  ///< per row, see Landed; rows at the end may be missing
    /// Per row; whether obstacles that crushed the body still pass. Rows at the end may be missing.
    std::vector<std::uint8_t> crushed;
    std::vector<Clearing<T, Axes>> clearings;                       ///< per row
    std::vector<Clearing<T, Axes>> area_clearings;                  ///< per row
    std::vector<RowImpact<T, Axes>> impacts;                        ///< of the last call, in order
    std::vector<std::vector<RowImpact<T, Axes>>> impacts_of_parts;  ///< memory of a step
    std::vector<std::vector<Near<T, Axes>>> nears_of_parts{1};      ///< memory of a step
    std::vector<std::vector<typename Obstacles<T, Axes>::Ball>> moving_of_parts;  ///< likewise

    /// Whether any body may meet an obstacle.
    [[nodiscard]] bool possible() const {
        return rows > 0 && !(obstacles.empty() && areas.empty());
    }
    [[nodiscard]] Obstacles<T, Axes>& all(bool solid) { return solid ? obstacles : areas; }
    [[nodiscard]] const Obstacles<T, Axes>& all(bool solid) const {
        return solid ? obstacles : areas;
    }

    [[nodiscard]] static T radius_of(const std::optional<Contact>& contact) {
        return contact ? static_cast<T>(contact->radius) : no_contact;
    }
    /// The layers of obstacles that a row meets.
    [[nodiscard]] std::uint32_t meets(std::size_t row) const {
        return row < layers_met.size() ? layers_met[row] : ~0U;
    }
    void push_row(std::size_t row, const std::optional<Contact>& contact) {
        radius.push(radius_of(contact));
        rows += contact.has_value();
        set_meets(row, contact);
    }
    void set(std::size_t row, const std::optional<Contact>& contact) {
        rows -= radius[row] != no_contact;
        rows += contact.has_value();
        radius.set(row, radius_of(contact));
        set_meets(row, contact);
        wake(row);
        forget_clearings(row);
    }
    /// Removes `row`, to whose place row `last` moves.
    void swap_remove(std::size_t row, std::size_t last) {
        rows -= radius[row] != no_contact;
        radius.swap_remove(row);
        if (row < layers_met.size()) layers_met[row] = meets(last);
        if (last < layers_met.size()) layers_met.resize(last);
        if (row < settled.size()) settled[row] = last < settled.size() ? settled[last] : 0;
        if (last < settled.size()) settled.resize(last);
        set_crushed(row, is_crushed(last));
        if (last < crushed.size()) crushed.resize(last);
        for (const std::size_t one : {row, last}) forget_clearings(one);
    }
    void set_meets(std::size_t row, const std::optional<Contact>& contact) {
        const std::uint32_t to = contact ? contact->meets : ~0U;
        if (to == meets(row)) return;
        if (row >= layers_met.size()) layers_met.resize(row + 1, ~0U);
        layers_met[row] = to;
    }
    void forget_clearings(std::size_t row) {
        for (auto* const known : {&clearings, &area_clearings})
            if (row < known->size()) (*known)[row] = {};
    }
    [[nodiscard]] bool is_crushed(std::size_t row) const {
        return row < crushed.size() && crushed[row] != 0;
    }
    void set_crushed(std::size_t row, bool to) {
        if (row < crushed.size()) crushed[row] = to;
    }
    void wake(std::size_t row) {
        if (row < settled.size()) settled[row] = 0;
    }
    void wake_all() { settled.clear(); }

    /// Gathers the impacts of all parts of a call.
    void gather_impacts() {
        for (auto& of_part : impacts_of_parts) {
            impacts.insert(impacts.end(), of_part.begin(), of_part.end());
            of_part.clear();
        }
        std::sort(impacts.begin(), impacts.end());
    }
};

/// The numbers of one force for all rows, in the order of for_each_number.
template <class T>
using ForceColumns = std::vector<Parameter<T>>;

/// The Response of each row over one duration.
template <class T>
struct FlowColumns {
    Parameter<T> reach;
    Parameter<T> sway;
    Parameter<T> decay;
};

/// The exact flows of a plan, computed once for all its steps.
template <class T>
struct Flows {
    bool valid = false;
    std::vector<T> durations;        ///< s
    std::vector<FlowColumns<T>> of;  ///< per duration; empty without damping
    T half_step = 0;                 ///< s
    /// The numbers of prepare_damping over a half-step, per kind and force of that kind.
    std::array<std::vector<Parameter<T>>, force_count> damping_numbers;
};

/// The sums of all linear forces on each row, for scenes where several forces share a number.
template <class T, int Axes>
struct LinearSums {
    bool valid = false;
    std::array<Parameter<T>, Axes> constant;
    std::array<Parameter<T>, Axes> centre;
    Parameter<T> stiffness;
    Parameter<T> damping;
};

/// The data that steps of linked rows reuse in the next step.
template <class T, int Axes>
struct LinkCache {
    bool valid = false;  ///< false after a change of bodies, masses, forces or links
    PreparedLinks<T> links;
    PointLinks<T, Axes> point_links;
    bool holds_ropes = false;  ///< the prepared ropes have no damping, see HeldDamper
    std::vector<HeldDamper<T, Axes>> held;
    Stages<MotionColumns<T, Axes>> stages;  ///< scratch
    VecColumns<T, Axes> acceleration;       ///< m/s², scratch
    VecColumns<T, Axes> field;              ///< m/s², at the positions of the last kick
    MotionColumns<T, Axes> before;          ///< at the start of a step that may land
    bool field_valid = false;               ///< also false after a change of positions
    /// Solves the equations of implicit steps; kept while they are linear, else empty.
    std::function<std::vector<T>(const std::vector<T>&)> solve;
    T solver_tau = 0;  ///< s
};

/// The plan of the last step with a method of the list, and the kernels for it; most steps reuse
/// both.
template <class T, int Axes>
struct PlanCache {
    const Method* method = nullptr;
    Rate rate{};
    Damping damping = Damping::in_kick;
    Plan<T> plan = ExactPlan<T>{0};
    RowKernels<T, Axes> kernels{};
};

/// All bodies of a world. Numbers that every step needs are in separate columns from those that it
/// does not need (masses).
template <std::floating_point T, int Axes>
struct Columns {
    std::size_t size = 0;
    MotionColumns<T, Axes> motion;
    Parameter<double> mass;  ///< kg
    /// The number of forces of each kind is that of the body with the most.
    std::array<std::vector<ForceColumns<T>>, force_count> forces;
    Parameter<Kinds> kinds;  ///< per row: those with any number other than 0
    AppliedForces<T, Axes> applied;
    Contacts<T, Axes> contacts;
    std::vector<LinkRow<T>> links;
    std::vector<PointLinkRow<T, Axes>> point_links;
    /// The number of evaluations of the forces on the first row.
    std::int64_t evaluations = 0;
    PlanCache<T, Axes> plan_cache;
    /// Caches that are valid until the forces change.
    Flows<T> flows;
    LinearSums<T, Axes> linear_sums;
    RowViews<T, Axes> views;
    LinkCache<T, Axes> link_cache;

    [[nodiscard]] bool has_links() const { return !links.empty() || !point_links.empty(); }
    /// To be called after a change of bodies, masses, forces or links.
    void forces_changed() {
        views.valid = false;
        flows.valid = false;
        linear_sums.valid = false;
        link_cache.valid = false;
        state_changed();
    }
    void state_changed() { link_cache.field_valid = false; }
    void applied_changed() {
        views.valid = false;
        state_changed();
    }
    void forces_changed(std::size_t row) {
        contacts.wake(row);
        forces_changed();
    }
    void state_changed(std::size_t row) {
        contacts.wake(row);
        state_changed();
    }
};

/// The state of row `row` in the Number `V`.
template <Number V, std::floating_point T, int Axes>
[[nodiscard]] State<V, Axes> state_of(const Columns<T, Axes>& columns, std::size_t row) {
    return {{generate<Axes>([&](auto i) { return V(columns.motion.x[i][row]); })},
            {generate<Axes>([&](auto i) { return V(columns.motion.v[i][row]); })}};
}

/// The columns of one kind of force.
template <class Force, Number V, int Axes, std::floating_point T>
[[nodiscard]] const auto& stored(const Columns<T, Axes>& columns) {
    return columns.forces[kind_index<Force, V, Axes>];
}

/// A force per unit mass on row `row`.
template <class Force, Number V, std::floating_point T, int Axes>
[[nodiscard]] Force force_at(const Columns<T, Axes>& columns, std::size_t index, std::size_t row) {
    const auto& numbers = stored<Force, V>(columns)[index];
    Force force;
    std::size_t next = 0;
    for_each_number(force, [&](V& number) { number = V(numbers[next++][row]); });
    return force;
}

/// Calls f(force) for each force of row `row` in the Number `V`, also for those that are zero.
template <Number V, std::floating_point T, int Axes, class F>
void for_each_force(const Columns<T, Axes>& columns, std::size_t row, F f) {
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<V, Axes>>;
        for (std::size_t index = 0; index < stored<Force, V>(columns).size(); ++index)
            f(force_at<Force, V>(columns, index, row));
    });
}

}  // namespace oiler
