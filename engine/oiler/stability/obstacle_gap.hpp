// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/obstacle.hpp"

namespace oiler {

/// The distance of a body of `radius` m at x from a shape in a world of `axes` axes, m; negative
/// inside it.
[[nodiscard]] double gap(const Shape& shape, const Vec3& x, double radius, int axes);

}  // namespace oiler
