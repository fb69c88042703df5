// SPDX-License-Identifier: MIT
#include "oiler/stability/spring_risks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/stability/component_risk.hpp"
#include "oiler/stability/oscillations.hpp"

namespace oiler {
namespace {

/// The springs, dampers and linear drag of a body without links, if they act in all directions.
struct OwnMotion {
    double k = 0;  ///< 1/s²
    double c = 0;  ///< 1/s
    bool has_coils = false;
};

std::vector<OwnMotion> own_motions(const Bodies& bodies) {
    std::vector<OwnMotion> own(bodies.size());
    for (std::size_t index = 0; index < bodies.most_forces_of_a_kind(); ++index)
        for (std::size_t row = 0; row < own.size(); ++row) {
            const GivenForces forces = bodies.forces_per_mass(row, index);
            OwnMotion& of = own[row];
            for_each_given(forces, [&]<class Force>(const Force& force) {
                if constexpr (Linear<Force>) {
                    of.k += linear_form(force).stiffness;
                    of.c += linear_form(force).damping;
                }
            });
            if (const auto& coil = std::get<std::optional<CoilSpring>>(forces))
                of.has_coils = of.has_coils || coil->stiffness != 0 || coil->damping != 0;
        }
    return own;
}

ScaledOscillation scaled(const OwnMotion& of, double dt) {
    return {std::sqrt(of.k) * dt, of.c * dt};
}

/// The largest ω·dt and c·dt of bodies without coils.
ScaledOscillation largest_of(const std::vector<OwnMotion>& own, double dt) {
    ScaledOscillation largest;
    for (const OwnMotion& of : own) {
        if (of.k < 0 || of.c < 0) continue;
        const auto [omega_dt, damping_dt] = scaled(of, dt);
        largest.omega_dt = std::max(largest.omega_dt, omega_dt);
        largest.damping_dt = std::max(largest.damping_dt, damping_dt);
    }
    return largest;
}

}  // namespace

void add_spring_risks(const Bodies& bodies, Region& region, double dt, std::vector<Risk>& risks) {
    const std::vector<OwnMotion> own = own_motions(bodies);
    const std::vector<bool> linked = bodies.linked_rows();
    const bool all_inside = region.contains_all_up_to(largest_of(own, dt));
    for (std::size_t row = 0; row < own.size(); ++row) {
        if (linked[row]) continue;
        if (own[row].has_coils) {
            if (auto risk = find_risk(component_of_row(bodies, row), region, dt))
                risks.push_back(std::move(*risk));
            continue;
        }
        // Negative stiffness or damping diverges by itself with any method.
        if (all_inside || own[row].k < 0 || own[row].c < 0) continue;
        const ScaledOscillation of = scaled(own[row], dt);
        if (!region.contains(of))
            risks.push_back({.row = row, .omega_dt = of.omega_dt, .damping_dt = of.damping_dt});
    }
    if (bodies.link_count() == 0) return;
    for (Component& component : linked_components(bodies, component_labels(bodies)))
        if (auto risk = find_risk(std::move(component), region, dt))
            risks.push_back(std::move(*risk));
}

bool contains_all_springs(const Bodies& bodies, Region& region, double dt) {
    ScaledOscillation largest;
    for (const BodyOscillation& one :
         oscillations(bodies, splits_dampers(region.method(), region.damping()))) {
        largest.omega_dt = std::max(largest.omega_dt, std::sqrt(std::max(one.of.k, 0.0)) * dt);
        largest.damping_dt = std::max(largest.damping_dt, one.of.c * dt);
    }
    return region.contains_all_up_to(largest) ||
           (largest.damping_dt == 0 && region.contains(largest));
}

double spring_limit(const Risk& risk, const Method& method, Damping damping, double dt) {
    if (risk.component) return component_limit(*risk.component, method, damping, dt);
    std::vector<ScaledOscillation> all = risk.oscillations;
    all.push_back({risk.omega_dt, risk.damping_dt});
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return size(a) > size(b); });
    double limit = std::numeric_limits<double>::infinity();
    Region region(method, damping);
    for (const ScaledOscillation& of : all) {
        // Limits are slow to find. Most oscillations are stable below the limit of the largest.
        const double below = std::min(limit, 1.0) * (1 - 1e-9);
        if (std::isfinite(limit) && region.contains({of.omega_dt * below, of.damping_dt * below}))
            continue;
        if (size(of) > 0)
            limit =
                std::min(limit, stability_limit(method, damping, unit_oscillation(of)) / size(of));
    }
    return limit;
}

}  // namespace oiler
