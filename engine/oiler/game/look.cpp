// SPDX-License-Identifier: MIT
#include "oiler/game/look.hpp"

#include <cmath>

#include "oiler/picture/shapes.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

/// The side of a plane that bodies do not reach, as far as the camera sees.
Polygon ground_of(const Plane& plane, const Camera& camera) {
    const double size = std::hypot(plane.normal[0], plane.normal[1]);
    const Vec3 normal = plane.normal / size;
    const Vec3 along{-normal[1], normal[0]};
    const Vec3 centre{camera.centre.x, camera.centre.y};
    const Vec3 at = centre + (plane.offset / size - dot(normal, centre)) * normal;
    const double reach = 4 * camera.height;
    return {.points = {to_point(at - reach * along), to_point(at + reach * along),
                       to_point(at + reach * along - reach * normal),
                       to_point(at - reach * along - reach * normal)},
            .colour = palette::pale,
            .outline = 1.5F,
            .outline_colour = palette::grey};
}

void draw(const Look& look, const ElementKey& key, Point at, Picture& picture) {
    if (look.shape == Look::Shape::disc) {
        picture.discs.push_back({key, at, look.size, look.colour, Space::world, look.layer});
        return;
    }
    const bool is_square = look.shape == Look::Shape::square;
    picture.polygons.push_back({.key = key,
                                .points = is_square ? rectangle(at, {2 * look.size, 2 * look.size})
                                                    : regular_polygon(at, look.size, 3),
                                .colour = look.colour,
                                .layer = look.layer});
}

}  // namespace

void Look::hash(StateHash& hash) const { hash.add(shape, size, colour, layer); }

Picture draw_looks(const World& world, const Camera& camera) {
    Picture picture{.camera = camera};
    for (const Plane& plane : world.bodies().planes())
        if (plane.normal[0] != 0 || plane.normal[1] != 0)
            picture.polygons.push_back(ground_of(plane, camera));
    world.each<Look>([&](Entity entity, const Look& look) {
        if (world.has_body(entity))
            draw(look, key_of(world, entity), to_point(world.position(entity)), picture);
    });
    return picture;
}

}  // namespace oiler
