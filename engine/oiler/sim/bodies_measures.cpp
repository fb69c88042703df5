// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/links/link_force.hpp"

namespace oiler {
namespace {

template <class T>
Stored storage_of(std::string_view name, std::size_t index,
                  const std::vector<Parameter<T>>& numbers, std::size_t rows) {
    Stored stored{.of = name, .index = index};
    for (const Parameter<T>& number : numbers) {
        stored.shared.push_back(number.shared());
        if (!number.shared()) stored.bytes += sizeof(T);
    }
    for (std::size_t row = 0; row < rows; ++row)
        stored.rows += std::any_of(numbers.begin(), numbers.end(),
                                   [&](const auto& number) { return number[row] != 0; });
    return stored;
}

template <class T>
void hash_column(const Column<T>& column, StateHash& hash) {
    hash.add(std::span<const T>(column.data(), column.size()));
}
/// Hashes a long double as two doubles, because it has padding bytes.
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
    return columns_->visit([&](const auto& columns) {
        const auto state = state_of<long double>(columns, row);
        return State<long double, 3>{converted<Vec<long double, 3>>(state.x),
                                     converted<Vec<long double, 3>>(state.v)};
    });
}

GivenForces Bodies::forces_per_mass(std::size_t row, std::size_t index) const {
    require_row(row);
    return columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        GivenForces given;
        for_each_index<force_count>([&](auto i) {
            using Force = std::tuple_element_t<i, ForceList<double, Axes>>;
            using Given = typename std::tuple_element_t<i, GivenForces>::value_type;
            if (index < columns.forces[i].size())
                std::get<i>(given) =
                    converted_force<Given>(force_at<Force, double>(columns, index, row));
        });
        return given;
    });
}

std::size_t Bodies::most_forces_of_a_kind() const {
    return columns_->visit([](const auto& columns) {
        std::size_t most = 0;
        for (const auto& stored : columns.forces) most = std::max(most, stored.size());
        return most;
    });
}

double Bodies::link_potential(std::size_t i) const {
    const Link link = link_at(i);
    const LinkEnds ends = link_ends(i);
    return columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        State<double, Axes> between = state_of<double>(columns, ends.row);
        if (ends.other) {
            between.x -= state_of<double>(columns, *ends.other).x;
        } else {
            for (std::size_t axis = 0; axis < Axes; ++axis)
                between.x.axis[axis] -= ends.point.axis[axis];
        }
        return LinkForce<double, Axes>(link).potential(between);
    });
}

std::vector<Stored> Bodies::stored() const {
    return columns_->visit([]<class T, int Axes>(const Columns<T, Axes>& columns) {
        const std::vector<bool> not_shared(Axes, false);
        std::vector<Stored> all;
        for (const std::string_view name : {"position", "velocity"})
            all.push_back({name, 0, not_shared, Axes * sizeof(T), columns.size});
        all.push_back(storage_of("mass", 0, std::vector{columns.mass}, columns.size));
        if (columns.contacts.rows > 0) {
            all.push_back(
                storage_of("contact", 0, std::vector{columns.contacts.radius}, columns.size));
            all.back().rows = columns.contacts.rows;
        }
        for_each_index<force_count>([&](auto i) {
            using Force = std::tuple_element_t<i, ForceList<T, Axes>>;
            for (std::size_t index = 0; index < columns.forces[i].size(); ++index)
                all.push_back(
                    storage_of(Force::name, index, columns.forces[i][index], columns.size));
        });
        return all;
    });
}

std::size_t Bodies::bytes_of_links() const {
    const auto bytes = []<class Row>(const std::vector<Row>& links) {
        return links.size() * sizeof(Row);
    };
    return columns_->visit(
        [&](const auto& columns) { return bytes(columns.links) + bytes(columns.point_links); });
}

Deviation Bodies::deviation_from(const Bodies& other) const {
    require(size() == other.size() && columns_->of.index() == other.columns_->of.index(),
            "compared bodies have the same number, precision and axes");
    return columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        const auto& others = std::get<Columns<T, Axes>>(other.columns_->of);
        Deviation largest;
        for (std::size_t row = 0; row < columns.size; ++row) {
            Vec3 d{};
            for (std::size_t i = 0; i < Axes; ++i) {
                d.axis[i] = static_cast<double>(
                    std::abs(columns.motion.x[i][row] - others.motion.x[i][row]));
                largest.along.axis[i] = larger(largest.along.axis[i], d.axis[i]);
            }
            // hypot, because the square of a small difference underflows to 0.
            largest.distance = larger(largest.distance, std::hypot(d[0], d[1], d[2]));
        }
        return largest;
    });
}

std::int64_t Bodies::evaluations() const {
    return columns_->visit([](const auto& columns) { return columns.evaluations; });
}

Energy Bodies::energy() const {
    constexpr std::size_t lanes = 8;
    std::array<double, lanes> kinetic{};
    std::array<double, lanes> potential{};
    columns_->visit([&](const auto& columns) {
        for (std::size_t row = 0; row < columns.size; ++row) {
            const auto state = state_of<double>(columns, row);
            const double mass = columns.mass[row];
            kinetic[row % lanes] += 0.5 * mass * squared_length(state.v);
            double specific = 0;
            for_each_force<double>(columns, row, [&](const auto& force) {
                specific += oiler::potential(force, state);
            });
            potential[row % lanes] += mass * specific;
        }
    });
    for (std::size_t i = 0; i < link_count(); ++i) potential[i % lanes] += link_potential(i);
    Energy sum;
    for (std::size_t i = 0; i < lanes; ++i) {
        sum.kinetic += kinetic[i];
        sum.potential += potential[i];
    }
    return sum;
}

void Bodies::hash_into(StateHash& hash) const {
    columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        hash.add(columns.size);
        hash.add(static_cast<std::uint64_t>(Axes));
        hash.add(static_cast<std::uint64_t>(sizeof(T)));
        for (const auto* vector : {&columns.motion.x, &columns.motion.v})
            for (const Column<T>& column : *vector) hash_column(column, hash);
        columns.contacts.obstacles.hash_into(hash);
        columns.contacts.areas.hash_into(hash);
        for (std::size_t row = 0; row < columns.size; ++row)
            if (columns.contacts.is_crushed(row)) hash.add(row);
        if (columns.applied.empty()) return;
        for (const Column<T>& column : columns.applied.acceleration) hash_column(column, hash);
    });
}

}  // namespace oiler
