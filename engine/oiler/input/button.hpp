// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oiler {

/// A key by its place on the keyboard, named after the US layout. Its number is that of the USB
/// standard HID Usage Tables, page 7, which is SDL's scan code, too.
enum class Key : std::uint8_t {
    // clang-format off
    a = 4, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    n1 = 30, n2, n3, n4, n5, n6, n7, n8, n9, n0,
    enter = 40, escape, backspace, tab, space,
    minus, equals, left_bracket, right_bracket, backslash,
    semicolon = 51, apostrophe, grave, comma, period, slash, caps_lock,
    f1 = 58, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12,  // the loop's own
    insert = 73, home, page_up, del, end, page_down, right, left, down, up,
    pad_divide = 84, pad_multiply, pad_minus, pad_plus, pad_enter,
    pad_1 = 89, pad_2, pad_3, pad_4, pad_5, pad_6, pad_7, pad_8, pad_9, pad_0, pad_period,
    left_ctrl = 224, left_shift, left_alt, left_gui, right_ctrl, right_shift, right_alt, right_gui,
    // clang-format on
};

enum class Mouse : std::uint8_t { left, middle, right, back, forward };

/// A button of a game controller by its place: `south` is A on an Xbox pad and a cross on a
/// PlayStation's. The triggers count as pressed from 0.6 on, until 0.4.
enum class Pad : std::uint8_t {
    // clang-format off
    south, east, west, north, back, guide, start, left_stick, right_stick,
    left_shoulder, right_shoulder, up, down, left, right, left_trigger, right_trigger,
    // clang-format on
};

/// An axis of a game controller. Sticks go from -1 (left, down) to 1, triggers from 0 to 1.
enum class Stick : std::uint8_t { left_x, left_y, right_x, right_y, left_trigger, right_trigger };
inline constexpr std::size_t stick_count = 6;

/// The positions of sticks and triggers are integers of a recording, in units of 1/127.
using Deflection = std::int8_t;

struct StickPosition {
    Deflection x = 0;
    Deflection y = 0;
    friend bool operator==(const StickPosition&, const StickPosition&) = default;
};

/// Removes the dead zone of a stick, whose raw numbers go from -32768 to 32767. It is a circle of
/// 0.24, so that small pushes keep their direction; from there to 0.95 the length goes from 0 to 1.
[[nodiscard]] StickPosition without_dead_zone(int x, int y);

/// A trigger, from 0 to 32767, in units of 1/127.
[[nodiscard]] Deflection trigger_position(int raw);
/// Whether a trigger is pressed: from 0.6 on, and then until 0.4.
[[nodiscard]] bool trigger_is_pressed(bool was, int raw);

/// Anything that can be pressed.
class Button {
public:
    static constexpr std::size_t count = 320;

    constexpr Button(Key key) : id_(static_cast<std::uint16_t>(key)) {}
    constexpr Button(Mouse button) : id_(first_mouse + static_cast<std::uint16_t>(button)) {}
    constexpr Button(Pad button) : id_(first_pad + static_cast<std::uint16_t>(button)) {}

    /// The number of the button, less than `count`.
    [[nodiscard]] constexpr std::uint16_t id() const { return id_; }
    /// The button of a number; empty if there is none.
    [[nodiscard]] static std::optional<Button> of_id(std::uint16_t id);

    friend constexpr bool operator==(Button, Button) = default;

private:
    constexpr explicit Button(std::uint16_t id) : id_(id) {}

    static constexpr std::uint16_t first_mouse = 256;
    static constexpr std::uint16_t first_pad = 272;

    std::uint16_t id_;
};

/// "A", "Left", "Mouse left", "Pad south".
[[nodiscard]] std::string name_of(Button button);
/// The button of such a name, in upper or lower case; empty if there is none.
[[nodiscard]] std::optional<Button> find_button(std::string_view name);
[[nodiscard]] std::vector<std::string_view> button_names();

[[nodiscard]] std::string_view name_of(Stick stick);  ///< "left_x"
/// The stick of such a name, also in upper case and with a space; empty if there is none.
[[nodiscard]] std::optional<Stick> find_stick(std::string_view name);
[[nodiscard]] std::span<const std::string_view> stick_names();

/// The keys that control the loop, F1 to F12: no game sees them.
[[nodiscard]] constexpr bool is_of_loop(Button button) {
    return button.id() >= Button(Key::f1).id() && button.id() <= Button(Key::f12).id();
}

/// Up to eight buttons of which any one counts.
class Buttons {
public:
    static constexpr std::size_t most = 8;

    constexpr Buttons() = default;
    constexpr Buttons(Button one) : Buttons({one}) {}
    constexpr Buttons(Key one) : Buttons(Button(one)) {}
    constexpr Buttons(Mouse one) : Buttons(Button(one)) {}
    constexpr Buttons(Pad one) : Buttons(Button(one)) {}
    constexpr Buttons(std::initializer_list<Button> buttons) {
        for (const Button button : buttons) add(button);
    }
    constexpr void add(Button one) { ids_[size_++] = one; }

    [[nodiscard]] constexpr const Button* begin() const { return ids_.data(); }
    [[nodiscard]] constexpr const Button* end() const { return ids_.data() + size_; }
    [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
    [[nodiscard]] constexpr std::size_t size() const { return size_; }

    friend constexpr bool operator==(const Buttons&, const Buttons&) = default;

private:
    std::array<Button, most> ids_{Key::a, Key::a, Key::a, Key::a, Key::a, Key::a, Key::a, Key::a};
    std::size_t size_ = 0;
};

/// A thing that a player does, with the buttons that do it unless the player chooses others:
/// `static constexpr Action fire{"fire", Key::space, Mouse::left, Pad::south};`
struct Action {
    std::string_view name;
    Buttons buttons;

    template <class... Which>
    constexpr Action(std::string_view its_name, Which... which)
        : name(its_name), buttons({Button(which)...}) {}
};

/// A direction from -1 to 1, from buttons and a stick:
/// `static constexpr Axis aim{"aim", Key::left, Key::right, Stick::left_x};`
struct Axis {
    std::string_view name;
    Buttons negative;
    Buttons positive;
    std::optional<Stick> stick;

    constexpr Axis(std::string_view its_name, Buttons towards_minus, Buttons towards_plus,
                   std::optional<Stick> its_stick = {})
        : name(its_name), negative(towards_minus), positive(towards_plus), stick(its_stick) {}
};

/// The buttons and the stick that a player has for an action or an axis.
struct Binding {
    bool is_axis = false;
    Buttons negative{};  ///< of an axis
    Buttons positive{};  ///< of an axis; else all buttons of the action
    std::optional<Stick> stick{};

    friend constexpr bool operator==(const Binding&, const Binding&) = default;
};

/// An action or an axis in the list of a game, and the buttons that a player chose for it.
struct Control : Binding {
    std::string_view name;

    constexpr Control(const Action& action)
        : Binding{.positive = action.buttons}, name(action.name) {}
    constexpr Control(const Axis& axis)
        : Binding{true, axis.negative, axis.positive, axis.stick}, name(axis.name) {}

    friend constexpr bool operator==(const Control&, const Control&) = default;
};

}  // namespace oiler
