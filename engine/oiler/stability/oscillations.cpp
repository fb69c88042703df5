// SPDX-License-Identifier: MIT
#include "oiler/stability/oscillations.hpp"

namespace oiler {
namespace {

/// The sum of the springs of each body, and of the dampers that the method does not split off.
std::vector<Oscillation> own_oscillations(const Bodies& bodies, bool coils_split) {
    std::vector<Oscillation> own(bodies.size());
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        for (std::size_t row = 0; row < own.size(); ++row) {
            const GivenForces forces = bodies.forces_per_mass(row, index);
            Oscillation& of = own[row];
            for_each_given(forces, [&]<class Force>(const Force& force) {
                if constexpr (Linear<Force>) {
                    const auto linear = linear_form(force);
                    of = {of.k + linear.stiffness, of.c + linear.damping};
                }
            });
            if (const auto& coil = std::get<std::optional<CoilSpring>>(forces))
                of = {of.k + coil->stiffness, of.c + (coils_split ? 0 : coil->damping)};
        }
    return own;
}

}  // namespace

std::vector<BodyOscillation> oscillations(const Bodies& bodies, bool dampers_split) {
    std::vector<Oscillation> all = own_oscillations(bodies, dampers_split);
    const auto add = [&](std::size_t row, const Link& link) {
        all[row].k += link.stiffness / bodies.mass(row);
        if (!dampers_split) all[row].c += link.damping / bodies.mass(row);
    };
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        add(ends.row, bodies.link_at(i));
        if (ends.other) add(*ends.other, bodies.link_at(i));
    }
    const std::vector<bool> linked = bodies.linked_rows();
    std::vector<BodyOscillation> found;
    for (std::size_t row = 0; row < all.size(); ++row)
        if (!linked[row]) found.push_back({row, std::nullopt, all[row]});
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const auto [a, b, point] = bodies.link_ends(i);
        const Oscillation other = b ? all[*b] : Oscillation{};
        found.push_back({a, b, {all[a].k + other.k, all[a].c + other.c}});
    }
    return found;
}

}  // namespace oiler
