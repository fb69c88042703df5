// SPDX-License-Identifier: MIT
#include <algorithm>

#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/limits.hpp"
#include "oiler/sim/links/point_links.hpp"
#include "oiler/sim/store/links.hpp"

namespace oiler {
namespace {

/// Calls f(link) for the link of that index: a LinkRow, or a PointLinkRow.
template <class T, int Axes, class F>
auto with_link(const Columns<T, Axes>& columns, std::size_t i, F f) {
    const std::size_t between_rows = columns.links.size();
    return i < between_rows ? f(columns.links[i]) : f(columns.point_links[i - between_rows]);
}

template <class T>
LinkEnds ends_of(const LinkRow<T>& link) {
    return {link.a, link.b};
}
template <class T, int Axes>
LinkEnds ends_of(const PointLinkRow<T, Axes>& link) {
    return {link.row, std::nullopt, converted<Vec3>(link.point)};
}

template <class Row>
Link to_link(const Row& link) {
    return {static_cast<double>(link.stiffness), static_cast<double>(link.damping),
            static_cast<double>(link.rest_length), link.pulls_only};
}

/// The indices of links to points in the order of their dampers.
template <class T, int Axes>
std::vector<std::size_t> damping_order_of(std::vector<PointLinkRow<T, Axes>> links) {
    for (std::size_t i = 0; i < links.size(); ++i) links[i].slot = static_cast<std::uint32_t>(i);
    sort_point_links(links);
    std::vector<std::size_t> order;
    for (const PointLinkRow<T, Axes>& link : links) order.push_back(link.slot);
    return order;
}

}  // namespace

LinkHandle Bodies::link(std::size_t a, std::size_t b, const Link& link) {
    require_linkable(a, link);
    require_linkable(b, link);
    require(a != b, "a link is between two bodies");
    const LinkHandle handle = link_slots_.take<LinkHandle>();
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        columns.links.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                 handle.slot, static_cast<T>(link.stiffness),
                                 static_cast<T>(link.damping), static_cast<T>(link.rest_length),
                                 link.pulls_only});
        columns.forces_changed();
    });
    return handle;
}

LinkHandle Bodies::link_to_point(std::size_t row, const Vec3& point, const Link& link) {
    require_linkable(row, link);
    Limits(precision(), axes()).check(point, "the point of a link");
    const LinkHandle handle = link_slots_.take<LinkHandle>();
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        columns.point_links.push_back({static_cast<std::uint32_t>(row), handle.slot,
                                       static_cast<T>(link.stiffness), static_cast<T>(link.damping),
                                       static_cast<T>(link.rest_length), link.pulls_only,
                                       converted<Vec<T, Axes>>(point)});
        columns.forces_changed();
    });
    return handle;
}

void Bodies::move_point(LinkHandle link, const Vec3& point) {
    require(alive(link), "the link is gone");
    Limits(precision(), axes()).check(point, "the point of a link");
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        auto& links = columns.point_links;
        const auto found = std::ranges::find(links, link.slot, &PointLinkRow<T, Axes>::slot);
        require(found != links.end(), "the link is between two bodies and has no point");
        found->point = converted<Vec<T, Axes>>(point);
        columns.forces_changed();
    });
}

void Bodies::require_linkable(std::size_t row, const Link& link) const {
    require_row(row);
    const Limits limits(precision(), axes());
    limits.check(link);
    limits.check(1 / mass(row), "the inverse mass of a linked body");
}

bool Bodies::alive(LinkHandle link) const { return link_slots_.holds(link.slot, link.generation); }

void Bodies::unlink(LinkHandle link) {
    require(alive(link), "the link is gone");
    const auto is_it = [&](const auto& stored) { return stored.slot == link.slot; };
    columns_->visit([&](auto& columns) {
        if (std::erase_if(columns.links, is_it) == 0) std::erase_if(columns.point_links, is_it);
        columns.forces_changed();
    });
    link_slots_.release(link.slot);
}

Link Bodies::link(LinkHandle link) const {
    require(alive(link), "the link is gone");
    const auto is_it = [&](const auto& stored) { return stored.slot == link.slot; };
    return columns_->visit([&](const auto& columns) {
        const auto found = std::ranges::find_if(columns.links, is_it);
        return found != columns.links.end()
                   ? to_link(*found)
                   : to_link(*std::ranges::find_if(columns.point_links, is_it));
    });
}

std::size_t Bodies::link_count() const {
    return columns_->visit(
        [](const auto& columns) { return columns.links.size() + columns.point_links.size(); });
}

Link Bodies::link_at(std::size_t i) const {
    const auto numbers = [](const auto& link) { return to_link(link); };
    return columns_->visit([&](const auto& columns) { return with_link(columns, i, numbers); });
}

LinkEnds Bodies::link_ends(std::size_t i) const {
    const auto ends = [](const auto& link) { return ends_of(link); };
    return columns_->visit([&](const auto& columns) { return with_link(columns, i, ends); });
}

std::vector<bool> Bodies::linked_rows() const {
    std::vector<bool> linked(size());
    for (std::size_t i = 0; i < link_count(); ++i) {
        const LinkEnds ends = link_ends(i);
        linked[ends.row] = true;
        if (ends.other) linked[*ends.other] = true;
    }
    return linked;
}

std::vector<std::size_t> Bodies::damping_order() const {
    return columns_->visit([](const auto& columns) {
        std::vector<std::size_t> order = oiler::damping_order(columns.links);
        for (const std::size_t i : damping_order_of(columns.point_links))
            order.push_back(columns.links.size() + i);
        return order;
    });
}

}  // namespace oiler
