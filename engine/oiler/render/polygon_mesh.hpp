// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "oiler/render/polyline_mesh.hpp"

namespace oiler {

/// Appends the area within `points` (pixels) with an edge one pixel wide. Areas narrower than a
/// pixel fade instead. Nothing is appended if a point is not finite, or if the outline crosses
/// itself in such a way that no triangle is left.
void append_polygon(std::span<const Point> points, Colour colour, Size frame, LineMesh& mesh);

}  // namespace oiler
