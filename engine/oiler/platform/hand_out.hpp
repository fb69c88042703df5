// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/core/size.hpp"
#include "oiler/input/input.hpp"
#include "oiler/platform/surface.hpp"

namespace oiler {

/// The input of a window: its game, and the loop, which sees all of it.
struct Receivers {
    InputQueue& game;
    InputQueue& loop;
    Window::OfGame of_game{};

    /// `enters_text`: keys enter text, except those that edit it.
    void set_key(Button key, bool down, bool enters_text) const;
    /// A move, or with a button a press or a release. Place and `part`, the game's part, are in the
    /// units of the mouse.
    void move_mouse(int x, int y, Size part, std::optional<Button> button = {},
                    bool down = false) const;
    void turn_wheel(int notches) const;
    void leave() const;
    void release_all() const;
};

}  // namespace oiler
