// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/scales.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/oscillations.hpp"

namespace oiler::lab {
namespace {

/// Whether a force takes energy from the body or, if it depends on time, gives it energy.
bool is_damped(const GivenForces& forces) {
    bool damped = false;
    for_each_given(forces, [&]<class Force>(const Force& force) {
        if constexpr (DependsOnTime<Force>)
            damped = damped || acts(force);
        else if constexpr (requires { force.damping; })
            damped = damped || force.damping != 0;
        else if constexpr (requires { force.coefficient; })
            damped = damped || force.coefficient != 0;
    });
    return damped;
}

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

Scales scales_of(const Motion& motion, const std::vector<double>& times, Bodies bodies) {
    Scales scales;
    std::vector<State3> start(motion.bodies());
    motion.all_at(0, start);
    std::vector<State3> states = start;
    double least = INFINITY;
    double most = -INFINITY;
    for (const double t : times) {
        motion.all_at(t, states);
        for (std::size_t row = 0; row < states.size(); ++row) {
            bodies.set_state(row, states[row]);
            scales.extent = std::max(scales.extent, distance(states[row].x, start[row].x));
            scales.coordinate =
                std::max(scales.coordinate, static_cast<double>(largest(states[row].x)));
            scales.speed = std::max(scales.speed, static_cast<double>(largest(states[row].v)));
        }
        const Energy energy = bodies.energy();
        scales.energy = std::max(scales.energy, energy.kinetic);
        least = std::min(least, energy.potential);
        most = std::max(most, energy.potential);
    }
    scales.energy = std::max(scales.energy, most - least);
    return scales;
}

std::vector<double> probe_times(double until, double fastest, std::size_t bodies) {
    constexpr double most_states = 2e6;
    const auto count = static_cast<std::size_t>(
        std::clamp(most_states / static_cast<double>(bodies + 1), 64.0, 2000.0));
    constexpr double golden_ratio = 0.6180339887498949;
    const double first = std::min(until, 0.1 / std::max(fastest, 1 / until));
    std::vector<double> times{0, until};
    for (std::size_t i = 0; i < count / 2; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count / 2);
        const double offset = std::fmod(static_cast<double>(i) * golden_ratio, 1.0);
        times.push_back(first * std::pow(until / first, share));
        times.push_back(until * (share + offset / static_cast<double>(count / 2)));
    }
    std::ranges::sort(times);
    return times;
}

bool is_conservative(const Bodies& bodies) {
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        for (std::size_t row = 0; row < bodies.size(); ++row)
            if (is_damped(bodies.forces_per_mass(row, index))) return false;
    for (std::size_t i = 0; i < bodies.link_count(); ++i)
        if (bodies.link_at(i).damping != 0) return false;
    const auto lossless = [&](ObstacleHandle handle) {
        const Obstacle one = bodies.obstacle(handle);
        return !one.solid || (one.restitution == 1 && one.friction == 0 && one.belt == 0 &&
                              one.velocity == Vec3{} && !one.swing);
    };
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (bodies.contact(row)) return std::ranges::all_of(bodies.obstacles(), lossless);
    return true;
}

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
