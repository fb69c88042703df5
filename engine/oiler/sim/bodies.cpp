// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <type_traits>

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/limits.hpp"

namespace oiler {
namespace {

constexpr const char* no_row = "there is no body in this row";

/// The kinds of force that all rows share.
constexpr Kinds kinds_everywhere = [] {
    Kinds kinds = 0;
    for_each_index<force_count>([&](auto i) {
        if (std::tuple_element_t<i, ForceList<double, 3>>::everywhere)
            kinds = static_cast<Kinds>(kinds | 1U << i);
    });
    return kinds;
}();

/// The limits of columns, ready before a body is added.
template <class T, int Axes>
constexpr Limits limits_of(std::is_same_v<T, float> ? Precision::single : Precision::double_, Axes);

/// Adds columns up to `count` forces of a kind; new forces are zero for all rows.
template <class T>
void make_room(std::vector<ForceColumns<T>>& stored, std::size_t count, std::size_t numbers,
               std::size_t rows) {
    while (stored.size() < count) stored.emplace_back(numbers, Parameter<T>(0, rows));
}

/// Adds the numbers of a new row to all forces of a kind: those that all rows share; else the given
/// ones to the first force and zeros to the others. Returns whether any given number is not 0.
template <class T>
bool push_row(std::vector<ForceColumns<T>>& stored, std::span<const T> given, bool everywhere) {
    for (std::size_t index = 0; index < stored.size(); ++index)
        for (std::size_t i = 0; i < given.size(); ++i) {
            Parameter<T>& number = stored[index][i];
            number.push(everywhere ? number[0] : index == 0 ? given[i] : T(0));
        }
    return !everywhere && std::ranges::any_of(given, [](T number) { return number != 0; });
}

/// The kinds of force of which row `row` has any number other than 0, but for those that all rows
/// share.
template <class T, int Axes>
Kinds kinds_of_row(const Columns<T, Axes>& columns, std::size_t row) {
    Kinds kinds = 0;
    for (std::size_t kind = 0; kind < force_count; ++kind)
        for (const ForceColumns<T>& numbers : columns.forces[kind])
            for (const Parameter<T>& number : numbers)
                if (number[row] != 0) kinds = static_cast<Kinds>(kinds | 1U << kind);
    return static_cast<Kinds>(kinds & ~kinds_everywhere);
}

/// Calls f(kind, whether the force is given, numbers) for every kind of force. numbers() are per
/// unit mass and in the order of the columns; zeros if no force is given.
template <class T, int Axes, class F>
void for_each_kind(const GivenForces& forces, double mass, F f) {
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<T, Axes>>;
        const auto& given = std::get<kind>(forces);
        f(std::size_t{kind}, given.has_value(), [&] {
            std::array<T, number_count<Force>()> numbers{};
            if (!given) return numbers;
            auto force = converted_force<Force>(given->per_unit_mass(mass));
            std::size_t next = 0;
            for_each_number(force, [&](T number) { numbers[next++] = number; });
            return numbers;
        });
    });
}

template <class T, std::size_t Axes>
Vec3 vector_of(const std::array<Column<T>, Axes>& columns, std::size_t row) {
    return converted<Vec3>(load<T>(columns, row));
}

template <class T, std::size_t Axes>
void push(std::array<Column<T>, Axes>& columns, const Vec3& value) {
    for_each_index<Axes>([&](auto i) { columns[i].push(static_cast<T>(value.axis[i])); });
}

template <class T, std::size_t Axes, class V>
void assign(std::array<Column<T>, Axes>& columns, std::size_t row, const Vec<V, 3>& value) {
    for (std::size_t i = 0; i < Axes; ++i) columns[i][row] = static_cast<T>(value.axis[i]);
}

/// Removes the links of `row`, to which row `last` has moved. Calls f(link) for each of them first.
template <class Row, class F>
void remove_links(std::vector<Row>& links, std::size_t row, std::size_t last, F f) {
    std::erase_if(links, [&](Row& link) {
        bool gone = false;
        link.for_each_row([&](std::uint32_t end) { gone = gone || end == row; });
        if (gone) f(link);
        return gone;
    });
    for (Row& link : links)
        link.for_each_row([&](std::uint32_t& end) {
            if (end == last) end = static_cast<std::uint32_t>(row);
        });
}

/// Drops the columns of a kind of force that no row has any more.
template <class T, int Axes>
void drop_if_unused(Columns<T, Axes>& columns, std::size_t kind) {
    if (columns.forces[kind].empty()) return;
    for (std::size_t row = 0; row < (columns.kinds.shared() ? 1 : columns.size); ++row)
        if (columns.kinds[row] >> kind & 1U) return;
    columns.forces[kind].clear();
}

}  // namespace

