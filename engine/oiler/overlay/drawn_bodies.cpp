// SPDX-License-Identifier: MIT
#include "oiler/overlay/drawn_bodies.hpp"

#include <vector>

namespace oiler {
namespace {

Point centre_of(const std::vector<Point>& corners) {
    Point sum;
    for (const Point corner : corners) sum = {sum.x + corner.x, sum.y + corner.y};
    const auto count = static_cast<float>(corners.size());
    return {sum.x / count, sum.y / count};
}

}  // namespace

DrawnBodies::DrawnBodies(const Picture& picture) {
    const auto add = [&](const auto& element, Point centre, float radius = 0) {
        if (element.space == Space::world && element.key.object != 0 && element.key.part == 0)
            bodies_.try_emplace(element.key.object,
                                Body{centre, element.colour, element.layer, radius});
    };
    for (const Disc& disc : picture.discs) add(disc, disc.centre, disc.radius);
    for (const Polygon& polygon : picture.polygons)
        if (!polygon.points.empty()) add(polygon, centre_of(polygon.points));
    for (const Sprite& sprite : picture.sprites) add(sprite, sprite.centre);
}

const DrawnBodies::Body* DrawnBodies::find(Entity body) const {
    const auto found = bodies_.find(body.id());
    return found == bodies_.end() ? nullptr : &found->second;
}

}  // namespace oiler
