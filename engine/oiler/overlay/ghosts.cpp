// SPDX-License-Identifier: MIT
#include "oiler/overlay/ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "oiler/core/length_text.hpp"
#include "oiler/game/look.hpp"
#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

constexpr float least_ring = 7;  // canvas units
constexpr float least_seen = 3;
constexpr std::size_t most_labels = 5;

}  // namespace

void add_ghosts(Picture& picture, const std::vector<Ghost>& ghosts, double factor) {
    if (ghosts.empty()) return;
    const DrawnBodies bodies(picture);
    const double least_labelled =
        std::ranges::min(furthest(ghosts, most_labels), {}, &Ghost::distance).distance();
    for (const Ghost& ghost : ghosts) {
        const DrawnBodies::Body* const body = bodies.find(ghost.body);
        const Vec3 off = ghost.truth - ghost.at;
        const Point way = to_point(off * factor);
        const Point drawn = body ? body->centre : to_point(ghost.at);
        const Point at = picture.camera.to_canvas(drawn);
        const Point truth = picture.camera.to_canvas({drawn.x + way.x, drawn.y + way.y});
        const float radius = body ? body->radius : 0;
        const float ring =
            std::max(least_ring, picture.camera.to_canvas({drawn.x + radius, drawn.y}).x - at.x);
        const float seen = std::hypot(truth.x - at.x, truth.y - at.y);
        if (!std::isfinite(seen)) continue;
        const auto add_line = [&](std::vector<Point> points) {
            picture.polylines.push_back({.points = std::move(points),
                                         .width = 1.2F,
                                         .colour = palette::purple,
                                         .space = Space::canvas,
                                         .layer = overlay_layer});
        };
        add_line(circle(truth, ring));
        if (seen < least_seen) continue;
        add_line({at, truth});
        if (ghost.distance() < least_labelled) continue;
        // Beside the ring, on the side away from the body.
        const bool is_right = truth.x >= at.x;
        add_note(picture, {truth.x + (is_right ? ring + 6 : -ring - 6), truth.y},
                 length_text(ghost.distance()), 9, is_right ? Align::left : Align::right);
    }
}

}  // namespace oiler
