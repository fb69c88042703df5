// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "oiler/input/input.hpp"
#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// The body nearest to a point, m, within the mouse's reach in a picture of that height.
/// `place_of(row)` is the position of a body, m; empty if the body is not visible.
template <class PlaceOf>
[[nodiscard]] std::optional<Entity> body_at(Point at, float height, const World& world,
                                            PlaceOf place_of) {
    constexpr double reach = 0.06;  // of the height
    std::optional<Entity> nearest;
    double least = reach * double{height};
    for (std::size_t row = 0; row < world.body_count(); ++row) {
        const std::optional<Vec3> place = place_of(row);
        if (!place) continue;
        const double distance = std::hypot((*place)[0] - at.x, (*place)[1] - at.y);
        if (distance > least) continue;
        least = distance;
        nearest = world.entity_of_row(row);
    }
    return nearest;
}

/// Keeps a body in the middle of the view. A double click on a body starts this; one on the same
/// body or beside all bodies ends it. The first click chooses the body, which may move away before
/// the second. The right mouse button shifts the view. The camera's height stays the game's.
class Follower {
public:
    /// Takes the mouse input of a frame at `time`, s. `shown` is the camera of the last picture, in
    /// which the mouse pointed.
    void look(const Input& mouse, const Camera& shown, const Picture& picture, const World& world,
              double time);
    /// Moves the camera of the picture with the body, if that is drawn.
    void move(Picture& picture) const;
    void end() { followed_.reset(); }
    [[nodiscard]] const std::optional<Entity>& followed() const { return followed_; }

private:
    struct Click {
        Point canvas{};
        double time = 0;  ///< s
        std::optional<Entity> body{};
    };

    [[nodiscard]] bool is_double(const Click& click) const;

    std::optional<Entity> followed_;
    Point aside_{};  ///< from the body to the middle of the view, m
    std::optional<Click> last_click_;
    std::optional<Point> held_;  ///< where the right button was, canvas
};

}  // namespace oiler
