// SPDX-License-Identifier: MIT
// Bodies that meet planes: the worlds of landing, resting and sliding.
#pragma once

#include "oiler/world/world.hpp"
#include "support/dice.hpp"
#include "support/test.hpp"

namespace oiler::test {

inline constexpr double g = 9.81;
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr std::array contact_methods{"semi_implicit_euler", "velocity_verlet", "rk4",
                                            "implicit_midpoint",   "implicit_euler",  "exact"};
/// Those that step flights under gravity exactly.
inline constexpr std::array exact_flights{"velocity_verlet", "rk4", "implicit_midpoint", "exact"};

inline World world_of(const char* method, int rate, int axes = 2, const Vec3& gravity = {},
                      const std::vector<Plane>& planes = {},
                      Precision precision = Precision::double_) {
    World world(axes, {.method = &find_method(method), .rate = {rate}, .precision = precision});
    if (gravity != Vec3{}) world.set_gravity(gravity);
    for (const Plane& plane : planes) world.add_plane(plane);
    return world;
}

/// Steps the world and returns its impacts, those of one kind if it is given.
inline std::vector<Impact> impacts(World& world, int steps, std::optional<Meeting> kind = {}) {
    std::vector<Impact> all;
    for (int i = 0; i < steps; ++i) {
        world.step();
        for (const Impact& impact : world.impacts())
            if (!kind || impact.kind == kind) all.push_back(impact);
    }
    return all;
}
inline int count(World& world, int steps, std::optional<Meeting> kind = {}) {
    return static_cast<int>(impacts(world, steps, kind).size());
}

}  // namespace oiler::test
