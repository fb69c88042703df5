// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "oiler/scene/section.hpp"

namespace oiler {

// What no single key decides: whether the columns of the scene's precision hold what its numbers
// come to, and whether they make sense together. All throw Error{usage} with file, line and key.

void check_number(const Scene& scene, const Section& section, std::string_view key, double number);
void check_numbers(const Scene& scene, const Section& section, std::string_view key,
                   const Vec3& vector);
void check_matter(const Scene& scene, const Section& section, const SceneMatter& matter);
void check_spring(const Scene& scene, const Section& section, const SceneSpring& spring);
void check_grid(const Scene& scene, const Section& section, const SceneGrid& grid);
void check_scatter(const Scene& scene, const Section& section, const SceneScatter& scatter);

/// That the forces of all bodies fit into memory.
void check_forces(const Scene& scene, const Place& place);

/// That the method can step the forces that the scene has.
void check_method(const Scene& scene, const Place& place);

}  // namespace oiler
