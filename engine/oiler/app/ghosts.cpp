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

std::vector<Ghost> ghosts_of(const World& run, const World& reference) {
    std::vector<Ghost> ghosts;
    for (std::size_t row = 0; row < run.bodies().size(); ++row) {
        const Entity body = run.entity_of_row(row);
        if (reference.has_body(body) && reference.jumps(body) == run.jumps(body))
            ghosts.push_back({body, run.position(body), reference.position(body)});
    }
    if (ghosts.size() <= most_ghosts) return ghosts;
    const auto distance = [](const Ghost& ghost) { return length(ghost.truth - ghost.at); };
    std::ranges::nth_element(ghosts, ghosts.begin() + most_ghosts, std::greater<>(), distance);
    ghosts.resize(most_ghosts);
    return ghosts;
}

std::vector<Ghost> between(const std::vector<Ghost>& before, const std::vector<Ghost>& after,
                           double alpha) {
    std::vector<Ghost> ghosts;
    for (const Ghost& to : after) {
        const auto from = std::ranges::find(before, to.body, &Ghost::body);
        if (from == before.end()) continue;
        ghosts.push_back({to.body, from->at + (to.at - from->at) * alpha,
                          from->truth + (to.truth - from->truth) * alpha});
    }
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
