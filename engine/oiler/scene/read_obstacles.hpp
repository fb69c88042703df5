// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "oiler/scene/section.hpp"

namespace oiler {

// Tables of obstacles in a scene with known axes and precision. All functions throw Error{usage}
// with file, line and key.

// The names of layers that are new are added to the scene.

[[nodiscard]] ScenePlane read_plane(Scene& scene, const Section& section);
[[nodiscard]] SceneObstacle read_obstacle(Scene& scene, const Section& section);
[[nodiscard]] SceneChain read_chain(Scene& scene, const Section& section);
[[nodiscard]] SceneTiles read_tiles(Scene& scene, const Section& section);

/// The layers of the scene's obstacles that the key `meets` names; all without that key.
[[nodiscard]] std::uint32_t read_meets(const Scene& scene, const Section& section);

}  // namespace oiler
