// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bitset>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/input/control.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// A button that went down or up.
struct Edge {
    Button button;
    bool down;
    friend bool operator==(const Edge&, const Edge&) = default;
};

using HeldButtons = std::bitset<Button::count>;

/// The place of the mouse, in units of the canvas, and the camera of the picture that was on
/// screen.
struct Pointer {
    Point canvas{};
    Camera camera{};
    friend bool operator==(const Pointer&, const Pointer&) = default;
};

struct InputEvent;

/// The controls of a game with the buttons that its player chose; null: with the game's own.
using ChosenControls = std::shared_ptr<const std::vector<Control>>;

/// The actions of a player in one fixed step. It is a plain value: a step is a pure function of
/// state and input, and a recording is a list of inputs.
///
/// Every press is seen by one step, and every release by one, whatever the frame rate. A step that
/// sees a press also sees the button held, even if it is up again: the next step sees the release.
class Input {
public:
    /// Whether a button, or any button of an action, is down.
    [[nodiscard]] bool held(Button button) const { return held_[button.id()]; }
    [[nodiscard]] bool held(const Action& action) const;
    /// Whether it went down since the last step. An action goes down with the first of its buttons,
    /// and up with the last.
    template <class What>
    [[nodiscard]] bool pressed(const What& what) const {
        return presses(what) > 0;
    }
    template <class What>
    [[nodiscard]] bool released(const What& what) const {
        return releases(what) > 0;
    }
    /// The number of times that it went down since the last step.
    [[nodiscard]] int presses(Button button) const { return count(Buttons(button), true); }
    [[nodiscard]] int presses(const Action& action) const {
        return count(buttons_of(action), true);
    }
    [[nodiscard]] int releases(Button button) const { return count(Buttons(button), false); }
    [[nodiscard]] int releases(const Action& action) const {
        return count(buttons_of(action), false);
    }

    /// The sum of buttons and stick, limited to -1 to 1.
    [[nodiscard]] float axis(const Axis& axis) const;
    /// The direction of two axes, no longer than 1.
    [[nodiscard]] Point direction(const Axis& x, const Axis& y) const;
    /// From -1 to 1, of triggers from 0 to 1. The dead zone is removed.
    [[nodiscard]] float stick(Stick stick) const {
        return static_cast<float>(sticks_[static_cast<std::size_t>(stick)]) / 127;
    }

    /// The place of the mouse, m in the world that was on screen; empty if it is outside the
    /// window.
    [[nodiscard]] std::optional<Point> pointer() const;
    /// The place of the mouse in units of the canvas.
    [[nodiscard]] std::optional<Point> pointer_canvas() const;
    /// Whether the mouse moved since the last step, or came into the window. A mouse at rest should
    /// not override keys.
    [[nodiscard]] bool pointer_moved() const { return pointer_moved_; }
    /// Notches that the wheel was turned since the last step, away from the user.
    [[nodiscard]] int wheel() const { return wheel_; }
    /// Text entered since the last step, UTF-8, while Loop::text_input is on.
    [[nodiscard]] std::string_view text() const { return text_; }
    /// Whether the loop makes the game anew before this step.
    [[nodiscard]] bool restarts() const { return restarts_; }

    friend bool operator==(const Input&, const Input&) = default;

private:
    friend class InputQueue;
    friend std::vector<InputEvent> events_between(const Input& before, const Input& now);

    [[nodiscard]] int count(const Buttons& buttons, bool down) const;
    [[nodiscard]] const Control* chosen(std::string_view name) const;
    [[nodiscard]] const Buttons& buttons_of(const Action& action) const;

    HeldButtons before_;  ///< at the start of the edges
    HeldButtons held_;
    std::vector<Edge> edges_;
    std::array<Deflection, stick_count> sticks_{};
    std::optional<Pointer> pointer_;
    bool pointer_moved_ = false;
    int wheel_ = 0;
    std::string text_;
    bool restarts_ = false;
    ChosenControls controls_;
};

/// Hands the input of a player to fixed steps. Events may come at any time, many or none between
/// two steps. All events since the last step go to the next one.
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

    /// Continues after the step that saw `last`: held buttons change from there, and all other
    /// input since is dropped.
    void continue_after(const Input& last);

    /// The input of the next step. `shown` is the camera of the picture on screen.
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
