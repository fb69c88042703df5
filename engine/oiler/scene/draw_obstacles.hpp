// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/picture/picture.hpp"
#include "oiler/scene/scene.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// x and y, for a picture.
[[nodiscard]] inline Point point_of(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1])};
}

/// Adds the obstacles of the world of a scene to its picture, where they are. Planes are lines
/// across the picture, with a faded ground behind them. Tiles beside each other are one polygon.
void draw_obstacles(const Scene& scene, const World& world, Picture& picture);

}  // namespace oiler
