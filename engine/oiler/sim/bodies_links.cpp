// SPDX-License-Identifier: MIT
#include "oiler/core/require.hpp"
#include "oiler/sim/any_columns.hpp"

namespace oiler {

LinkHandle Bodies::link(std::size_t a, std::size_t b, const Link& link) {
    require_row(a);
    require_row(b);
    require(a != b, "a link is between two bodies");
    const Limits limits(precision(), axes());
    limits.check(link);
    for (const std::size_t row : {a, b})
        limits.check(1 / mass(row), "the inverse mass of a linked body");
    const LinkHandle handle = link_slots_.take<LinkHandle>();
    std::visit(
        [&]<class T, int Axes>(Columns<T, Axes>& columns) {
            columns.links.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                     handle.slot, static_cast<T>(link.stiffness),
                                     static_cast<T>(link.damping),
                                     static_cast<T>(link.rest_length)});
            columns.forces_changed();
        },
        columns_->of);
    return handle;
}

bool Bodies::alive(LinkHandle link) const { return link_slots_.holds(link.slot, link.generation); }

void Bodies::unlink(LinkHandle link) {
    require(alive(link), "the link is gone");
    std::visit(
        [&](auto& columns) {
            std::erase_if(columns.links,
                          [&](const auto& stored) { return stored.slot == link.slot; });
            columns.forces_changed();
        },
        columns_->of);
    link_slots_.release(link.slot);
}

std::size_t Bodies::link_count() const {
    return std::visit([](const auto& columns) { return columns.links.size(); }, columns_->of);
}

Link Bodies::link_at(std::size_t i) const {
    return std::visit(
        [&](const auto& columns) {
            const auto& link = columns.links[i];
            return Link{static_cast<double>(link.stiffness), static_cast<double>(link.damping),
                        static_cast<double>(link.rest_length)};
        },
        columns_->of);
}

std::array<std::size_t, 2> Bodies::linked_rows(std::size_t i) const {
    return std::visit(
        [&](const auto& columns) {
            return std::array<std::size_t, 2>{columns.links[i].a, columns.links[i].b};
        },
        columns_->of);
}

std::vector<std::size_t> Bodies::damping_order() const {
    return std::visit([](const auto& columns) { return oiler::damping_order(columns.links); },
                      columns_->of);
}

}  // namespace oiler
