// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/input/control.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// The name of a button for the user.
using NameButton = std::function<std::string(Button)>;

/// "Space, Mouse left" of an action, "Left and Right, left stick left/right" of
/// an axis.
[[nodiscard]] std::string buttons_of(const Control& control, const NameButton& name);

/// A button, or a control of a game, and its use.
struct HelpRow {
    std::string name;
    std::string text;
};

/// Covers an area and lists the controls of a game and the keys of the loop in it: side by side, or
/// in a narrow area one below the other.
void add_help(Picture& overlay, const OverlayArea& area, std::string_view title,
              std::span<const Control> controls, const NameButton& name,
              std::vector<HelpRow> loop_keys);

}  // namespace oiler
