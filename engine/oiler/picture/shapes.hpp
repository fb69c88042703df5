// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// A coil spring from the side: `turns` turns of `radius` between straight leads, in the units of
/// the points. The number of points does not depend on its length, so that it interpolates.
[[nodiscard]] std::vector<Point> coil(Point from, Point to, int turns, float radius);

/// A rope of `length` that hangs between two points, straight if they are that far apart. Its curve
/// is a parabola, which is up to a seventh too short as the ends meet. The number of points does
/// not depend on its length.
[[nodiscard]] std::vector<Point> rope(Point from, Point to, float length);

/// The corners of a rectangle, counter-clockwise, turned by `angle` rad. For a polygon.
[[nodiscard]] std::vector<Point> rectangle(Point centre, Point size, float angle = 0);

/// The corners of a rectangle that reaches from one point to another, `width` across. For a
/// polygon.
[[nodiscard]] std::vector<Point> bar(Point from, Point to, float width);

/// The corners of a regular polygon, the first one straight above the centre.
[[nodiscard]] std::vector<Point> regular_polygon(Point centre, float radius, int corners);

/// The outline of an arrow with a shaft `width` wide and a head four times as wide and long, for a
/// polygon. An arrow shorter than its head is a smaller head.
[[nodiscard]] std::vector<Point> arrow(Point from, Point to, float width);

/// A circle as a closed polyline.
[[nodiscard]] std::vector<Point> circle(Point centre, float radius);

}  // namespace oiler
