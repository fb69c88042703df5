// SPDX-License-Identifier: MIT
#include "oiler/picture/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

constexpr float line_width = 2;

Colour fill_of(const Solid& solid) {
    constexpr std::uint8_t opacity = 90;
    return solid.one_way ? palette::faded(solid.fill, opacity) : solid.fill;
}

ElementKey part(const Solid& solid, std::size_t number) {
    ElementKey key = solid.key;
    key.part = static_cast<std::uint32_t>(number);
    return key;
}

/// The normal on the right of the way from one point to another, of length 1.
Point normal_of(Point from, Point to) {
    const float x = to.x - from.x;
    const float y = to.y - from.y;
    const float length = std::hypot(x, y);
    return length > 0 ? Point{y / length, -x / length} : Point{};
}

/// The cosine of the angle between a normal and the direction from which a solid is met.
float cosine(Point normal, Point one_way) {
    const float length = std::hypot(one_way.x, one_way.y);
    return length > 0 ? (normal.x * one_way.x + normal.y * one_way.y) / length : 0;
}
bool is_met(Point normal, Point one_way) { return cosine(normal, one_way) >= 0.5F; }

void add_line(const Solid& solid, std::size_t number, std::vector<Point> points, Picture& picture) {
    picture.polylines.push_back({.key = part(solid, number),
                                 .points = std::move(points),
                                 .width = line_width,
                                 .colour = solid.line});
}

/// The points within 60° of a direction.
std::vector<Point> arc(Point centre, float radius, Point direction) {
    constexpr int pieces = 24;
    constexpr float sixty = std::numbers::pi_v<float> / 3;
    const float middle = std::atan2(direction.y, direction.x);
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i) {
        const float angle = middle + sixty * (2 * static_cast<float>(i) / pieces - 1);
        points.push_back(
            {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return points;
}

/// The faded strip behind a piece of a wall that is met from the side of `normal`.
void add_shade(const Solid& solid, std::size_t number, Point from, Point to, Point normal,
               float shade, Picture& picture) {
    const Point back{-normal.x * shade, -normal.y * shade};
    picture.polygons.push_back(
        {.key = part(solid, number),
         .points = {from, to, {to.x + back.x, to.y + back.y}, {from.x + back.x, from.y + back.y}},
         .colour = fill_of(solid)});
}

}  // namespace

void draw_circle(const Solid& solid, Point centre, float radius, Picture& picture) {
    const float width = solid.outline * picture.camera.height / canvas_height;
    float inner = radius;
    if (solid.one_way) {
        add_line(solid, 1, arc(centre, radius, *solid.one_way), picture);
    } else if (solid.outline > 0 && solid.fill.a == 0xff) {
        picture.discs.push_back({part(solid, 1), centre, radius, solid.line});
        inner = std::max(radius - width, 0.0F);
    } else if (solid.outline > 0) {  // seen through the disc
        add_line(solid, 1, circle(centre, std::max(radius - width / 2, 0.0F)), picture);
        picture.polylines.back().width = solid.outline;
    }
    picture.discs.push_back({part(solid, 0), centre, inner, fill_of(solid)});
}

void draw_block(const Solid& solid, std::vector<Point> corners, Picture& picture) {
    for (std::size_t i = 0; solid.one_way && i < corners.size(); ++i) {
        const Point from = corners[i];
        const Point to = corners[(i + 1) % corners.size()];
        if (is_met(normal_of(from, to), *solid.one_way))
            add_line(solid, i + 1, {from, to}, picture);
    }
    picture.polygons.push_back({.key = part(solid, 0),
                                .points = std::move(corners),
                                .colour = fill_of(solid),
                                .outline = solid.one_way ? 0 : solid.outline,
                                .outline_colour = solid.line});
}

void draw_wall(const Solid& solid, std::vector<Point> points, float shade, Picture& picture) {
    for (std::size_t i = 0; solid.one_way && i + 1 < points.size(); ++i) {
        const Point right = normal_of(points[i], points[i + 1]);
        const Point left{-right.x, -right.y};
        if (is_met(right, *solid.one_way))
            add_shade(solid, i + 1, points[i], points[i + 1], right, shade, picture);
        else if (is_met(left, *solid.one_way))
            add_shade(solid, i + 1, points[i], points[i + 1], left, shade, picture);
    }
    add_line(solid, 0, std::move(points), picture);
}

}  // namespace oiler
