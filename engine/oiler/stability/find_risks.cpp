// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "oiler/stability/risks.hpp"

namespace oiler {

namespace {

/// Adds the body in a row with its forces, as a body of `mass`.
void add_row(const Bodies& from, std::size_t row, const Body& body, Bodies& to) {
    const std::size_t added = to.add(body);
    for (std::size_t i = 0; i < from.most_forces_of_a_kind(); ++i)
        for_each_given(from.forces_per_mass(row, i), [&]<class Force>(const Force& force) {
            if constexpr (BodyForce<Force>)
                to.attach_at(i, added, force.per_unit_mass(1 / body.mass));
            else
                to.set_gravity(force.acceleration);
        });
}

}  // namespace

Bodies alone(const Bodies& bodies, std::size_t row, Precision precision) {
    Bodies copy(bodies.axes(), precision);
    add_row(bodies, row, {.position = bodies.position(row), .velocity = bodies.velocity(row)},
            copy);
    return copy;
}

Bodies in_double(const Bodies& bodies) {
    Bodies copy(bodies.axes(), Precision::double_);
    for (std::size_t row = 0; row < bodies.size(); ++row)
        add_row(bodies, row,
                {bodies.mass(row), bodies.position(row), bodies.velocity(row), bodies.contact(row)},
                copy);
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const auto [one, other, point] = bodies.link_ends(i);
        if (other)
            copy.link(one, *other, bodies.link_at(i));
        else
            copy.link_to_point(one, point, bodies.link_at(i));
    }
    for (const ObstacleHandle handle : bodies.obstacles())
        copy.add_obstacle(bodies.obstacle(handle));
    return copy;
}

std::vector<Vec3> accelerations_at_rest(Bodies bodies) {
    for (const ObstacleHandle obstacle : bodies.obstacles()) bodies.remove_obstacle(obstacle);
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        bodies.detach<Drive>(row);
        bodies.set_velocity(row, {});
    }
    std::vector<Vec3> accelerations;
    if (bodies.try_step(find_method("explicit_euler"), {.rate = {1}})) return accelerations;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        accelerations.push_back(bodies.velocity(row));
    return accelerations;
}

bool is_finite(const Bodies& bodies) {
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (!std::isfinite(squared_length(bodies.position(row))) ||
            !std::isfinite(squared_length(bodies.velocity(row))))
            return false;
    // A body on an attractor has an energy of −∞.
    return bodies.energy().total() < std::numeric_limits<double>::infinity();
}

std::vector<Risk> find_risks(const Bodies& bodies, const Method& method, const Steps& steps) {
    const double dt = steps.rate.dt();
    Region region(method, steps.damping.value_or(method.damping));
    std::vector<Risk> risks;
    if (!is_implicit(method)) add_spring_risks(bodies, region, dt, risks);
    add_drag_risks(bodies, region, steps, risks);
    add_attractor_risks(bodies, region, steps.rate, risks);
    const bool finite = is_finite(bodies);
    if (finite && risks.empty()) add_trial_risks(bodies, region, steps, risks);
    if (finite) add_overdamped_risks(bodies, method, steps, risks);
    const bool holds = risks.empty();
    add_resolution_risks(bodies, risks);
    add_rounding_risks(bodies, method, steps, risks);
    if (finite) {
        if (holds) add_drive_risks(bodies, method, steps, risks);
        add_point_risks(bodies, method, steps, risks);
        add_contact_risks(bodies, method, steps, risks);
        add_obstacle_risks(bodies, steps.rate, risks);
    }
    std::stable_sort(risks.begin(), risks.end(),
                     [](const Risk& a, const Risk& b) { return size(a) > size(b); });
    return risks;
}

bool holds(const Bodies& bodies, const Method& method, const Steps& steps) {
    return std::ranges::all_of(find_risks(bodies, method, steps), [](const Risk& risk) {
        return risk.of == Risk::Of::told || is_rounding(risk);
    });
}

void add_distortions(const Bodies& bodies, const Method& method, const Steps& steps,
                     std::vector<Risk>& risks) {
    constexpr std::size_t most_bodies = 2000;
    if (bodies.size() > most_bodies || !is_finite(bodies)) return;
    if (std::ranges::any_of(risks, [](const Risk& one) { return one.of != Risk::Of::told; }))
        return;
    std::vector<Risk> distortions;
    add_oscillation_losses(bodies, method, steps, distortions);
    add_orbit_distortions(bodies, method, steps, distortions);
    add_float_distortions(bodies, method, steps, distortions);
    std::ranges::move(distortions, std::back_inserter(risks));
}

}  // namespace oiler
