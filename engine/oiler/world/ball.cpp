// SPDX-License-Identifier: MIT
#include "oiler/world/ball.hpp"

#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"

namespace oiler {

Ball::Ball(const Vec3& centre, double radius, int axes) : radius_(radius) {
    if (!(radius >= 0 && std::isfinite(radius)))
        fail(Exit::usage, "a query within {} m: give a radius that is finite and 0 or more",
             radius);
    for (int i = 0; i < axes; ++i) {
        centre_[i] = centre[i];
        if (!std::isfinite(centre[i]))
            fail(Exit::usage, "a query around {} = {}: give a finite number",
                 axis_names[static_cast<std::size_t>(i)], centre[i]);
    }
}

Bounds Ball::bounds() const { return bounds_of_path(centre_, centre_, radius_); }

Bounds bounds_of_path(const Vec3& start, const Vec3& end, double radius) {
    constexpr double largest_number = std::numeric_limits<double>::max();
    Bounds box;
    for (int i = 0; i < 3; ++i) {
        const double margin =
            0x1p-50 * radius + 0x1p-50 * std::abs(start[i]) + 0x1p-50 * std::abs(end[i]);
        box.low[i] = std::max(std::min(start[i], end[i]) - radius - margin, -largest_number);
        box.high[i] = std::min(std::max(start[i], end[i]) + radius + margin, largest_number);
    }
    return box;
}

}  // namespace oiler
