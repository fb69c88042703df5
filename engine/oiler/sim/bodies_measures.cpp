// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"
#include "oiler/sim/link_force.hpp"

namespace oiler {
namespace {

template <class V, class T, int Axes>
Vec<V, 3> to_three(const Vec<T, Axes>& vector) {
    Vec<V, 3> three{};
    for (std::size_t i = 0; i < Axes; ++i) three.axis[i] = static_cast<V>(vector.axis[i]);
    return three;
}

template <int Axes>
double to_double(double number) {
    return number;
}
template <int Axes>
Vec3 to_double(const Vec<double, Axes>& vector) {
    return to_three<double>(vector);
}

/// With three axes, as a user gives it.
template <class To, int Axes, class From>
To given_form(const From& from) {
    To to;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((to.*std::get<I>(To::fields()) = to_double<Axes>(from.*std::get<I>(From::fields()))), ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(To::fields())>>{});
    return to;
}

template <class T>
void hash_column(const Column<T>& column, StateHash& hash) {
    hash.add(std::span<const T>(column.data(), column.size()));
}
/// Its numbers have bytes that mean nothing.
void hash_column(const Column<long double>& column, StateHash& hash) {
    for (std::size_t row = 0; row < column.size(); ++row) {
        const auto high = static_cast<double>(column[row]);
        const std::array parts{high, static_cast<double>(column[row] - high)};
        hash.add(std::span<const double>(parts));
    }
}

}  // namespace

State<long double, 3> Bodies::state(std::size_t row) const {
    require_row(row);
    return std::visit(
        [&](const auto& columns) {
            const auto state = state_of<long double>(columns, row);
            return State<long double, 3>{to_three<long double>(state.x),
                                         to_three<long double>(state.v)};
        },
        columns_);
}

GivenForces Bodies::forces_per_mass(std::size_t row, std::size_t nth) const {
    require_row(row);
    return std::visit(
        [&]<class T, int Axes>(const Columns<T, Axes>& columns) {
            const ForcesOfRow<double, T, Axes> forces(columns, row);
            GivenForces given;
            for_each_index<force_count>([&](auto i) {
                using Force = std::tuple_element_t<i, ForceList<double, Axes>>;
                using Given = typename std::tuple_element_t<i, GivenForces>::value_type;
                if (nth < forces.template count<Force>())
                    std::get<i>(given) = given_form<Given, Axes>(forces.template get<Force>(nth));
            });
            return given;
        },
        columns_);
}

std::size_t Bodies::most_of_a_kind() const {
    return std::visit(
        [](const auto& columns) {
            return std::apply([](const auto&... stored) { return std::max({stored.size()...}); },
                              columns.forces);
        },
        columns_);
}

double Bodies::link_potential(std::size_t i) const {
    return std::visit(
        [&]<class T, int Axes>(const Columns<T, Axes>& columns) {
            const LinkRow<T>& stored = columns.links[i];
            const LinkRow<double> link{stored.a, stored.b, static_cast<double>(stored.stiffness),
                                       static_cast<double>(stored.damping),
                                       static_cast<double>(stored.rest_length)};
            const auto a = state_of<double>(columns, link.a);
            const auto b = state_of<double>(columns, link.b);
            return LinkForce<double, Axes>(link).potential({a.x - b.x, a.v - b.v});
        },
        columns_);
}

std::int64_t Bodies::evaluations() const {
    return std::visit([](const auto& columns) { return columns.evaluations; }, columns_);
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
    for (std::size_t i = 0; i < link_count(); ++i) potential[i % lanes] += link_potential(i);
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
            for (const auto* vector : {&columns.motion.x, &columns.motion.v})
                for (const Column<T>& column : *vector) hash_column(column, hash);
        },
        columns_);
}

}  // namespace oiler
