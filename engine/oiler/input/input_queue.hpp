// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "oiler/input/input.hpp"

namespace oiler {

/// Hands what a player does to fixed steps. Events may come at any time, many or none between two
/// steps. All events since the last step go to the next one.
class InputQueue {
public:
    InputQueue() = default;
    /// With the buttons that the player chose for actions and axes.
    explicit InputQueue(std::shared_ptr<const std::vector<Control>> controls)
        : controls_(std::move(controls)) {}

    /// A button goes down or up. Repeats are ignored.
    void set(Button button, bool down);
    /// All buttons go up and all sticks to rest, as when a window loses the keyboard.
    void release_all();
    /// The mouse is at a place of the canvas, rounded to 1/16 unit, or outside the window.
    void point_at(std::optional<Point> canvas);
    void turn_wheel(int notches) {
        if (!paused_) next_.wheel_ += notches;
    }
    void deflect(Stick stick, Deflection deflection) {
        next_.sticks_[static_cast<std::size_t>(stick)] = deflection;
    }
    void enter(std::string_view text) {
        if (!paused_) next_.text_ += text;
    }
    /// Makes the game anew before the next step.
    void restart() { next_.restarts_ = true; }
    /// While the loop is paused, taps are dropped: the next step sees a press of a button only if
    /// it is still down.
    void set_paused(bool paused);

    /// What the next step sees. `shown` is the camera of the picture on screen.
    [[nodiscard]] Input take(const Camera& shown);

private:
    void drop_taps();

    Input next_;       ///< `held_` is what the last step saw
    HeldButtons now_;  ///< after all edges
    HeldButtons at_pause_;
    bool paused_ = false;
    std::shared_ptr<const std::vector<Control>> controls_;
};

}  // namespace oiler
