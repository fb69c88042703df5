// SPDX-License-Identifier: MIT
#include "oiler/world/search_ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"

namespace oiler {

SearchBall::SearchBall(const Vec3& centre, double radius, int axes) : radius_(radius) {
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

Bounds SearchBall::bounds() const { return bounds_of_path(centre_, centre_, radius_); }

}  // namespace oiler
