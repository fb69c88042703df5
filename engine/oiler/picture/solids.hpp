// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// How something solid is drawn. What is solid from one side only is faded, and has a line on that
/// side.
struct Solid {
    ElementKey key{};  ///< the part is free for the elements of the solid
    Colour fill{};
    Colour line{};
    float outline = 0;               ///< width in units of the canvas; 0: none
    std::optional<Point> one_way{};  ///< the direction from which it is solid, within 60°
};

/// The key of an obstacle, never that of an entity.
[[nodiscard]] constexpr ElementKey key_of_obstacle(std::uint32_t slot, std::uint32_t generation) {
    return {.object = std::uint64_t{1} << 63U | std::uint64_t{generation} << 32U | slot};
}

/// Draws a disc. Its outline is inside of it, so that bodies that touch it do not cover that.
void draw_circle(const Solid& solid, Point centre, float radius, Picture& picture);
/// Draws a convex polygon with its corners in anticlockwise order.
void draw_block(const Solid& solid, std::vector<Point> corners, Picture& picture);
/// Draws a wall without a thickness. `shade` is the width, m, of the faded strip behind a wall
/// that is solid from one side.
void draw_wall(const Solid& solid, std::vector<Point> points, float shade, Picture& picture);

}  // namespace oiler
