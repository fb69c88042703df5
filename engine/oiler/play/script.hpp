// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/game/game.hpp"
#include "oiler/input/input_event.hpp"

namespace oiler {

/// A line of a script: what a player does before a step.
struct ScriptLine {
    std::int64_t step = 0;  ///< counted from 0
    std::vector<InputEvent> events{};
    std::optional<Point> mouse{};  ///< where it points from then on, m
};

/// Reads a script. Each line has a step and what is done before it; # begins a comment:
///
///     60 press Space         goes down, and up after the step
///     80 hold Left           goes down
///     95 release Left        goes up
///     100 mouse 3.5 -1       points at a place in the world, m
///     100 click left         presses a button of the mouse
///     120 wheel -1           turns the wheel by notches
///     130 stick left_x 0.5   deflects a stick, -1 to 1, or a trigger, 0 to 1, until the next line
///     140 text "hello"       enters text; \" and \\ are a quote and a backslash
///
/// 1.5s instead of a step is the first step that begins at 1.5 s or later. Steps do not decrease.
/// Names of keys and buttons are those of find_button; an action is its first button. Throws
/// Error{usage} with `name`, the number of the line and the remedy.
[[nodiscard]] std::vector<ScriptLine> parse_script(const std::string& text, const std::string& name,
                                                   Rate rate,
                                                   std::span<const Control> controls = {});

/// Plays a script. The mouse points through the camera of the game's picture at that step.
class ScriptInput final : public InputSource {
public:
    ScriptInput(std::vector<ScriptLine> lines, const AnyGame& game, ChosenControls controls = {})
        : lines_(std::move(lines)), game_(game), player_(std::move(controls)) {}

    [[nodiscard]] Input next(std::int64_t step) override;
    /// The steps until the last line is played.
    [[nodiscard]] std::int64_t steps() const { return lines_.empty() ? 0 : lines_.back().step + 1; }
    /// The number of lines that come after the steps so far.
    [[nodiscard]] std::size_t unplayed() const { return lines_.size() - played_; }

private:
    std::vector<ScriptLine> lines_;
    const AnyGame& game_;
    EventPlayer player_;
    std::size_t played_ = 0;
    std::optional<Point> mouse_;  ///< m
};

}  // namespace oiler
