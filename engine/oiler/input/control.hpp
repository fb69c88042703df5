// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "oiler/input/button.hpp"

namespace oiler {

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

/// An action of a player, with its buttons unless the player chooses others:
/// `static constexpr Action fire{"fire", Key::space, Mouse::left, Pad::south};`
struct Action {
    std::string_view name;
    Buttons buttons;

    template <class... Which>
    constexpr Action(std::string_view its_name, Which... which)
        : name(its_name), buttons({Button(which)...}) {}
};

/// Whether the game also reads the mouse for an axis: the help then names it.
enum class ByMouse : bool { no, yes };

/// A direction from -1 to 1, from buttons and a stick:
/// `static constexpr Axis aim{"aim", Key::left, Key::right, Stick::left_x};`
struct Axis {
    std::string_view name;
    Buttons negative;
    Buttons positive;
    std::optional<Stick> stick;
    ByMouse by_mouse;

    constexpr Axis(std::string_view its_name, Buttons towards_minus, Buttons towards_plus,
                   std::optional<Stick> its_stick = {}, ByMouse its_mouse = ByMouse::no)
        : name(its_name),
          negative(towards_minus),
          positive(towards_plus),
          stick(its_stick),
          by_mouse(its_mouse) {}
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
    ByMouse by_mouse = ByMouse::no;

    constexpr Control(const Action& action)
        : Binding{.positive = action.buttons}, name(action.name) {}
    constexpr Control(const Axis& axis)
        : Binding{true, axis.negative, axis.positive, axis.stick},
          name(axis.name),
          by_mouse(axis.by_mouse) {}

    friend constexpr bool operator==(const Control&, const Control&) = default;
};

}  // namespace oiler
