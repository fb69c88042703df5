// SPDX-License-Identifier: MIT
#include "oiler/stability/orbit_trial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

constexpr double revolutions = 20;
constexpr double samples = 1000;  // per revolution
constexpr double most_steps = 200'000;

double length(const Vec3& vector) { return std::sqrt(squared_length(vector)); }

}  // namespace

double Orbit::energy() const { return squared_length(v) / 2 - gm / length(r); }

double Orbit::closest() const {
    const double distance = length(r);
    const double outwards = dot(r, v);
    if (energy() >= 0 && outwards >= 0) return distance;
    const double h2 = std::max(squared_length(r) * squared_length(v) - outwards * outwards, 0.0);
    const double e = std::sqrt(std::max(1 + 2 * energy() * h2 / (gm * gm), 0.0));
    return std::min(distance, h2 / (gm * (1 + e)));
}

double Orbit::farthest() const { return -gm / energy() - closest(); }

double Orbit::period() const {
    const double axis = -gm / (2 * energy());
    return 2 * std::numbers::pi * axis * std::sqrt(axis / gm);
}

Rate scaled_rate(const Rate& rate, double factor) {
    constexpr double parts = 1e13;
    return {static_cast<std::int64_t>(parts), std::llround(rate.dt() * factor * parts)};
}

bool is_followed(const Orbit& orbit, const Method& method, Damping damping, const Rate& rate,
                 double tolerance, std::int64_t& steps) {
    Bodies bodies(3, Precision::double_);
    bodies.add({.position = orbit.centre + orbit.r, .velocity = orbit.v},
               Attractor{orbit.centre, orbit.gm});
    const double per_revolution = orbit.period() / rate.dt();
    const auto stride = static_cast<std::int64_t>(std::max(1.0, per_revolution / samples));
    const auto most = static_cast<std::int64_t>(std::min(revolutions * per_revolution, most_steps));
    std::int64_t inside = 0;
    for (std::int64_t tick = 0; tick < most; tick += stride, steps += stride) {
        if (bodies.try_step(method, {rate, tick, stride, damping})) return false;
        const Orbit now{{}, bodies.position(0) - orbit.centre, bodies.velocity(0), orbit.gm};
        // Close to the attractor the energy error is large and vanishes again.
        inside = length(now.r) < orbit.farthest() / 2 ? inside + stride : 0;
        if (static_cast<double>(inside) > 2 * per_revolution) return false;
        if (inside == 0 && std::abs(now.energy() / orbit.energy() - 1) >= tolerance) return false;
    }
    return true;
}

}  // namespace oiler
