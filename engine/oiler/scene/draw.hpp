// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/picture/picture.hpp"
#include "oiler/scene/scene.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// The scene's camera; what it leaves open is fitted to bodies, anchors and attractors at the
/// start, with a margin. `world` is at tick 0.
[[nodiscard]] Camera camera_of(const Scene& scene, const World& world);

/// What is to be seen of a world that was made of the scene: bodies and attractors as discs,
/// springs as coils, grids as nets.
[[nodiscard]] Picture draw_scene(const Scene& scene, const World& world, const Camera& camera);

}  // namespace oiler
