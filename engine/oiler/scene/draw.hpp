// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/picture/picture.hpp"
#include "oiler/scene/scene.hpp"
#include "oiler/scene/trails.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Returns the scene's camera. An absent centre or height is fitted to bodies, anchors and
/// attractors at the start, 25 % larger than their box. `world` is at tick 0.
[[nodiscard]] Camera camera_of(const Scene& scene, const World& world);

/// Draws a world that was made from the scene: bodies and attractors as discs, springs as coils,
/// grids as nets, and what the scene's view says.
[[nodiscard]] Picture draw_scene(const Scene& scene, const World& world, const Camera& camera,
                                 const SceneTrails& trails = {});

}  // namespace oiler
