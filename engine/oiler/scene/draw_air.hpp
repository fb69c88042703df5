// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/picture/picture.hpp"
#include "oiler/scene/scene.hpp"

namespace oiler {

/// Adds arrows that drift with the wind at `time`, s, where all winds of the scene have one
/// velocity.
void draw_air(const Scene& scene, double time, Picture& picture);

}  // namespace oiler
