// SPDX-License-Identifier: MIT
#include "oiler/plot/marks.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

constexpr float mark_radius = 2.6F;
constexpr float large_radius = 5.2F;
constexpr float outline = 1.1F;
constexpr float dash = 6;
constexpr float gap = 5;  // the round ends of the dashes narrow it by the line's width

/// A regular polygon as a mark. It looks as large as a disc.
struct Polygon {
    int corners;
    float radius;
    float first;  ///< direction of the first corner, in turns

    [[nodiscard]] Polyline scaled(float by, Point centre, Colour colour, float width) const {
        Polyline line{.width = width, .colour = colour, .space = Space::canvas};
        for (int i = 0; i <= corners; ++i) {
            const float turns =
                first + static_cast<float>(i % corners) / static_cast<float>(corners);
            const float angle = 2 * std::numbers::pi_v<float> * turns;
            line.points.push_back({centre.x + by * radius * std::cos(angle),
                                   centre.y + by * radius * std::sin(angle)});
        }
        return line;
    }
    /// Distance of the sides from the centre.
    [[nodiscard]] float inradius() const {
        return radius * std::cos(std::numbers::pi_v<float> / static_cast<float>(corners));
    }
};

Polygon polygon_of(Mark mark) {
    if (mark == Mark::square) return {.corners = 4, .radius = 3.2F, .first = 0.125F};
    if (mark == Mark::diamond) return {.corners = 4, .radius = 3.4F, .first = 0};
    return {.corners = 3, .radius = 3.8F, .first = 0.25F};
}

/// Fills the polygon with a wide outline at half its size, because pictures have no filled
/// polygons.
void draw_filled(const Polygon& polygon, Point at, Colour colour, Picture& picture) {
    picture.polylines.push_back(polygon.scaled(0.5F, at, picture.background, polygon.inradius()));
    picture.polylines.push_back(polygon.scaled(1, at, colour, outline));
}

/// Draws a large outline above all other marks.
void draw_around(std::vector<Point> points, Colour colour, Picture& picture) {
    picture.polylines.push_back({.points = std::move(points),
                                 .width = 1.5F,
                                 .colour = colour,
                                 .space = Space::canvas,
                                 .layer = 1});
}

Point point_between(Point from, Point to, float part) {
    return {from.x + (to.x - from.x) * part, from.y + (to.y - from.y) * part};
}

void draw_dashes(const Polyline& whole, Picture& picture) {
    Polyline piece = whole;
    piece.key = {};
    piece.points.resize(1);
    bool is_gap = false;
    const auto turn = [&](Point at) {
        piece.points.push_back(at);
        if (!is_gap) picture.polylines.push_back(piece);
        piece.points = {at};
        is_gap = !is_gap;
    };
    float left = dash;
    for (std::size_t i = 1; i < whole.points.size(); ++i) {
        const Point from = whole.points[i - 1];
        const Point to = whole.points[i];
        const float length = std::hypot(to.x - from.x, to.y - from.y);
        float gone = 0;
        for (; gone + left < length; left = is_gap ? gap : dash)
            turn(point_between(from, to, (gone += left) / length));
        left -= length - gone;
        piece.points.push_back(to);
    }
    if (!is_gap) picture.polylines.push_back(piece);
}

}  // namespace

void draw_mark(const Series& series, Point at, Picture& picture) {
    if (series.mark == Mark::none) return;
    if (series.mark == Mark::halo)
        return draw_around(circle(at, large_radius), series.colour, picture);
    if (series.mark == Mark::frame) {
        const float side = 2 * large_radius;
        std::vector<Point> corners = rectangle(at, {side, side});
        corners.push_back(corners.front());
        return draw_around(std::move(corners), series.colour, picture);
    }
    if (series.mark != Mark::disc && series.mark != Mark::ring)
        return draw_filled(polygon_of(series.mark), at, series.colour, picture);
    const auto disc = [&](float radius, Colour colour) {
        picture.discs.push_back(
            {.centre = at, .radius = radius, .colour = colour, .space = Space::canvas});
    };
    disc(mark_radius, series.colour);
    if (series.mark == Mark::ring) disc(mark_radius - 1, picture.background);
}

void draw_line(const Series& series, const Polyline& whole, Picture& picture) {
    if (series.width <= 0) return;
    if (series.dashed) return draw_dashes(whole, picture);
    picture.polylines.push_back(whole);
}

}  // namespace oiler
