// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/input/input.hpp"
#include "oiler/inspector/inspector.hpp"
#include "oiler/overlay/help.hpp"

namespace oiler {

/// The panels of a window, which the player switches on and off.
struct Panels {
    bool inspector = false;
    bool help = false;
    bool large_errors = false;  ///< the inspector draws errors enlarged
    bool full_screen = false;
};

/// The use of a key since the last frame, and the state that it can change.
struct KeyUse {
    Requests& requests;
    Panels& panels;
    int presses;
    bool held;

    [[nodiscard]] bool pressed() const { return presses > 0; }
    [[nodiscard]] bool toggles() const { return presses % 2 == 1; }
};

/// A key of the loop in a window, which no game sees, or Escape, which a game may use.
struct LoopKey {
    Key key;
    std::string_view name;  ///< "pause", in one or two words
    std::string_view text;  ///< "pause, resume", for the help
    void (*act)(const KeyUse& use);
};

/// All keys of the loop, in their order on the keyboard, Escape last. The help, `--help`, the
/// remark at the start and the loop itself follow from it.
[[nodiscard]] std::span<const LoopKey> loop_keys();

/// Adds the requests that the player makes with the keys of the loop.
void add_requests(Requests& requests, Panels& panels, const Input& keys);

/// The rows of the help. Escape closes the help, and quits unless the game uses it.
[[nodiscard]] std::vector<HelpRow> help_on_loop_keys(bool escape_quits);

/// "F1 inspector, F2 help, …": the first `count` keys of the loop.
[[nodiscard]] std::string list_of_loop_keys(std::size_t count);

}  // namespace oiler
