// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "oiler/physics/steps.hpp"
#include "oiler/sim/steps/area_crossings.hpp"
#include "oiler/sim/steps/land_row.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// The motion of a linked row in a step: the links act on it by the mean acceleration of the step
/// without obstacles, because the motions of rows depend on each other.
template <std::floating_point T, int Axes>
class MeanMotion {
public:
    using Vector = Vec<T, Axes>;
    using Motion = State<T, Axes>;

    MeanMotion(const Motion& from, const Motion& to, T dt)
        : a_((to.v - from.v) * (1 / dt)),
          shift_(((to.x - from.x) * (1 / dt) - (from.v + to.v) * T(0.5)) * (1 / dt)) {}

    [[nodiscard]] Motion fly(const Motion& from, T, T tau) const { return move(from, a_, tau); }
    /// With the shift along the obstacles by which the method's place differs from that of the mean
    /// velocity, so that long slides on springs keep its stability.
    [[nodiscard]] Motion slide(const Motion& from, T, T tau, const Support<T, Axes>& support,
                               const Friction<T, Axes>& friction) const {
        Motion end = move(from, friction.braked(support, a_, from.v, tau / 2), tau);
        end.x += support.change_without_push(shift_) * (tau * tau);
        return end;
    }
    [[nodiscard]] Vector accelerate(const Motion&, T) const { return a_; }
    [[nodiscard]] static constexpr bool forces_change() { return false; }

private:
    [[nodiscard]] static Motion move(const Motion& from, const Vector& a, T tau) {
        return {from.x + (from.v + a * (tau / 2)) * tau, from.v + a * tau};
    }

    Vector a_;      ///< m/s²
    Vector shift_;  ///< m/s²; of a step of tau s, times tau²
};

/// Whether a row may meet one of the obstacles near it in a step.
template <std::floating_point T, int Axes>
bool may_meet_any(const std::vector<Near<T, Axes>>& nears, const State<T, Axes>& from, T way,
                  T radius) {
    return std::ranges::any_of(nears, [&](const Near<T, Axes>& near) {
        return near.obstacle.bounded || near.obstacle.course.moves() ||
               gap(near, from.x, T(0), radius) <= way;
    });
}

/// Lets a linked row land, and tells whether its state `changed`. Returns false if its impacts have
/// no end.
template <std::floating_point T, int Axes>
bool land_linked_row(Columns<T, Axes>& columns, const State<T, Axes>& start, std::size_t row,
                     const StepStart<T>& step, std::vector<Near<T, Axes>>& nears, bool& changed) {
    auto& contacts = columns.contacts;
    const T radius = contacts.radius[row];
    const State<T, Axes> end = load<T>(columns.motion, row);
    const T way = largest_way(start, end, step.dt) + contacts.obstacles.hidden_way(start.x, radius);
    contacts.obstacles.find_near(start.x, way, radius, contacts.meets(row), step.tick, step.dt,
                                 nears);
    if (!may_meet_any(nears, start, way, radius)) return true;
    MeanMotion<T, Axes> body(start, end, step.dt);
    State<T, Axes> state = start;
    const Landed landed =
        land_row<T, Axes>(contacts, state, row, step, way, body, contacts.impacts, nears);
    const State<T, Axes> free = body.fly(start, T(0), step.dt);
    const bool ends_in_any = std::ranges::any_of(
        nears, [&](const Near<T, Axes>& near) { return gap(near, end.x, step.dt, radius) < 0; });
    if (ends_in_any || state.x != free.x || state.v != free.v) {
        store(state, columns.motion, row);
        changed = true;
    }
    return landed != Landed::unresolved;
}

/// Lets linked rows land, and tells whether any state `changed`. This has order 1 with every
/// method. Returns the first row whose impacts have no end.
template <std::floating_point T, int Axes>
std::optional<Divergence> land_linked_rows(Columns<T, Axes>& columns,
                                           const MotionColumns<T, Axes>& before,
                                           const StepStart<T>& step, bool& changed) {
    auto& contacts = columns.contacts;
    const auto earlier = static_cast<std::ptrdiff_t>(contacts.impacts.size());
    std::vector<Near<T, Axes>>& nears = contacts.nears_of_parts.front();
    for (std::size_t row = 0; row < columns.size; ++row) {
        if (contacts.radius[row] == Contacts<T, Axes>::no_contact) continue;
        const State<T, Axes> start = load<T>(before, row);
        const std::size_t known = contacts.impacts.size();
        if (!land_linked_row(columns, start, row, step, nears, changed))
            return Divergence{step.tick + 1, row, 0, Divergence::Of::impacts};
        if (!contacts.areas.empty())
            AreaCrossings(contacts, row, step.tick, step.dt)
                .list(start, load<T>(columns.motion, row), contacts.impacts, known,
                      contacts.impacts.size(), nears);
    }
    std::sort(contacts.impacts.begin() + earlier, contacts.impacts.end());
    return std::nullopt;
}

}  // namespace oiler
