// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/store/box_grid.hpp"

namespace oiler {

/// A position whose squares neither overflow nor vanish.
using WideVec3 = Vec<long double, 3>;

[[nodiscard]] inline WideVec3 widened(const Vec3& a) { return {{a.axis[0], a.axis[1], a.axis[2]}}; }

/// The closed ball of a query.
class SearchBall {
public:
    /// Ignores the coordinates of `centre` on axes that the world lacks. Throws Error{usage} for
    /// other coordinates that are not finite, and for a radius, m, that is negative or not finite.
    SearchBall(const Vec3& centre, double radius, int axes);

    [[nodiscard]] bool contains(const Vec3& point) const {
        const long double reach = radius_;
        return squared_length(widened(point) - widened(centre_)) <= reach * reach;
    }
    [[nodiscard]] Bounds bounds() const;

private:
    Vec3 centre_{};
    double radius_;
};

}  // namespace oiler
