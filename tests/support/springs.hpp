// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <random>

#include "oiler/stability/preflight.hpp"
#include "support/test.hpp"

namespace oiler::test {

/// Bodies, springs and dampers from which a test makes Bodies and, independently, a matrix.
struct SpringScene {
    struct Mass {
        double mass = 1;
        Vec3 position{};
        double linear_drag = 0;
    };
    struct Pull {
        std::size_t a = 0;
        std::ptrdiff_t b = -1;  ///< -1: the anchor
        Vec3 anchor{};
        double stiffness = 1;
        double damping = 0;
        double rest_length = 0;
    };

    int axes = 2;
    std::vector<Mass> masses{};
    std::vector<Pull> pulls{};
    bool links_to_points = false;  ///< anchored springs are links to points

    [[nodiscard]] Vec3 other_end(const Pull& pull) const {
        return pull.b < 0 ? pull.anchor : masses[static_cast<std::size_t>(pull.b)].position;
    }
    /// Adds a spring at its rest length, or of length 0.
    void add_relaxed(Pull pull, bool with_length) {
        const Vec3 d = masses[pull.a].position - other_end(pull);
        pull.rest_length = with_length ? std::sqrt(squared_length(d)) : 0;
        pulls.push_back(pull);
    }

    [[nodiscard]] Bodies bodies() const {
        Bodies all(axes, Precision::double_);
        for (const Mass& mass : masses)
            all.add({.mass = mass.mass, .position = mass.position}, LinearDrag{mass.linear_drag});
        std::vector<std::size_t> coils(masses.size());
        std::vector<std::size_t> springs(masses.size());
        for (const auto& [a, b, anchor, k, damping, length] : pulls)
            if (b >= 0)
                all.link(a, static_cast<std::size_t>(b), {k, damping, length});
            else if (links_to_points)
                all.link_to_point(a, anchor, {k, damping, length});
            else if (length > 0)
                all.attach_at(coils[a]++, a, CoilSpring{anchor, k, damping, length});
            else
                all.attach_at(springs[a]++, a, Spring{anchor, k, damping});
        return all;
    }
};

/// A rate of 1/dt to nine digits.
inline Rate rate_of(double dt) {
    constexpr double parts = 1e12;
    return {static_cast<std::int64_t>(parts), std::llround(dt * parts)};
}

inline bool is_warned(const Bodies& bodies, const Method& method, double dt) {
    return !preflight(bodies, method, {.rate = rate_of(dt)}).empty();
}

/// Whether a displacement of 10⁻⁷ m grows by 10⁴ from an equilibrium.
inline bool explodes(const Bodies& resting, const Method& method, double dt, int steps) {
    constexpr double size = 1e-7;
    std::mt19937_64 random(7);
    Bodies bodies = resting;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        Vec3 x = bodies.position(row);
        for (int axis = 0; axis < bodies.axes(); ++axis)
            x[axis] += size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
        bodies.set_position(row, x);
    }
    for (int tick = 0; tick < steps; tick += 100) {
        if (bodies.try_step(method, {rate_of(dt), tick, 100})) return true;
        for (std::size_t row = 0; row < bodies.size(); ++row)
            for (const double d : (bodies.position(row) - resting.position(row)).axis)
                if (!(std::abs(d) < 1e4 * size)) return true;
    }
    return false;
}

/// The number of random scenes; a longer campaign sets OILER_CAMPAIGN.
inline int campaign_length() {
    const char* const given = std::getenv("OILER_CAMPAIGN");
    return given ? std::stoi(given) : 40;
}

}  // namespace oiler::test
