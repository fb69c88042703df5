// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"

namespace oiler {
namespace {

template <class T, int Axes>
Vec<T, Axes> narrow(const Vec3& given) {
    return {generate<Axes>([&](auto i) { return static_cast<T>(given.axis[i]); })};
}

template <class T, int Axes>
T narrow_field(const double& given, const T&) {
    return static_cast<T>(given);
}
template <class T, int Axes>
Vec<T, Axes> narrow_field(const Vec3& given, const Vec<T, Axes>&) {
    return narrow<T, Axes>(given);
}

/// The user's force per unit mass in the columns' precision and axes.
template <class To, class T, int Axes, class From>
To stored_form(const From& given, double mass) {
    const From specific = given.per_unit_mass(mass);
    To force;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        constexpr auto to = To::fields();
        constexpr auto from = From::fields();
        ((force.*std::get<I>(to) =
              narrow_field<T, Axes>(specific.*std::get<I>(from), force.*std::get<I>(to))),
         ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(To::fields())>>{});
    return force;
}

template <class Force, class T>
void make_present(ForceColumns<Force, T>& stored, std::size_t rows) {
    if (stored.present) return;
    stored.present = true;
    for (Parameter<T>& parameter : stored.numbers) parameter = Parameter<T>(T(0), rows);
}

/// A force's numbers for a new row: what everybody has, what was given, or nothing.
template <class Force, class T>
void push_force(ForceColumns<Force, T>& stored, const std::optional<Force>& given) {
    Force force = given.value_or(Force{});
    std::size_t next = 0;
    for_each_number(force, [&](T number) {
        Parameter<T>& parameter = stored.numbers[next++];
        parameter.push(Force::everywhere ? parameter.data()[0] : number);
    });
}

template <class Force, class T>
void set_force(ForceColumns<Force, T>& stored, std::size_t row, Force force) {
    std::size_t next = 0;
    for_each_number(force, [&](T number) { stored.numbers[next++].set(row, number); });
}

/// Calls f(the stored columns, the force in their form) for every kind of force; the latter is
/// empty where none is given.
template <class T, int Axes, class F>
void for_each_force(Columns<T, Axes>& columns, const GivenForces& forces, double mass, F f) {
    for_each_index<force_count>([&](auto i) {
        using Stored = std::tuple_element_t<i, ForceList<T, Axes>>;
        std::optional<Stored> stored_force;
        if (const auto& given = std::get<i>(forces))
            stored_force = stored_form<Stored, T, Axes>(*given, mass);
        f(std::get<i>(columns.forces), stored_force);
    });
}

template <class T, std::size_t Axes>
Vec3 widen(const std::array<Column<T>, Axes>& columns, std::size_t row) {
    Vec3 out{};
    for (std::size_t i = 0; i < Axes; ++i) out.axis[i] = static_cast<double>(columns[i][row]);
    return out;
}

template <class T, std::size_t Axes>
void push(std::array<Column<T>, Axes>& columns, const Vec3& value) {
    const auto narrowed = narrow<T, int{Axes}>(value);
    for (std::size_t i = 0; i < Axes; ++i) columns[i].push(narrowed.axis[i]);
}

template <class T, std::size_t Axes>
void assign(std::array<Column<T>, Axes>& columns, std::size_t row, const Vec3& value) {
    const auto narrowed = narrow<T, int{Axes}>(value);
    for (std::size_t i = 0; i < Axes; ++i) columns[i][row] = narrowed.axis[i];
}

}  // namespace

Bodies::Bodies(int axes, Precision precision) {
    require(axes >= 1 && axes <= 3, "a world has 1, 2 or 3 axes");
    if (precision == Precision::single) {
        if (axes == 1) columns_.emplace<Columns<float, 1>>();
        if (axes == 2) columns_.emplace<Columns<float, 2>>();
        if (axes == 3) columns_.emplace<Columns<float, 3>>();
    } else {
        if (axes == 1) columns_.emplace<Columns<double, 1>>();
        if (axes == 2) columns_.emplace<Columns<double, 2>>();
        if (axes == 3) columns_.emplace<Columns<double, 3>>();
    }
}

int Bodies::axes() const { return static_cast<int>(columns_.index() % 3) + 1; }

Precision Bodies::precision() const {
    return columns_.index() < 3 ? Precision::single : Precision::double_;
}

void Bodies::require_row(std::size_t row) const {
    require(row < size(), "there is no body in this row");
}

std::size_t Bodies::size() const {
    return std::visit([](const auto& columns) { return columns.size; }, columns_);
}

std::size_t Bodies::add_given(const Body& body, const GivenForces& forces) {
    const Limits limits(precision(), axes());
    limits.check(body);
    limits.check(forces, body.mass);
    return std::visit(
        [&](auto& columns) {
            const std::size_t row = columns.size;
            for_each_force(columns, forces, body.mass, [&](auto& stored, const auto& force) {
                if (force) make_present(stored, row);
                if (stored.present) push_force(stored, force);
            });
            push(columns.position, body.position);
            push(columns.velocity, body.velocity);
            columns.mass.push(body.mass);
            return columns.size++;
        },
        columns_);
}

void Bodies::attach_given(std::size_t row, const GivenForces& forces) {
    Limits(precision(), axes()).check(forces, mass(row));
    std::visit(
        [&](auto& columns) {
            for_each_force(columns, forces, columns.mass[row],
                           [&](auto& stored, const auto& force) {
                               if (!force) return;
                               make_present(stored, columns.size);
                               set_force(stored, row, *force);
                           });
        },
        columns_);
}

void Bodies::remove(std::size_t row) {
    require_row(row);
    std::visit(
        [&](auto& columns) {
            for (auto& column : columns.position) column.swap_remove(row);
            for (auto& column : columns.velocity) column.swap_remove(row);
            columns.mass.swap_remove(row);
            const auto remove_from = [&](auto& stored) {
                if (stored.present)
                    for (auto& parameter : stored.numbers) parameter.swap_remove(row);
            };
            std::apply([&](auto&... stored) { (remove_from(stored), ...); }, columns.forces);
            --columns.size;
        },
        columns_);
}

void Bodies::set_gravity(const Vec3& acceleration) {
    Limits(precision(), axes()).check(acceleration, "gravity");
    std::visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) {
            auto& stored = std::get<ForceColumns<GravityForce<T, Axes>, T>>(columns.forces);
            stored.present = true;
            const Vec<T, Axes> g = narrow<T, Axes>(acceleration);
            for (std::size_t i = 0; i < Axes; ++i)
                stored.numbers[i] = Parameter<T>(g.axis[i], columns.size);
        },
        columns_);
}

