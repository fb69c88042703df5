// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/stability/risks.hpp"

namespace oiler {
namespace {

/// The state at a distance from the attractor, m, on the way in, in the plane of the orbit.
State<double, 3> inbound(const Orbit& orbit, double distance) {
    const double outwards = dot(orbit.r, orbit.v);
    const double h2 = squared_length(orbit.r) * squared_length(orbit.v) - outwards * outwards;
    const double across = std::sqrt(std::max(h2, 0.0)) / distance;
    const double v2 = 2 * (orbit.energy() + orbit.gm / distance);
    return {{distance, 0}, {-std::sqrt(std::max(v2 - across * across, 0.0)), across}};
}

/// The change of an orbit's energy by one passage of its closest point, relative to its energy.
struct PassageError {
    double mean = 0;
    double deviation = 0;  ///< the standard deviation
};

/// Tries 16 passages, which differ by the places of the steps; empty if the orbit is no long
/// ellipse or a passage has more than 20,000 steps.
std::optional<PassageError> passage_error(const Orbit& orbit, const Method& method, Damping damping,
                                          const Rate& rate) {
    constexpr std::size_t count = 16;
    constexpr std::int64_t most_steps = 20'000;
    const double far = std::min(0.9 * orbit.farthest(), 40 * orbit.closest());
    if (!(far > 5 * orbit.closest())) return std::nullopt;
    const double way_of_step = -inbound(orbit, far).v[0] * rate.dt();
    Bodies bodies(2, Precision::double_);
    for (std::size_t i = 0; i < count; ++i) {
        const double part = static_cast<double>(i) / count;
        const auto [x, v] = inbound(orbit, far + part * way_of_step);
        bodies.add({.position = x, .velocity = v}, Attractor{{}, orbit.gm});
    }
    std::vector<std::optional<double>> changes(count);
    std::size_t left = count;
    for (std::int64_t tick = 0; left > 0; ++tick) {
        if (tick == most_steps) return std::nullopt;
        if (bodies.try_step(method, {rate, tick, 1, damping})) return PassageError{INFINITY, 0};
        for (std::size_t i = 0; i < count; ++i) {
            const Orbit now{{}, bodies.position(i), bodies.velocity(i), orbit.gm};
            if (changes[i] || !(dot(now.r, now.v) > 0) || !(length(now.r) > far)) continue;
            changes[i] = now.energy() / orbit.energy() - 1;
            --left;
        }
    }
    PassageError error;
    for (const auto& change : changes) error.mean += *change / count;
    for (const auto& change : changes)
        error.deviation += (*change - error.mean) * (*change - error.mean) / count;
    error.deviation = std::sqrt(error.deviation);
    return error;
}

}  // namespace

std::optional<double> lost_by_passages(const Orbit& orbit, const Method& method, Damping damping,
                                       const Rate& rate) {
    const auto error = passage_error(orbit, method, damping, rate);
    if (!error) return std::nullopt;
    for (double count = 1; count <= most_revolutions; ++count) {
        const double root = 1 - error->mean * count / 2;
        const double change = std::abs(1 / (root * root) - 1) + error->deviation * std::sqrt(count);
        if (!(root > 0) || !(change < 0.5)) return count;
    }
    return std::nullopt;
}

}  // namespace oiler
