// SPDX-License-Identifier: MIT
#include "oiler/app/ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "oiler/app/drawn_bodies.hpp"
#include "oiler/app/help.hpp"
#include "oiler/app/look.hpp"
#include "oiler/app/verdict.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

constexpr float ring = 7;  // canvas units
constexpr float least_seen = 3;

}  // namespace

std::vector<Ghost> ghosts_of(const Moment& run, const Moment& reference) {
    std::vector<Ghost> ghosts;
    for (const auto& [body, truth] : same_bodies(run, reference))
        ghosts.push_back({body->entity, body->position, truth->position});
    if (ghosts.size() <= most_ghosts) return ghosts;
    const auto distance = [](const Ghost& ghost) { return length(ghost.truth - ghost.at); };
    std::ranges::nth_element(ghosts, ghosts.begin() + most_ghosts, std::greater<>(), distance);
    ghosts.resize(most_ghosts);
    return ghosts;
}

void add_ghosts(Picture& picture, const std::vector<Ghost>& ghosts, double factor) {
    if (ghosts.empty()) return;
    const DrawnBodies bodies(picture);
    for (const Ghost& ghost : ghosts) {
        const DrawnBodies::Body* const body = bodies.find(ghost.body);
        const Vec3 off = ghost.truth - ghost.at;
        const Point way = to_point(off * factor);
        const Point drawn = body ? body->centre : to_point(ghost.at);
        const Point at = picture.camera.to_canvas(drawn);
        const Point truth = picture.camera.to_canvas({drawn.x + way.x, drawn.y + way.y});
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
        picture.labels.push_back({.at = {truth.x + ring + 2, truth.y},
                                  .text = length_text(std::hypot(off[0], off[1], off[2])),
                                  .size = 9,
                                  .colour = palette::purple,
                                  .layer = overlay_layer});
    }
}

}  // namespace oiler