double Bodies::mass(std::size_t row) const {
    require_row(row);
    return std::visit([&](const auto& columns) { return columns.mass[row]; }, columns_);
}

Vec3 Bodies::position(std::size_t row) const {
    require_row(row);
    return std::visit([&](const auto& columns) { return widen(columns.position, row); }, columns_);
}

Vec3 Bodies::velocity(std::size_t row) const {
    require_row(row);
    return std::visit([&](const auto& columns) { return widen(columns.velocity, row); }, columns_);
}

void Bodies::set_position(std::size_t row, const Vec3& position) {
    require_row(row);
    Limits(precision(), axes()).check(position, "a position");
    std::visit([&](auto& columns) { assign(columns.position, row, position); }, columns_);
}

void Bodies::set_velocity(std::size_t row, const Vec3& velocity) {
    require_row(row);
    Limits(precision(), axes()).check(velocity, "a velocity");
    std::visit([&](auto& columns) { assign(columns.velocity, row, velocity); }, columns_);
}

void Bodies::step(const Method& method, const Steps& steps) {
    if (const auto at = try_step(method, steps)) fail_diverged(*at, at->row, steps.rate, method);
}

std::optional<Divergence> Bodies::try_step(const Method& method, const Steps& steps) {
    return std::visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) {
            return step_rows(columns, make_plan<T>(method, steps.rate.dt<T>()), steps);
        },
        columns_);
}

void fail_diverged(const Divergence& at, std::size_t body, const Rate& rate, const Method& method) {
    fail(Exit::diverged,
         "diverged at step {} (t = {} s): {} {} of body {} is no longer finite; "
         "take a higher rate, or another method than {}",
         at.tick, rate.time(at.tick), at.velocity ? "velocity" : "position",
         axis_names[static_cast<std::size_t>(at.axis)], body, method.name);
}

Energy Bodies::energy() const {
    constexpr std::size_t lanes = 8;
    std::array<double, lanes> kinetic{};
    std::array<double, lanes> potential{};
    std::visit(
        [&](const auto& columns) {
            for (std::size_t row = 0; row < columns.size; ++row) {
                const auto state = state_of<double>(columns, row);
                const double mass = columns.mass[row];
                kinetic[row % lanes] += 0.5 * mass * squared_length(state.v);
                potential[row % lanes] += mass * forces_of<double>(columns, row).potential(state);
            }
        },
        columns_);
    Energy sum;
    for (std::size_t i = 0; i < lanes; ++i) {
        sum.kinetic += kinetic[i];
        sum.potential += potential[i];
    }
    return sum;
}

void Bodies::hash_into(StateHash& hash) const {
    std::visit(
        [&]<class T, int Axes>(const Columns<T, Axes>& columns) {
            hash.add(columns.size);
            hash.add(static_cast<std::uint64_t>(Axes));
            hash.add(static_cast<std::uint64_t>(sizeof(T)));
            for (const auto& column : columns.position)
                hash.add(std::span<const T>(column.data(), columns.size));
            for (const auto& column : columns.velocity)
                hash.add(std::span<const T>(column.data(), columns.size));
        },
        columns_);
}

}  // namespace oiler
