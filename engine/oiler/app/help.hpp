// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "oiler/input/control.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// The layer of what the loop draws: over all that games draw.
inline constexpr int overlay_layer = std::numeric_limits<int>::max();

/// The name of a button for the user.
using NameButton = std::function<std::string(Button)>;

/// "Space, Mouse left" of an action, "Left and Right, stick left_x" of an axis.
[[nodiscard]] std::string buttons_of(const Control& control, const NameButton& name);

/// Covers a picture and lists the controls of a game and the keys of the loop over it.
void add_help(Picture& picture, std::string_view title, std::span<const Control> controls,
              const NameButton& name, bool escape_quits);

}  // namespace oiler
