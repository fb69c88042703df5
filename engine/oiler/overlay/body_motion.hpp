// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// How a body moves.
struct BodyMotion {
    Entity body{};
    Vec3 position{};      ///< m
    Vec3 velocity{};      ///< m/s
    Vec3 acceleration{};  ///< m/s², by forces and links; impacts and pushes of the game add to it
};

/// The motions of these bodies now.
[[nodiscard]] std::vector<BodyMotion> motions_of(const World& world,
                                                 const std::vector<Entity>& bodies);

/// The motions at `alpha` between two steps, for the bodies that both have.
[[nodiscard]] std::vector<BodyMotion> between(const std::vector<BodyMotion>& before,
                                              const std::vector<BodyMotion>& after, double alpha);

/// The largest length of a vector of the motions.
[[nodiscard]] double largest(const std::vector<BodyMotion>& motions, Vec3 BodyMotion::*vector);

/// Adds an arrow for a vector of each motion, from the body; `per_metre` of it are drawn as 1 m.
void add_arrows(Picture& picture, const DrawnBodies& bodies, const std::vector<BodyMotion>& motions,
                Vec3 BodyMotion::*vector, double per_metre, Colour colour);

}  // namespace oiler
