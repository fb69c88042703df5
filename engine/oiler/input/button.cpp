// SPDX-License-Identifier: MIT
#include "oiler/input/button.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace oiler {
namespace {

struct NamedButton {
    Button button;
    std::string_view name;
};

constexpr NamedButton named_buttons[] = {
    {Key::a, "A"},
    {Key::b, "B"},
    {Key::c, "C"},
    {Key::d, "D"},
    {Key::e, "E"},
    {Key::f, "F"},
    {Key::g, "G"},
    {Key::h, "H"},
    {Key::i, "I"},
    {Key::j, "J"},
    {Key::k, "K"},
    {Key::l, "L"},
    {Key::m, "M"},
    {Key::n, "N"},
    {Key::o, "O"},
    {Key::p, "P"},
    {Key::q, "Q"},
    {Key::r, "R"},
    {Key::s, "S"},
    {Key::t, "T"},
    {Key::u, "U"},
    {Key::v, "V"},
    {Key::w, "W"},
    {Key::x, "X"},
    {Key::y, "Y"},
    {Key::z, "Z"},
    {Key::n1, "1"},
    {Key::n2, "2"},
    {Key::n3, "3"},
    {Key::n4, "4"},
    {Key::n5, "5"},
    {Key::n6, "6"},
    {Key::n7, "7"},
    {Key::n8, "8"},
    {Key::n9, "9"},
    {Key::n0, "0"},
    {Key::enter, "Enter"},
    {Key::escape, "Escape"},
    {Key::backspace, "Backspace"},
    {Key::tab, "Tab"},
    {Key::space, "Space"},
    {Key::minus, "-"},
    {Key::equals, "="},
    {Key::left_bracket, "["},
    {Key::right_bracket, "]"},
    {Key::backslash, "\\"},
    {Key::semicolon, ";"},
    {Key::apostrophe, "'"},
    {Key::grave, "`"},
    {Key::comma, ","},
    {Key::period, "."},
    {Key::slash, "/"},
    {Key::caps_lock, "CapsLock"},
    {Key::f1, "F1"},
    {Key::f2, "F2"},
    {Key::f3, "F3"},
    {Key::f4, "F4"},
    {Key::f5, "F5"},
    {Key::f6, "F6"},
    {Key::f7, "F7"},
    {Key::f8, "F8"},
    {Key::f9, "F9"},
    {Key::f10, "F10"},
    {Key::f11, "F11"},
    {Key::f12, "F12"},
    {Key::insert, "Insert"},
    {Key::home, "Home"},
    {Key::page_up, "PageUp"},
    {Key::del, "Delete"},
    {Key::end, "End"},
    {Key::page_down, "PageDown"},
    {Key::right, "Right"},
    {Key::left, "Left"},
    {Key::down, "Down"},
    {Key::up, "Up"},
    {Key::pad_divide, "Keypad /"},
    {Key::pad_multiply, "Keypad *"},
    {Key::pad_minus, "Keypad -"},
    {Key::pad_plus, "Keypad +"},
    {Key::pad_enter, "Keypad Enter"},
    {Key::pad_1, "Keypad 1"},
    {Key::pad_2, "Keypad 2"},
    {Key::pad_3, "Keypad 3"},
    {Key::pad_4, "Keypad 4"},
    {Key::pad_5, "Keypad 5"},
    {Key::pad_6, "Keypad 6"},
    {Key::pad_7, "Keypad 7"},
    {Key::pad_8, "Keypad 8"},
    {Key::pad_9, "Keypad 9"},
    {Key::pad_0, "Keypad 0"},
    {Key::pad_period, "Keypad ."},
    {Key::left_ctrl, "LeftCtrl"},
    {Key::left_shift, "LeftShift"},
    {Key::left_alt, "LeftAlt"},
    {Key::left_gui, "LeftGui"},
    {Key::right_ctrl, "RightCtrl"},
    {Key::right_shift, "RightShift"},
    {Key::right_alt, "RightAlt"},
    {Key::right_gui, "RightGui"},
    {Mouse::left, "Mouse left"},
    {Mouse::middle, "Mouse middle"},
    {Mouse::right, "Mouse right"},
    {Mouse::back, "Mouse back"},
    {Mouse::forward, "Mouse forward"},
    {Pad::south, "Pad south"},
    {Pad::east, "Pad east"},
    {Pad::west, "Pad west"},
    {Pad::north, "Pad north"},
    {Pad::back, "Pad back"},
    {Pad::guide, "Pad guide"},
    {Pad::start, "Pad start"},
    {Pad::left_stick, "Pad left stick"},
    {Pad::right_stick, "Pad right stick"},
    {Pad::left_shoulder, "Pad left shoulder"},
    {Pad::right_shoulder, "Pad right shoulder"},
    {Pad::up, "Pad up"},
    {Pad::down, "Pad down"},
    {Pad::left, "Pad left"},
    {Pad::right, "Pad right"},
    {Pad::left_trigger, "Pad left trigger"},
    {Pad::right_trigger, "Pad right trigger"},
};

constexpr std::array<std::string_view, stick_count> names_of_sticks{
    "left_x", "left_y", "right_x", "right_y", "left_trigger", "right_trigger"};

bool equal_but_for_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char one, unsigned char other) {
                          return std::tolower(one) == std::tolower(other);
                      });
}

constexpr double full = 32767;  // of a stick or a trigger

Deflection deflection_of(double part) { return static_cast<Deflection>(std::lround(part * 127)); }

}  // namespace

std::optional<Button> Button::of_id(std::uint16_t id) {
    for (const NamedButton& one : named_buttons)
        if (one.button.id() == id) return one.button;
    return std::nullopt;
}

std::string name_of(Button button) {
    for (const NamedButton& one : named_buttons)
        if (one.button == button) return std::string(one.name);
    return "button " + std::to_string(button.id());
}

std::optional<Button> find_button(std::string_view name) {
    for (const NamedButton& one : named_buttons)
        if (equal_but_for_case(one.name, name)) return one.button;
    return std::nullopt;
}

std::vector<std::string_view> button_names() {
    std::vector<std::string_view> names;
    for (const NamedButton& one : named_buttons) names.push_back(one.name);
    return names;
}

std::string_view name_of(Stick stick) { return names_of_sticks[static_cast<std::size_t>(stick)]; }

std::optional<Stick> find_stick(std::string_view name) {
    std::string spelt(name);
    std::replace(spelt.begin(), spelt.end(), ' ', '_');
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
