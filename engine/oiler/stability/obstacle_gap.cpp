// SPDX-License-Identifier: MIT
#include "oiler/stability/obstacle_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oiler {
namespace {

double distance(const HalfSpaceShape& plane, const Vec3& x, int) {
    return (dot(plane.normal, x) - plane.offset) / length(plane.normal);
}
double distance(const CircleShape& circle, const Vec3& x, int) {
    return length(x - circle.centre) - circle.radius;
}
double distance(const SegmentShape& segment, const Vec3& x, int) {
    const Vec3 way = segment.to - segment.from;
    const double share = dot(x - segment.from, way) / squared_length(way);
    return length(x - segment.from - way * std::clamp(share, 0.0, 1.0));
}
double distance(const BoxShape& box, const Vec3& x, int axes) {
    const Vec3 from_centre = x - box.centre;
    const double c = std::cos(box.angle);
    const double s = std::sin(box.angle);
    const Vec3 place{c * from_centre[0] + s * from_centre[1],
                     c * from_centre[1] - s * from_centre[0], from_centre[2]};
    Vec3 outside{};
    double nearest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < axes; ++i) {
        const double past = std::abs(place[i]) - box.size[i] / 2;
        nearest = std::max(nearest, past);
        outside[i] = std::max(past, 0.0);
    }
    return nearest > 0 ? length(outside) : nearest;
}

}  // namespace

double gap(const Shape& shape, const Vec3& x, double radius, int axes) {
    return std::visit([&](const auto& one) { return distance(one, x, axes); }, shape) - radius;
}

}  // namespace oiler
