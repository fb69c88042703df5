// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/fastest_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "oiler/stability/oscillations.hpp"

namespace oiler::lab {
namespace {

/// The angular speed of a circular orbit at the distance of closest approach. A body that falls
/// straight in passes the attractor arbitrarily fast; its orbit is bounded at 10⁻³ of the distance.
double orbital(const Attractor& attractor, const Vec3& position, const Vec3& velocity) {
    constexpr double least = 1e-3;
    const Vec3 from = position - attractor.centre;
    const double distance = length(from);
    if (distance == 0 || attractor.gm == 0) return 0;
    const double gm = std::abs(attractor.gm);
    const double along = dot(from, velocity);
    const double area2 = distance * distance * squared_length(velocity) - along * along;
    const double energy = squared_length(velocity) / 2 - gm / distance;
    const double e = std::sqrt(std::max(0.0, 1 + 2 * energy * area2 / (gm * gm)));
    const double nearest = std::clamp(area2 / gm / (1 + e), least * distance, distance);
    return std::sqrt(gm / nearest) / nearest;
}

double dragged(double coefficient, double gravity, double speed) {
    return std::max(2 * coefficient * speed, 2 * std::sqrt(coefficient * gravity));
}

double fastest_of(const GivenForces& forces, const Vec3& position, const Vec3& velocity) {
    double fastest = 0;
    if (const auto& attractor = std::get<std::optional<Attractor>>(forces))
        fastest = orbital(*attractor, position, velocity);
    const auto& gravity = std::get<std::optional<GravityForce<double, 3>>>(forces);
    const double g = gravity ? length(gravity->acceleration) : 0;
    if (const auto& drag = std::get<std::optional<QuadraticDrag>>(forces))
        fastest = std::max(fastest, dragged(drag->coefficient, g, length(velocity)));
    if (const auto& wind = std::get<std::optional<Wind>>(forces))
        fastest =
            std::max(fastest, dragged(wind->coefficient, g, length(velocity - wind->velocity)));
    if (const auto& drive = std::get<std::optional<Drive>>(forces))
        if (squared_length(drive->amplitude) > 0)
            fastest = std::max(fastest, 2 * std::numbers::pi * std::abs(drive->frequency));
    return fastest;
}

}  // namespace

double fastest_motion(const Bodies& bodies) {
    double fastest = 0;
    for (const BodyOscillation& oscillation : oscillations(bodies, false))
        fastest =
            std::max({fastest, std::sqrt(std::abs(oscillation.of.k)), std::abs(oscillation.of.c)});
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        for (std::size_t row = 0; row < bodies.size(); ++row)
            fastest = std::max(fastest, fastest_of(bodies.forces_per_mass(row, index),
                                                   bodies.position(row), bodies.velocity(row)));
    return fastest;
}

}  // namespace oiler::lab
