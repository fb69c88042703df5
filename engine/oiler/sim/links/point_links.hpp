// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "oiler/physics/response.hpp"
#include "oiler/sim/links/lanes.hpp"
#include "oiler/sim/links/link_force.hpp"

namespace oiler {

template <std::floating_point T, int Axes>
void sort_point_links(std::vector<PointLinkRow<T, Axes>>& links) {
    const auto key = [](const PointLinkRow<T, Axes>& link) {
        return std::tuple(link.row, link.pulls_only, link.rest_length, link.stiffness, link.damping,
                          link.point.axis);
    };
    std::stable_sort(links.begin(), links.end(),
                     [&](const auto& one, const auto& other) { return key(one) < key(other); });
}

/// Prepares springs to fixed points for dampers over `half_step` (s); adds them to the sums of
/// their rows.
template <std::floating_point T, int Axes>
[[nodiscard]] PointLinks<T, Axes> prepare_point_links(std::vector<PointLinkRow<T, Axes>> links,
                                                      T half_step, PreparedLinks<T>& prepared) {
    sort_point_links(links);
    PointLinks<T, Axes> points{std::move(links), {}};
    for (const PointLinkRow<T, Axes>& link : points.links) {
        const T rate = link.damping * prepared.inverse_mass[link.row];
        points.loss.push_back(rate * oscillator_response(T(0), rate, half_step).reach);
        prepared.of_rows[link.row].stiffness += link.stiffness;
        prepared.of_rows[link.row].damping += link.damping;
    }
    return points;
}

/// The state of a link's row relative to its point.
template <std::floating_point T, int Axes>
[[nodiscard]] State<T, Axes> relative(const MotionColumns<T, Axes>& motion,
                                      const PointLinkRow<T, Axes>& link) {
    State<T, Axes> state = load<T>(motion, link.row);
    state.x -= link.point;
    return state;
}

/// Adds the accelerations by the links of the rows of a range.
template <std::floating_point T, int Axes>
void push_point_links(const PointLinks<T, Axes>& points, const MotionColumns<T, Axes>& motion,
                      Evaluate what, const Parameter<T>& inverse_mass, const RowRange& rows,
                      VecColumns<T, Axes>& to) {
    for (const PointLinkRow<T, Axes>& link : points.links) {
        if (!rows.holds(link.row)) continue;
        const State<T, Axes> state = relative(motion, link);
        const LinkForce<T, Axes> force(link);
        const Vec<T, Axes> push =
            what == Evaluate::field ? force.field(state.x) : force.accelerate(state);
        store(Vec<T, Axes>(load<T>(to, link.row) + push * inverse_mass[link.row]), to, link.row);
    }
}

/// The dampers of the links, one after the other.
template <std::floating_point T, int Axes>
void damp_point_links(const PointLinks<T, Axes>& points, MotionColumns<T, Axes>& motion,
                      bool reverse) {
    const std::size_t count = points.links.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = reverse ? count - 1 - i : i;
        const PointLinkRow<T, Axes>& link = points.links[at];
        if (link.damping == 0) continue;
        const Vec<T, Axes> loss =
            LinkForce<T, Axes>(link).velocity_loss(relative(motion, link), points.loss[at]);
        store(Vec<T, Axes>(load<T>(motion.v, link.row) - loss), motion.v, link.row);
    }
}

/// Moves a row that has just been put to sleep onto the point of a link without length, axis by
/// axis, if it is within the sleep distance. `before` is its velocity before that.
template <std::floating_point T, int Axes>
void settle_on_points(const PointLinks<T, Axes>& points, std::size_t row,
                      const Vec<T, Axes>& before, State<T, Axes>& state) {
    auto link = std::ranges::lower_bound(points.links, row, {}, &PointLinkRow<T, Axes>::row);
    for (; link != points.links.end() && link->row == row; ++link) {
        if (link->rest_length != 0) continue;
        for (std::size_t i = 0; i < Axes; ++i)
            if (before.axis[i] != 0 && state.v.axis[i] == 0 &&
                std::abs(state.x.axis[i] - link->point.axis[i]) < sleep_limit<T>(true))
                state.x.axis[i] = link->point.axis[i];
    }
}

}  // namespace oiler
