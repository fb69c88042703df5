// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "oiler/physics/contacts/landing.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// Where a step begins.
template <std::floating_point T>
struct StepStart {
    std::int64_t tick;
    T dt;  ///< s
};

/// Steps a row among the obstacles near it, see Landing, and appends its impacts. The first search
/// goes `way` m; a body that gets farther is stepped again, with a wider search.
template <std::floating_point T, int Axes, class Body>
Landed land_row(Contacts<T, Axes>& contacts, State<T, Axes>& state, std::size_t row,
                const StepStart<T>& step, T way, Body& body,
                std::vector<RowImpact<T, Axes>>& impacts, std::vector<Near<T, Axes>>& nears) {
    const State<T, Axes> start = state;
    const T radius = contacts.radius[row];
    const std::size_t known = impacts.size();
    for (;; way = 2 * (way + length(state.x - start.x))) {
        contacts.obstacles.find_near(start.x, way, radius, contacts.meets(row), step.tick, step.dt,
                                     nears);
        impacts.erase(impacts.begin() + static_cast<std::ptrdiff_t>(known), impacts.end());
        std::size_t index = 0;
        const auto report = [&](const ImpactOf<T, Axes>& impact) {
            impacts.push_back({step.tick, row, index++, impact});
        };
        state = start;
        Landing landing(std::span<Near<T, Axes>>(nears), way, radius, body, report);
        if (contacts.is_crushed(row)) landing.stay_crushed(state, step.dt);
        const Landed landed = landing.step(state, step.dt);
        if (landed == Landed::strayed) continue;
        contacts.set_crushed(row, landing.is_crushed(state));
        return landed;
    }
}

}  // namespace oiler
