// SPDX-License-Identifier: MIT
#include "oiler/game/look.hpp"

#include <cmath>

#include "oiler/picture/shapes.hpp"
#include "oiler/picture/solids.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

/// Draws obstacles in the colours of the ground.
class Ground {
public:
    Ground(const Obstacle& obstacle, ObstacleHandle handle, const ObstacleColours& colours,
           Picture& picture)
        : solid_{.key = key_of_obstacle(handle.slot, handle.generation),
                 .fill = palette::pale,
                 .line = palette::grey,
                 .outline = 1.5F},
          picture_(picture) {
        if (const auto given = colours.find(handle); given != colours.end()) {
            solid_.fill = given->second;
            const bool is_line = std::holds_alternative<SegmentShape>(obstacle.shape);
            if (is_line || obstacle.one_way) solid_.line = given->second;
        } else if (obstacle.one_way) {
            solid_.fill = solid_.line;  // faded
        }
        // Ground that stands is drawn where the camera is: it does not move.
        const bool is_plane = std::holds_alternative<HalfSpaceShape>(obstacle.shape);
        if (is_plane && obstacle.velocity == Vec3{} && !obstacle.swing) solid_.key = {};
        if (!obstacle.solid) solid_.fill = palette::faded(solid_.fill, 0x40);
        if (obstacle.one_way) solid_.one_way = to_point(*obstacle.one_way);
        std::visit(*this, obstacle.shape);
    }

    /// The side of a plane that bodies do not reach, as far as the camera sees.
    void operator()(const HalfSpaceShape& plane) const {
        const double size = std::hypot(plane.normal[0], plane.normal[1]);
        if (size == 0) return;
        const Vec3 normal = plane.normal / size;
        const Vec3 along{-normal[1], normal[0]};
        const Vec3 centre = to_vec(picture_.camera.centre);
        const Vec3 at = centre + (plane.offset / size - dot(normal, centre)) * normal;
        const double reach = 4 * picture_.camera.height;
        draw_block(solid_,
                   {to_point(at - reach * along), to_point(at + reach * along),
                    to_point(at + reach * along - reach * normal),
                    to_point(at - reach * along - reach * normal)},
                   picture_);
    }
    void operator()(const CircleShape& circle) const {
        draw_circle(solid_, to_point(circle.centre), static_cast<float>(circle.radius), picture_);
    }
    void operator()(const BoxShape& box) const {
        draw_block(
            solid_,
            rectangle(to_point(box.centre), to_point(box.size), static_cast<float>(box.angle)),
            picture_);
    }
    void operator()(const SegmentShape& segment) const {
        draw_wall(solid_, {to_point(segment.from), to_point(segment.to)},
                  picture_.camera.height / 60, picture_);
    }

private:
    Solid solid_;
    Picture& picture_;
};

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

Picture draw_looks(const World& world, const Camera& camera, const ObstacleColours& colours) {
    Picture picture{.camera = camera};
    for (const ObstacleHandle handle : world.bodies().obstacles())
        Ground(world.bodies().obstacle(handle), handle, colours, picture);
    world.each<Look>([&](Entity entity, const Look& look) {
        if (world.has_body(entity))
            draw(look, key_of(world, entity), to_point(world.position(entity)), picture);
    });
    return picture;
}

}  // namespace oiler
