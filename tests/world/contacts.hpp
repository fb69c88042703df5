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

inline World world_of(const char* method, int rate, int axes = 2, const Vec3& gravity = {},
                      const std::vector<Plane>& planes = {},
                      Precision precision = Precision::double_) {
    World world(axes, {.method = &find_method(method), .rate = {rate}, .precision = precision});
    if (gravity != Vec3{}) world.set_gravity(gravity);
    for (const Plane& plane : planes) world.add_plane(plane);
    return world;
}

/// Steps the world and counts the impacts of one kind.
inline int count(World& world, int steps, Meeting kind) {
    int met = 0;
    for (int i = 0; i < steps; ++i) {
        world.step();
        for (const Impact& impact : world.impacts()) met += impact.kind == kind;
    }
    return met;
}
/// Steps the world and counts the impacts of all kinds.
inline int count(World& world, int steps) {
    int met = 0;
    for (int i = 0; i < steps; ++i) {
        world.step();
        met += static_cast<int>(world.impacts().size());
    }
    return met;
}

}  // namespace oiler::test
