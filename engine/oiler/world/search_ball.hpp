// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "oiler/sim/store/box_grid.hpp"

namespace oiler {

/// The power of two that scales numbers up to `size` so that their squares neither overflow nor
/// vanish beside the largest. Long double has the range, but other digits on other machines.
[[nodiscard]] inline double scale_for_squares(double size) {
    constexpr int most = 1000;
    return size == 0 ? 1 : std::ldexp(1.0, -std::clamp(std::ilogb(size), -most, most));
}

/// The closed ball of a query.
class SearchBall {
public:
    /// Ignores the coordinates of `centre` on axes that the world lacks. Throws Error{usage} for
    /// other coordinates that are not finite, and for a radius, m, that is negative or not finite.
    SearchBall(const Vec3& centre, double radius, int axes);

    [[nodiscard]] bool contains(const Vec3& point) const {
        const Vec3 way = point - centre_;
        const double scale = scale_for_squares(std::max(largest(way), radius_));
        const double reach = radius_ * scale;
        return squared_length(way * scale) <= reach * reach;
    }
    [[nodiscard]] Bounds bounds() const;

private:
    Vec3 centre_{};
    double radius_;
};

}  // namespace oiler
