// SPDX-License-Identifier: MIT
#include "oiler/input/button.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace oiler {
namespace {

/// The names of buttons whose numbers follow each other.
struct NamedButtons {
    Button first;
    std::span<const std::string_view> names;
};

constexpr std::string_view writing_keys[]{
    "A",     "B",      "C",         "D",   "E",     "F", "G", "H", "I", "J", "K", "L",
    "M",     "N",      "O",         "P",   "Q",     "R", "S", "T", "U", "V", "W", "X",
    "Y",     "Z",      "1",         "2",   "3",     "4", "5", "6", "7", "8", "9", "0",
    "Enter", "Escape", "Backspace", "Tab", "Space", "-", "=", "[", "]", "\\"};
constexpr std::string_view keys_from_semicolon[]{";",  "'",  "`",   ",",   ".",  "/",  "CapsLock",
                                                 "F1", "F2", "F3",  "F4",  "F5", "F6", "F7",
                                                 "F8", "F9", "F10", "F11", "F12"};
constexpr std::string_view moving_keys[]{"Insert",   "Home",  "PageUp", "Delete", "End",
                                         "PageDown", "Right", "Left",   "Down",   "Up"};
constexpr std::string_view keypad[]{"Keypad /",     "Keypad *", "Keypad -", "Keypad +",
                                    "Keypad Enter", "Keypad 1", "Keypad 2", "Keypad 3",
                                    "Keypad 4",     "Keypad 5", "Keypad 6", "Keypad 7",
                                    "Keypad 8",     "Keypad 9", "Keypad 0", "Keypad ."};
constexpr std::string_view modifiers[]{"LeftCtrl",  "LeftShift",  "LeftAlt",  "LeftGui",
                                       "RightCtrl", "RightShift", "RightAlt", "RightGui"};
constexpr std::string_view mouse_buttons[]{"Mouse left", "Mouse middle", "Mouse right",
                                           "Mouse back", "Mouse forward"};
constexpr std::string_view pad_buttons[]{
    "Pad south",        "Pad east",          "Pad west",           "Pad north",
    "Pad back",         "Pad guide",         "Pad start",          "Pad left stick",
    "Pad right stick",  "Pad left shoulder", "Pad right shoulder", "Pad up",
    "Pad down",         "Pad left",          "Pad right",          "Pad left trigger",
    "Pad right trigger"};

constexpr NamedButtons all_buttons[]{
    {Key::a, writing_keys},    {Key::semicolon, keys_from_semicolon}, {Key::insert, moving_keys},
    {Key::pad_divide, keypad}, {Key::left_ctrl, modifiers},           {Mouse::left, mouse_buttons},
    {Pad::south, pad_buttons}};

/// Empty for a number that no button has.
constexpr std::string_view name_of_id(std::uint16_t id) {
    for (const auto& [first, names] : all_buttons)
        if (id >= first.id() && id < first.id() + names.size()) return names[id - first.id()];
    return {};
}
constexpr bool is_named(Button button, std::string_view name) {
    return name_of_id(button.id()) == name;
}
static_assert(is_named(Key::backslash, "\\") && is_named(Key::f12, "F12") &&
              is_named(Key::up, "Up") && is_named(Key::pad_period, "Keypad .") &&
              is_named(Key::right_gui, "RightGui") && is_named(Mouse::forward, "Mouse forward") &&
              is_named(Pad::right_trigger, "Pad right trigger"));

constexpr std::array<std::string_view, stick_count> names_of_sticks{
    "left_x", "left_y", "right_x", "right_y", "left_trigger", "right_trigger"};

constexpr std::array<std::string_view, stick_count> descriptions_of_sticks{
    "left stick left/right", "left stick up/down", "right stick left/right",
    "right stick up/down",   "left trigger",       "right trigger"};

bool equal_but_for_case(std::string_view a, std::string_view b) {
    const auto lower = [](unsigned char letter) { return std::tolower(letter); };
    return std::ranges::equal(a, b, {}, lower, lower);
}

constexpr double full = 32767;  // of a stick or a trigger

Deflection deflection_of(double part) { return static_cast<Deflection>(std::lround(part * 127)); }

}  // namespace

std::optional<Button> Button::of_id(std::uint16_t id) {
    return name_of_id(id).empty() ? std::nullopt : std::optional(Button(id));
}

std::string name_of(Button button) {
    const std::string_view name = name_of_id(button.id());
    return name.empty() ? "button " + std::to_string(button.id()) : std::string(name);
}

std::optional<Button> find_button(std::string_view name) {
    for (std::uint16_t id = 0; id < Button::count; ++id)
        if (equal_but_for_case(name_of_id(id), name)) return Button::of_id(id);
    return std::nullopt;
}

std::vector<std::string_view> button_names() {
    std::vector<std::string_view> names;
    for (const NamedButtons& some : all_buttons)
        names.insert(names.end(), some.names.begin(), some.names.end());
    return names;
}

std::string_view name_of(Stick stick) { return names_of_sticks[static_cast<std::size_t>(stick)]; }

std::string_view describe(Stick stick) {
    return descriptions_of_sticks[static_cast<std::size_t>(stick)];
}

std::optional<Stick> find_stick(std::string_view name) {
    std::string spelt(name);
    std::ranges::replace(spelt, ' ', '_');
    for (std::size_t i = 0; i < stick_count; ++i)
        if (equal_but_for_case(names_of_sticks[i], spelt)) return static_cast<Stick>(i);
    return std::nullopt;
}

std::span<const std::string_view> stick_names() { return names_of_sticks; }

StickPosition without_dead_zone(int x, int y) {
    constexpr double inner = 0.24;
    constexpr double outer = 0.95;
    const double length = std::hypot(x, y) / full;
    if (!(length > inner)) return {};
    const double scale = std::min((length - inner) / (outer - inner), 1.0) / (length * full);
    return {deflection_of(x * scale), deflection_of(y * scale)};
}

Deflection trigger_position(int raw) { return deflection_of(std::clamp(raw / full, 0.0, 1.0)); }

bool trigger_is_pressed(bool was, int raw) { return raw / full >= (was ? 0.4 : 0.6); }

}  // namespace oiler
