// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// A coil spring seen from the side: straight leads at both ends and `turns` turns of `radius` in
/// between, in the units of the points. As many points whatever its length, so that it
/// interpolates.
[[nodiscard]] std::vector<Point> coil(Point from, Point to, int turns, float radius);

/// A closed circle.
[[nodiscard]] std::vector<Point> circle(Point centre, float radius);

}  // namespace oiler
