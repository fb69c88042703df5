// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "oiler/input/input.hpp"
#include "oiler/overlay/drawn_bodies.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Keeps a body in the middle of the view. A double click on a body begins that; one on the same
/// body or beside all bodies ends it. The first click chooses the body, which may move away before
/// the second. The right mouse button moves the view meanwhile, and the camera's height stays that
/// of the game, so that a game may zoom.
class Follower {
public:
    /// Sees what the mouse did since the last frame, at `time`, s. `shown` is the camera of the
    /// last picture, in which the mouse pointed.
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
    Point aside_{};  ///< m, of the middle of the view from the body
    std::optional<Click> last_click_;
    std::optional<Point> held_;  ///< where the right button was, canvas
};

}  // namespace oiler