Bodies::Bodies(int axes, Precision precision) : columns_(std::make_unique<AnyColumns>()) {
    require(axes >= 1 && axes <= 3, "a world has 1, 2 or 3 axes");
    const auto choose = [&]<class T>(T) {
        if (axes == 1) columns_->of.emplace<Columns<T, 1>>();
        if (axes == 2) columns_->of.emplace<Columns<T, 2>>();
        if (axes == 3) columns_->of.emplace<Columns<T, 3>>();
    };
    if (precision == Precision::single) choose(float{});
    if (precision == Precision::double_) choose(double{});
    if (precision == Precision::extended) choose(0.0L);
}

Bodies::Bodies(const Bodies& other)
    : columns_(std::make_unique<AnyColumns>(*other.columns_)),
      team_(other.team_),
      link_slots_(other.link_slots_),
      obstacles_(other.obstacles_),
      obstacle_slots_(other.obstacle_slots_) {}
Bodies::Bodies(Bodies&&) noexcept = default;
Bodies& Bodies::operator=(const Bodies& other) {
    *columns_ = *other.columns_;
    team_ = other.team_;
    link_slots_ = other.link_slots_;
    obstacles_ = other.obstacles_;
    obstacle_slots_ = other.obstacle_slots_;
    return *this;
}
Bodies& Bodies::operator=(Bodies&&) noexcept = default;
Bodies::~Bodies() = default;

int Bodies::axes() const { return static_cast<int>(columns_->of.index() % 3) + 1; }

Precision Bodies::precision() const { return static_cast<Precision>(columns_->of.index() / 3); }

void Bodies::require_row(std::size_t row) const { require(row < size(), no_row); }

std::size_t Bodies::size() const {
    return columns_->visit([](const auto& columns) { return columns.size; });
}

void Bodies::reserve(std::size_t rows) {
    columns_->visit([&](auto& columns) {
        for (auto& column : columns.motion.x) column.reserve(rows);
        for (auto& column : columns.motion.v) column.reserve(rows);
        columns.views.valid = false;
    });
}

std::size_t Bodies::add(const Body& body, const GivenForces& forces) {
    return columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        limits_of<T, Axes>.check(body);
        limits_of<T, Axes>.check(forces, body.mass);
        Kinds kinds = 0;
        for_each_kind<T, Axes>(
            forces, body.mass,
            [&](std::size_t kind, bool is_given, auto numbers_of_force)
                __attribute__((always_inline)) {
                    std::vector<ForceColumns<T>>& stored = columns.forces[kind];
                    if (!is_given && stored.empty()) return;
                    const auto numbers = numbers_of_force();
                    if (is_given) make_room(stored, 1, numbers.size(), columns.size);
                    if (push_row<T>(stored, numbers, kinds_everywhere >> kind & 1U))
                        kinds = static_cast<Kinds>(kinds | 1U << kind);
                });
        push(columns.motion.x, body.position);
        push(columns.motion.v, body.velocity);
        columns.mass.push(body.mass);
        columns.kinds.push(kinds);
        columns.applied.push_row();
        columns.contacts.push_row(columns.size, body.contact);
        columns.forces_changed();
        return columns.size++;
    });
}

void Bodies::attach_at(std::size_t index, std::size_t row, const GivenForces& forces) {
    Limits(precision(), axes()).check(forces, mass(row));
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        for_each_kind<T, Axes>(
            forces, columns.mass[row], [&](std::size_t kind, bool is_given, auto numbers_of_force) {
                if (!is_given) return;
                const auto numbers = numbers_of_force();
                make_room(columns.forces[kind], index + 1, numbers.size(), columns.size);
                for (std::size_t i = 0; i < numbers.size(); ++i)
                    columns.forces[kind][index][i].set(row, numbers[i]);
            });
        columns.kinds.set(row, kinds_of_row(columns, row));
        columns.forces_changed(row);
    });
}

void Bodies::detach_kind(std::size_t row, std::size_t kind) {
    require_row(row);
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        for (ForceColumns<T>& numbers : columns.forces[kind])
            for (Parameter<T>& number : numbers) number.set(row, 0);
        columns.kinds.set(row, kinds_of_row(columns, row));
        drop_if_unused(columns, kind);
        columns.forces_changed(row);
    });
}

