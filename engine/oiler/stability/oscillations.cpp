// SPDX-License-Identifier: MIT
#include "oiler/stability/oscillations.hpp"

namespace oiler {
namespace {

/// The springs of each body and the dampers that the step has to follow, all in one.
std::vector<Oscillation> own_oscillations(const Bodies& bodies, bool coils_slow_apart) {
    std::vector<Oscillation> own(bodies.size());
    for (std::size_t nth = 0; nth < bodies.most_of_a_kind(); ++nth)
        for (std::size_t row = 0; row < own.size(); ++row) {
            const GivenForces forces = bodies.forces_per_mass(row, nth);
            Oscillation& of = own[row];
            if (const auto& spring = std::get<std::optional<Spring>>(forces))
                of = {of.k + spring->stiffness, of.c + spring->damping};
            if (const auto& coil = std::get<std::optional<CoilSpring>>(forces))
                of = {of.k + coil->stiffness, of.c + (coils_slow_apart ? 0 : coil->damping)};
            if (const auto& drag = std::get<std::optional<LinearDrag>>(forces))
                of.c += drag->coefficient;
        }
    return own;
}

}  // namespace

std::vector<BodyOscillation> oscillations(const Bodies& bodies, bool dampers_slow_apart) {
    std::vector<Oscillation> all = own_oscillations(bodies, dampers_slow_apart);
    std::vector<bool> linked(bodies.size());
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        for (const std::size_t row : bodies.linked_rows(i)) {
            const Link link = bodies.link_at(i);
            all[row].k += link.stiffness / bodies.mass(row);
            if (!dampers_slow_apart) all[row].c += link.damping / bodies.mass(row);
            linked[row] = true;
        }
    std::vector<BodyOscillation> found;
    for (std::size_t row = 0; row < all.size(); ++row)
        if (!linked[row]) found.push_back({row, std::nullopt, all[row]});
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const auto [a, b] = bodies.linked_rows(i);
        found.push_back({a, b, {all[a].k + all[b].k, all[a].c + all[b].c}});
    }
    return found;
}

}  // namespace oiler
