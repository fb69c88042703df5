// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

bool stands(const Obstacle& obstacle) {
    return !obstacle.swing && squared_length(obstacle.velocity) == 0;
}

/// The body on its orbit among the solid obstacles; empty if there are none or one moves.
std::optional<Bodies> among_obstacles(const Bodies& bodies, std::size_t row, const Orbit& orbit) {
    Bodies copy(bodies.axes(), Precision::double_);
    copy.add({.position = bodies.position(row),
              .velocity = bodies.velocity(row),
              .contact = bodies.contact(row)},
             Attractor{orbit.centre, orbit.gm});
    for (const ObstacleHandle handle : bodies.obstacles()) {
        const Obstacle one = bodies.obstacle(handle);
        if (!one.solid) continue;
        if (!stands(one)) return std::nullopt;
        copy.add_obstacle(one);
    }
    return copy.has_obstacles() ? std::optional(std::move(copy)) : std::nullopt;
}

}  // namespace

std::optional<double> distance_of_landing(const Bodies& bodies, std::size_t row, const Orbit& orbit,
                                          const Method& method, const Steps& steps, double& cost) {
    const std::int64_t most_steps = is_implicit(method) ? 4000 : 20'000;
    constexpr double price = 8;  // of a step with contacts
    constexpr double most_cost = 2e6;
    if (!bodies.contact(row) || !bodies.has_obstacles() || cost > most_cost) return std::nullopt;
    auto trial = among_obstacles(bodies, row, orbit);
    if (!trial) return std::nullopt;
    const double far = orbit.energy() < 0 ? 1.2 * orbit.farthest() : INFINITY;
    double least = length(orbit.r);
    bool has_landed = false;
    bool was_inward = false;
    for (std::int64_t tick = 0; tick < most_steps; ++tick, cost += price) {
        if (trial->try_step(method, {steps.rate, tick, 1, steps.damping})) return std::nullopt;
        const Vec3 r = trial->position(0) - orbit.centre;
        has_landed = has_landed || trial->impact_count() > 0;
        const bool is_inward = dot(r, trial->velocity(0)) < 0;
        if (!has_landed && was_inward && !is_inward) return std::nullopt;
        was_inward = is_inward;
        least = std::min(least, length(r));
        if (length(r) > far) return std::nullopt;
    }
    return has_landed ? std::optional(least) : std::nullopt;
}

}  // namespace oiler
