// SPDX-License-Identifier: MIT
#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/limits.hpp"

namespace oiler {
namespace {

template <class T, int Axes>
PlaneOf<T, Axes> unit_plane(const Plane& given) {
    const double size = length(given.normal);
    PlaneOf<T, Axes> plane;
    for (std::size_t i = 0; i < Axes; ++i)
        plane.normal.axis[i] = static_cast<T>(given.normal.axis[i] / size);
    plane.offset = static_cast<T>(given.offset / size);
    plane.restitution = static_cast<T>(given.restitution);
    plane.friction = static_cast<T>(given.friction);
    return plane;
}

}  // namespace

std::size_t Bodies::add_plane(const Plane& plane) {
    Limits(precision(), axes()).check(plane);
    require(planes_.size() < most_planes, "a world has at most 32 planes");
    std::visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) {
            columns.contacts.planes.push_back(unit_plane<T, Axes>(plane));
            columns.contacts.wake_all();
        },
        columns_->of);
    planes_.push_back(plane);
    return planes_.size() - 1;
}

void Bodies::clear_planes() {
    std::visit(
        [](auto& columns) {
            columns.contacts.planes.clear();
            columns.contacts.wake_all();
        },
        columns_->of);
    planes_.clear();
}

void Bodies::set_contact(std::size_t row, const std::optional<Contact>& contact) {
    require_row(row);
    if (contact) Limits(precision(), axes()).check(*contact);
    std::visit(
        [&](auto& columns) { columns.contacts.set(row, columns.contacts.radius_of(contact)); },
        columns_->of);
}

std::optional<Contact> Bodies::contact(std::size_t row) const {
    require_row(row);
    return std::visit(
        [&](const auto& columns) -> std::optional<Contact> {
            const auto radius = columns.contacts.radius[row];
            if (radius == columns.contacts.no_contact) return std::nullopt;
            return Contact{static_cast<double>(radius)};
        },
        columns_->of);
}

std::size_t Bodies::impact_count() const {
    return std::visit([](const auto& columns) { return columns.contacts.impacts.size(); },
                      columns_->of);
}

BodyImpact Bodies::impact_at(std::size_t i, const Rate& rate) const {
    require(i < impact_count(), "there are fewer impacts");
    return std::visit(
        [&](const auto& columns) {
            const auto& [tick, row, index, impact] = columns.contacts.impacts[i];
            const auto radius = columns.contacts.radius[row];
            return BodyImpact{
                impact.kind,
                row,
                impact.plane,
                rate.time(tick) + static_cast<double>(impact.after_start),
                widen<double>(impact.x - columns.contacts.planes[impact.plane].normal * radius),
                widen<double>(impact.before),
                widen<double>(impact.after)};
        },
        columns_->of);
}

}  // namespace oiler
