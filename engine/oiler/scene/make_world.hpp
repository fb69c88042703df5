// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Returns the scene with new seeds of its scatters: a run of it with seed 0 has the same bodies as
/// a run of `scene` with seed `seed`.
[[nodiscard]] Scene with_seed(Scene scene, std::uint64_t seed);

/// Makes a world of the scene's bodies, with no other forces than the scene names. Rows are in the
/// order of Scene: the bodies of [[body]], then of each grid row by row, then of each scatter.
/// Obstacles are in the order of planes, obstacles, chains and tiles. Named bodies have a Name.
/// Throws Error{usage} if a number does not fit the precision of `settings`.
[[nodiscard]] World make_world(const Scene& scene, const Settings& settings);

}  // namespace oiler
