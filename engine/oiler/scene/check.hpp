// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"
#include "oiler/scene/section.hpp"

namespace oiler {

// Checks that need more than one key: numbers fit the scene's precision and agree with each other.
// All throw Error{usage} with file, line and key.

void check_number(const Scene& scene, const Section& section, std::string_view key, double number);
void check_numbers(const Scene& scene, const Section& section, std::string_view key,
                   const Vec3& vector);
void check_matter(const Scene& scene, const Section& section, const SceneMatter& matter);
void check_spring(const Scene& scene, const Section& section, const SceneSpring& spring);
void check_force(const Scene& scene, const Section& section, const SceneForce& force);
void check_plane(const Scene& scene, const Section& section, const Plane& plane);
void check_grid(const Scene& scene, const Section& section, const SceneGrid& grid);
void check_scatter(const Scene& scene, const Section& section, const SceneScatter& scatter);

/// Checks that the scene has at most `most_forces` forces.
void check_forces(const Scene& scene, const Place& place);

/// Checks that the method can step the forces of the scene.
void check_method(const Scene& scene, const Place& place);

}  // namespace oiler
