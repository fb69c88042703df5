// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {
namespace plane {

/// A vector in double, because the other end of a clipped line may be 1e30 pixels away.
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

}  // namespace plane

struct LineVertex {
    Point position;  ///< pixels
    float across;    ///< signed distance from the centre line, pixels
    float along;     ///< distance beyond the line's end, pixels; 0 between the ends
    float half_width;
    float strength;  ///< factor on the colour's alpha, below 1 for lines thinner than a pixel
    Colour colour;
};

/// Triangles of many polylines, for one draw call.
struct LineMesh {
    std::vector<LineVertex> vertices;
    std::vector<std::uint32_t> indices;

    void clear() {
        vertices.clear();
        indices.clear();
    }
};

struct Stroke {
    float width = 1;  ///< pixels
    Colour colour;
};

/// Appends a strip along `points` (pixels) with round ends, mitres at gentle turns and round joints
/// at sharp turns. A line is closed if its last point equals its first. Points closer than 0.75
/// pixels to the one before are omitted, and so are parts far outside the frame. A point that is
/// not finite leaves a gap. Mitres and distances: Rougier, "Antialiased 2D Grid, Marker, and Arrow
/// Shaders" and "Shader-Based Antialiased, Dashed, Stroked Polylines", JCGT 2013.
void append_polyline(std::span<const Point> points, const Stroke& stroke, Size frame,
                     LineMesh& mesh);

/// Appends the area within `points` (pixels) with an edge one pixel wide. Areas narrower than a
/// pixel fade instead. An area that is so narrow only in parts is as dark there as elsewhere, and
/// if translucent may have darker lines. Nothing is appended if a point is not finite, or if the
/// outline crosses itself in such a way that no triangle is left.
void append_polygon(std::span<const Point> points, Colour colour, Size frame, LineMesh& mesh);

}  // namespace oiler
