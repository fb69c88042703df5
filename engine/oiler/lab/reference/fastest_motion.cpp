// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/fastest_motion.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/oscillations.hpp"

namespace oiler::lab {
namespace {

/// The rate of decay by drag, at the present speed through the air or at the terminal speed, 1/s.
double dragged(const AirDrag<double, 3>& drag, const Vec3& velocity, double gravity) {
    return std::max(2 * drag.coefficient * length(velocity - drag.velocity),
                    2 * std::sqrt(drag.coefficient * gravity));
}

double fastest_of(const GivenForces& forces, const State<double, 3>& state) {
    const auto& gravity = std::get<std::optional<Gravity>>(forces);
    const double g = gravity ? length(gravity->acceleration) : 0;
    double fastest = 0;
    for_each_given(forces, [&]<class Force>(const Force& force) {
        if constexpr (DragsInAir<Force>)
            fastest = std::max(fastest, dragged(force.air_drag(), state.v, g));
        else if constexpr (!Linear<Force> && !LineSpring<Force>)
            fastest = std::max(fastest, force.fastest(state));
    });
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
                                                   {bodies.position(row), bodies.velocity(row)}));
    return fastest;
}

}  // namespace oiler::lab
