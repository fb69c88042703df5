// SPDX-License-Identifier: MIT
#include "oiler/render/plane.hpp"

#include <optional>

namespace oiler::plane {
namespace {

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

struct Segment {
    Vec from;
    Vec to;
};

/// Narrows [first, last] to the t at which from + t·step is in [low, high] on one axis. Returns
/// whether any is left.
bool narrow(double from, double step, double low, double high, double& first, double& last) {
    if (step == 0) {
        return from >= low && from <= high;
    }
    const double a = (low - from) / step;
    const double b = (high - from) / step;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
    return first <= last;
}

/// Clips a segment: Liang & Barsky, ACM Trans. Graphics 3 (1984). Starts at the end nearer the
/// origin, because the other end may be so far away that its offsets have lost all digits.
std::optional<Segment> clip(const Segment& segment, const Box& box) {
    if (length(segment.from) > length(segment.to)) {
        const auto turned = clip({segment.to, segment.from}, box);
        return turned ? std::optional<Segment>({turned->to, turned->from}) : std::nullopt;
    }
    const Vec step = segment.to - segment.from;
    double first = 0;
    double last = 1;
    if (!narrow(segment.from.x, step.x, box.low.x, box.high.x, first, last) ||
        !narrow(segment.from.y, step.y, box.low.y, box.high.y, first, last)) {
        return std::nullopt;
    }
    // Clamped to the box, in case both ends are so far away that no digit is left.
    return Segment{box.nearest(segment.from + first * step),
                   box.nearest(last < 1 ? segment.from + last * step : segment.to)};
}

}  // namespace

std::vector<std::vector<Vec>> runs_within(const Box& box, std::span<const Point> points) {
    std::vector<std::vector<Vec>> runs;
    bool unbroken = false;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec from{points[i].x, points[i].y};
        const Vec to{points[i + 1].x, points[i + 1].y};
        const bool drawable = finite(points[i]) && finite(points[i + 1]);
        const auto seen = drawable ? clip({from, to}, box) : std::nullopt;
        if (seen && !unbroken) {
            runs.push_back({seen->from});
        }
        if (seen) {
            runs.back().push_back(seen->to);
        }
        unbroken = seen && box.holds(to);
    }
    return runs;
}

}  // namespace oiler::plane
