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
    explicit InputQueue(ChosenControls controls) : controls_(std::move(controls)) {}

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

    /// The next step comes after the one that saw `last`: the buttons that are held change from
    /// there, and what else was done since is dropped.
    void continue_after(const Input& last);

    /// What the next step sees. `shown` is the camera of the picture on screen.
    [[nodiscard]] Input take(const Camera& shown);

private:
    void drop_taps();

    Input next_;       ///< `held_` is what the last step saw
    HeldButtons now_;  ///< after all edges
    HeldButtons at_pause_;
    std::optional<Point> pointed_;  ///< canvas, at the last step
    bool paused_ = false;
    ChosenControls controls_;
};

}  // namespace oiler
