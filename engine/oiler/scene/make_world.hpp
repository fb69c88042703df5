// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// The scene whose scatters have the bodies that `seed` of Settings gives those of this one.
[[nodiscard]] Scene with_seed(Scene scene, std::uint64_t seed);

/// A world of the scene's bodies with just the forces that it names. The bodies are in the rows in
/// the order of Scene: the named ones, then those of each grid row by row, then those of each
/// scatter. Throws Error{usage} where the precision of `settings` does not hold its numbers.
[[nodiscard]] World make_world(const Scene& scene, const Settings& settings);

}  // namespace oiler
