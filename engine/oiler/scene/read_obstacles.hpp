// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "oiler/scene/section.hpp"

namespace oiler {

// Tables of obstacles in a scene with known axes and precision. All functions throw Error{usage}
// with file, line and key.

[[nodiscard]] SceneObstacle read_obstacle(const Scene& scene, const Section& section);
[[nodiscard]] SceneChain read_chain(const Scene& scene, const Section& section);
[[nodiscard]] SceneTiles read_tiles(const Scene& scene, const Section& section);

}  // namespace oiler
