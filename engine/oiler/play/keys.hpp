// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "oiler/input/control.hpp"

namespace oiler {

/// Throws Error{usage} if a control of a game has no name, the name of another one, or a button
/// that belongs to the loop.
void check_controls(std::span<const Control> controls);

/// Reads the buttons that a player chose for the controls of a game, in TOML:
///
///     fire = ["Space", "Mouse left"]   # an action
///     [aim]                            # an axis
///     negative = ["A"]
///     positive = ["D"]
///     stick = "left x"                 # or "none"
///
/// A control, or a part of an axis, that the text does not name keeps its buttons. Throws
/// Error{usage} with file, line and remedy.
[[nodiscard]] std::vector<Control> parse_keys(std::string_view text, std::string_view file,
                                              std::span<const Control> controls);

}  // namespace oiler
