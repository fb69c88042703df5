// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "oiler/core/state_hash.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/name.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// A component: how an entity with a body is drawn by draw_looks, and so in games without
/// `picture()`.
struct Look {
    enum class Shape : std::uint8_t { disc, square, triangle };

    Shape shape = Shape::disc;
    float size = 0.5F;  ///< m, from the centre to the edge; to the corners of a triangle
    Colour colour = palette::blue;
    int layer = 0;

    void hash(StateHash& hash) const;
};

/// The key of an entity's element in a picture. `part` distinguishes several elements of one
/// entity. Motion by `world.teleport` is not interpolated.
[[nodiscard]] inline ElementKey key_of(const World& world, Entity entity, std::uint32_t part = 0) {
    return {.object = entity.id(), .part = part, .jump = world.jumps(entity)};
}

/// x and y of a vector, for a picture.
[[nodiscard]] inline Point to_point(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1])};
}

/// A point of a picture or of the mouse, m, as a vector.
[[nodiscard]] inline Vec3 to_vec(Point point) { return {point.x, point.y}; }

/// The colours of some obstacles.
using ObstacleColours = std::unordered_map<ObstacleHandle, Colour>;

/// A picture of the bodies that have a Look, and of the obstacles of the world, which are pale if
/// they have no colour.
[[nodiscard]] Picture draw_looks(const World& world, const Camera& camera,
                                 const ObstacleColours& colours = {});

}  // namespace oiler
