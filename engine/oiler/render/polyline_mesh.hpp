// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

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

}  // namespace oiler
