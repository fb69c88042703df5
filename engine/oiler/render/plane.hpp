// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler::plane {

/// In double, because the other end of a clipped line may be 1e30 pixels away.
struct Vec {
    double x = 0;
    double y = 0;

    friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec operator*(double s, Vec a) { return {s * a.x, s * a.y}; }
};

inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
inline double length(Vec a) { return std::hypot(a.x, a.y); }
inline Vec left_of(Vec a) { return {-a.y, a.x}; }

struct Box {
    Vec low;
    Vec high;

    [[nodiscard]] bool holds(Vec p) const {
        return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
    }
    [[nodiscard]] Vec nearest(Vec p) const {
        return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y)};
    }
};

/// The parts of a line within the box, as runs of connected points. A point that is not finite
/// leaves a gap.
[[nodiscard]] std::vector<std::vector<Vec>> runs_within(const Box& box,
                                                        std::span<const Point> points);

}  // namespace oiler::plane
