// SPDX-License-Identifier: MIT
#include "oiler/render/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace oiler {
namespace plane {
namespace {

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

struct Segment {
    Vec from;
    Vec to;
};

/// Narrows [first, last] to the t at which from + t·step is in [low, high] on one axis. Returns
/// whether any is left.
bool narrow(double from, double step, double low, double high, double& first, double& last) {
    if (step == 0) return from >= low && from <= high;
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
        !narrow(segment.from.y, step.y, box.low.y, box.high.y, first, last))
        return std::nullopt;
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
        if (seen) runs.back().push_back(seen->to);
        unbroken = seen && box.holds(to);
    }
    return runs;
}

}  // namespace plane

namespace {

using plane::Box;
using plane::Vec;

// Pixels. Denser points cost time and only add noise in the turns.
constexpr double closest = 0.75;
// Pixels. Larger than any frame, and small enough for a rasteriser.
constexpr float widest = 1e5F;
// cos 120°: at sharper turns a mitre would be longer than the line is wide, so the joint is round.
constexpr double sharpest_cosine = -0.5;

/// Writes one unbroken run of points as triangles.
class Strip {
public:
    Strip(const Stroke& stroke, LineMesh& mesh)
        : half_width_(std::max(stroke.width, 1.0F) / 2),
          strength_(std::min(stroke.width, 1.0F)),
          outer_(half_width_ + 1.0),
          colour_(stroke.colour),
          mesh_(mesh) {}

    void add(std::vector<Vec> points) {
        const bool closed = points.size() > 2 && length(points.front() - points.back()) == 0;
        thin_out(points);
        if (points.size() < 2) {
            add_dot(points.front());
        } else if (closed && points.size() > 3) {
            points.pop_back();
            add_closed(points);
        } else {
            add_open(points);
        }
    }

private:
    /// The two vertices of a joint, to the left and right of the line.
    struct Cut {
        std::uint32_t left;
        std::uint32_t right;
    };

    static void thin_out(std::vector<Vec>& points) {
        const Vec last = points.back();
        std::size_t kept = 1;
        for (const Vec& point : points)
            if (length(point - points[kept - 1]) >= closest) points[kept++] = point;
        points.resize(kept);
        // Thinning must keep the last point.
        if (kept > 1) points.back() = last;
        if (kept > 2 && length(points[kept - 1] - points[kept - 2]) == 0) points.pop_back();
    }

    void add_dot(Vec centre) {
        const Vec right{1, 0};
        const Cut cut = straight_cut(centre, right);
        add_cap(centre, right, cut);
        add_cap(centre, -1 * right, {cut.right, cut.left});
    }

    void add_open(const std::vector<Vec>& points) {
        Vec direction = towards(points[0], points[1]);
        Cut cut = straight_cut(points[0], direction);
        add_cap(points[0], -1 * direction, {cut.right, cut.left});
        for (std::size_t i = 1; i + 1 < points.size(); ++i)
            cut = add_joint(cut, points[i - 1], points[i], points[i + 1]);
        direction = towards(points[points.size() - 2], points.back());
        const Cut end = straight_cut(points.back(), direction);
        add_quad(cut, end);
        add_cap(points.back(), direction, end);
    }

    void add_closed(const std::vector<Vec>& points) {
        const std::size_t count = points.size();
        // The joint at the first point is made twice: for the first and for the last segment.
        const auto quads = mesh_.indices.size();
        Cut cut = add_joint({0, 0}, points[count - 1], points[0], points[1]);
        mesh_.indices.resize(quads);
        for (std::size_t i = 1; i <= count; ++i)
            cut = add_joint(cut, points[i - 1], points[i % count], points[(i + 1) % count]);
    }

    /// Ends the segment that started at `start`. Returns the start of the next segment.
    Cut add_joint(Cut start, Vec before, Vec at, Vec after) {
        const Vec in = towards(before, at);
        const Vec out = towards(at, after);
        const double cosine = dot(in, out);
        const double shorter = std::min(length(at - before), length(after - at));
        // The mitre reaches outer_ · tan(turn/2) back along the segments. Beyond half of a segment
        // the strip would fold over itself.
        const double reach = outer_ * std::sqrt(std::max(0.0, (1 - cosine) / (1 + cosine)));
        if (cosine < sharpest_cosine || reach > shorter / 2)
            return add_round_joint(start, at, in, out);
        const Vec mitre = (outer_ / (1 + cosine)) * (left_of(in) + left_of(out));
        const Cut cut = add_cut(at, mitre);
        add_quad(start, cut);
        return cut;
    }

    /// The half disc before the next segment covers the whole wedge between the two.
    Cut add_round_joint(Cut start, Vec at, Vec in, Vec out) {
        add_quad(start, straight_cut(at, in));
        const Cut next = straight_cut(at, out);
        add_cap(at, -1 * out, {next.right, next.left});
        return next;
    }

    Cut straight_cut(Vec at, Vec direction) { return add_cut(at, outer_ * left_of(direction)); }

    Cut add_cut(Vec at, Vec to_left) {
        const auto outer = static_cast<float>(outer_);
        const std::uint32_t left = add_vertex(at + to_left, outer, 0);
        return {left, add_vertex(at - to_left, -outer, 0)};
    }

    /// Adds a quad beyond `cut`. The shader draws the half disc in it by distance to the end point.
    void add_cap(Vec at, Vec direction, Cut cut) {
        const Vec to_left = outer_ * left_of(direction);
        const Vec tip = at + outer_ * direction;
        const auto outer = static_cast<float>(outer_);
        const std::uint32_t left = add_vertex(tip + to_left, across(cut.left), outer);
        add_quad(cut, {left, add_vertex(tip - to_left, across(cut.right), outer)});
    }

    [[nodiscard]] float across(std::uint32_t vertex) const { return mesh_.vertices[vertex].across; }

    std::uint32_t add_vertex(Vec position, float across, float along) {
        mesh_.vertices.push_back({{static_cast<float>(position.x), static_cast<float>(position.y)},
                                  across,
                                  along,
                                  half_width_,
                                  strength_,
                                  colour_});
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    void add_quad(Cut from, Cut to) {
        mesh_.indices.insert(mesh_.indices.end(), {from.left, from.right, to.left,  //
                                                   to.left, from.right, to.right});
    }

    static Vec towards(Vec from, Vec to) { return (1 / length(to - from)) * (to - from); }

    float half_width_;
    float strength_;
    double outer_;  ///< half the width of the line with its soft edges
    Colour colour_;
    LineMesh& mesh_;
};

}  // namespace

void append_polyline(std::span<const Point> points, const Stroke& stroke, Size frame,
                     LineMesh& mesh) {
    if (!(stroke.width > 0)) return;
    const Stroke drawable{std::min(stroke.width, widest), stroke.colour};
    // Ends and mitres from clipping stay outside the frame.
    const double margin = 2 * (drawable.width + 2.0);
    const Box box{{-margin, -margin}, {frame.width + margin, frame.height + margin}};
    Strip strip(drawable, mesh);
    for (std::vector<Vec>& run : runs_within(box, points)) strip.add(std::move(run));
}

}  // namespace oiler