void Bodies::remove(std::size_t row) {
    columns_->visit([&](auto& columns) {
        require(row < columns.size, no_row);
        for (auto& column : columns.motion.x) column.swap_remove(row);
        for (auto& column : columns.motion.v) column.swap_remove(row);
        columns.mass.swap_remove(row);
        columns.kinds.swap_remove(row);
        for (auto& stored : columns.forces)
            for (auto& numbers : stored)
                for (auto& number : numbers) number.swap_remove(row);
        columns.applied.swap_remove(row, --columns.size);
        columns.contacts.swap_remove(row, columns.size);
        if (columns.has_links()) {
            const auto release = [&](const auto& link) { link_slots_.release(link.slot); };
            remove_links(columns.links, row, columns.size, release);
            remove_links(columns.point_links, row, columns.size, release);
        }
        columns.forces_changed();
    });
}

void Bodies::set_gravity(const Vec3& acceleration) {
    Limits(precision(), axes()).check(acceleration, "gravity");
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        auto& stored = columns.forces[kind_index<GravityForce<T, Axes>, T, Axes>];
        make_room(stored, 1, Axes, columns.size);
        const Vec<T, Axes> g = converted<Vec<T, Axes>>(acceleration);
        for (std::size_t i = 0; i < Axes; ++i) stored[0][i] = {g.axis[i], columns.size};
        columns.contacts.wake_all();
        columns.forces_changed();
    });
}

double Bodies::mass(std::size_t row) const {
    require_row(row);
    return columns_->visit([&](const auto& columns) { return columns.mass[row]; });
}

Vec3 Bodies::position(std::size_t row) const {
    require_row(row);
    return columns_->visit([&](const auto& columns) { return vector_of(columns.motion.x, row); });
}

Vec3 Bodies::velocity(std::size_t row) const {
    require_row(row);
    return columns_->visit([&](const auto& columns) { return vector_of(columns.motion.v, row); });
}

void Bodies::set_state(std::size_t row, const State<long double, 3>& state) {
    require_row(row);
    const Limits limits(precision(), axes());
    limits.check(converted<Vec3>(state.x), "a position");
    limits.check(converted<Vec3>(state.v), "a velocity");
    columns_->visit([&](auto& columns) {
        assign(columns.motion.x, row, state.x);
        assign(columns.motion.v, row, state.v);
        columns.state_changed(row);
    });
}

void Bodies::set_position(std::size_t row, const Vec3& position) {
    require_row(row);
    Limits(precision(), axes()).check(position, "a position");
    columns_->visit([&](auto& columns) {
        assign(columns.motion.x, row, position);
        columns.contacts.set_crushed(row, false);
        columns.state_changed(row);
    });
}

void Bodies::set_velocity(std::size_t row, const Vec3& velocity) {
    require_row(row);
    Limits(precision(), axes()).check(velocity, "a velocity");
    columns_->visit([&](auto& columns) {
        assign(columns.motion.v, row, velocity);
        columns.state_changed(row);
    });
}

void Bodies::apply_force(std::size_t row, const Vec3& force) {
    const Limits limits(precision(), axes());
    limits.check(force, "a force");
    const Vec3 acceleration = force / mass(row);
    limits.check(acceleration, "the acceleration by a force");
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        const Vec<T, Axes> change = converted<Vec<T, Axes>>(acceleration);
        for (const T one : (columns.applied.sum(row) + change).axis)
            limits.check(static_cast<double>(one), "the sum of the forces on a body");
        columns.applied.add(row, change, columns.size);
        columns.contacts.wake(row);
        columns.applied_changed();
    });
}

void Bodies::forget_forces() {
    columns_->visit([](auto& columns) {
        if (columns.applied.empty()) return;
        columns.applied.clear();
        columns.applied_changed();
    });
}

void Bodies::apply_impulse(std::size_t row, const Vec3& impulse) {
    Limits(precision(), axes()).check(impulse, "an impulse");
    set_velocity(row, velocity(row) + impulse / mass(row));
}

void Bodies::set_contact(std::size_t row, const std::optional<Contact>& contact) {
    require_row(row);
    if (contact) Limits(precision(), axes()).check(*contact);
    columns_->visit([&](auto& columns) { columns.contacts.set(row, contact); });
}

std::optional<Contact> Bodies::contact(std::size_t row) const {
    require_row(row);
    return columns_->visit([&](const auto& columns) -> std::optional<Contact> {
        const auto radius = columns.contacts.radius[row];
        if (radius == columns.contacts.no_contact) return std::nullopt;
        return Contact{static_cast<double>(radius), columns.contacts.meets(row)};
    });
}

}  // namespace oiler
