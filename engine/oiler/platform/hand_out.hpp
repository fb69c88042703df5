// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/core/size.hpp"
#include "oiler/input/input.hpp"
#include "oiler/platform/surface.hpp"

namespace oiler {

/// The place of the mouse on the canvas of a game's part of a window, both in the units of the
/// mouse.
[[nodiscard]] Point canvas_point(int x, int y, Size part);

/// The input of a window: its game, and the loop, which sees all of it.
struct Receivers {
    InputQueue& game;
    InputQueue& loop;
    Window::OfGame of_game{};

    /// `enters_text`: keys enter text, except those that edit it.
    void set_key(Button key, bool down, bool enters_text) const;
    /// A move, or with a button a press or a release. `part` is the game's part.
    void move_mouse(int x, int y, Size part, std::optional<Button> button = {},
                    bool down = false) const;
    void turn_wheel(int notches) const;
    void leave() const;
    void release_all() const;
};

}  // namespace oiler
