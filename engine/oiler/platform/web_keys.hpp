// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "oiler/input/button.hpp"

namespace oiler {

/// The names of keys in `KeyboardEvent.code` (W3C, UI Events KeyboardEvent code Values), from the
/// key of the first one on.
struct KeyCodes {
    Key first;
    std::array<std::string_view, 16> names;
};

inline constexpr KeyCodes key_codes[]{
    {Key::enter,
     {"Enter", "Escape", "Backspace", "Tab", "Space", "Minus", "Equal", "BracketLeft",
      "BracketRight", "Backslash"}},
    {Key::semicolon, {"Semicolon", "Quote", "Backquote", "Comma", "Period", "Slash", "CapsLock"}},
    {Key::insert,
     {"Insert", "Home", "PageUp", "Delete", "End", "PageDown", "ArrowRight", "ArrowLeft",
      "ArrowDown", "ArrowUp"}},
    {Key::f1, {"F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9", "F10", "F11", "F12"}},
    {Key::pad_divide,
     {"NumpadDivide", "NumpadMultiply", "NumpadSubtract", "NumpadAdd", "NumpadEnter", "Numpad1",
      "Numpad2", "Numpad3", "Numpad4", "Numpad5", "Numpad6", "Numpad7", "Numpad8", "Numpad9",
      "Numpad0", "NumpadDecimal"}},
    {Key::left_ctrl,
     {"ControlLeft", "ShiftLeft", "AltLeft", "MetaLeft", "ControlRight", "ShiftRight", "AltRight",
      "MetaRight"}}};

/// The key of a name such as "KeyA", "Digit1", "ArrowUp"; empty if Oiler has none.
[[nodiscard]] constexpr std::optional<Key> key_of_code(std::string_view code) {
    const auto after = [](Key first, std::size_t places) {
        return static_cast<Key>(static_cast<std::size_t>(first) + places);
    };
    const char last = code.empty() ? '\0' : code.back();
    if (code.size() == 4 && code.starts_with("Key") && last >= 'A' && last <= 'Z')
        return after(Key::a, static_cast<std::size_t>(last - 'A'));
    if (code.size() == 6 && code.starts_with("Digit") && last >= '0' && last <= '9')
        return last == '0' ? Key::n0 : after(Key::n1, static_cast<std::size_t>(last - '1'));
    for (const auto& [first, names] : key_codes)
        for (std::size_t i = 0; i < names.size(); ++i)
            if (!code.empty() && names[i] == code) return after(first, i);
    return std::nullopt;
}

/// The buttons of a controller in the order of the standard layout (W3C, Gamepad).
inline constexpr std::array pads_of_dom{Pad::south,        Pad::east,          Pad::west,
                                        Pad::north,        Pad::left_shoulder, Pad::right_shoulder,
                                        Pad::left_trigger, Pad::right_trigger, Pad::back,
                                        Pad::start,        Pad::left_stick,    Pad::right_stick,
                                        Pad::up,           Pad::down,          Pad::left,
                                        Pad::right,        Pad::guide};

/// The mouse buttons in the order of `MouseEvent.button` (W3C, UI Events).
inline constexpr std::array mouse_buttons_of_dom{Mouse::left, Mouse::middle, Mouse::right,
                                                 Mouse::back, Mouse::forward};

}  // namespace oiler
