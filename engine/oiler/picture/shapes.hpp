// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// A coil spring from the side: `turns` turns of `radius` between straight leads, in the units of
/// the points. The number of points does not depend on its length, so that it interpolates.
[[nodiscard]] std::vector<Point> coil(Point from, Point to, int turns, float radius);

/// A circle as a closed polyline.
[[nodiscard]] std::vector<Point> circle(Point centre, float radius);

}  // namespace oiler
