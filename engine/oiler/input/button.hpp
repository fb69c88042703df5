// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
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
/// "left stick left/right", "left trigger": for a player.
[[nodiscard]] std::string_view describe(Stick stick);
/// The stick of such a name, also in upper case and with a space; empty if there is none.
[[nodiscard]] std::optional<Stick> find_stick(std::string_view name);
[[nodiscard]] std::span<const std::string_view> stick_names();

/// The keys that control the loop, F1 to F12: no game sees them.
[[nodiscard]] constexpr bool is_of_loop(Button button) {
    return button.id() >= Button(Key::f1).id() && button.id() <= Button(Key::f12).id();
}

}  // namespace oiler
