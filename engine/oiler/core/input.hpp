// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace oiler {

/// The keys of a game. A surface translates its own codes to these. P, Q, Escape, period, minus and
/// equals also control the loop.
enum class Key : std::uint8_t {
    space,
    enter,
    escape,
    left,
    right,
    up,
    down,
    a,
    d,
    p,
    q,
    s,
    w,
    period,
    minus,
    equals,
};

/// The keyboard during one fixed step. It is a plain value: a step is a pure function of state and
/// input, and a recording is a list of inputs.
class Input {
public:
    /// True while the key is down.
    [[nodiscard]] bool held(Key key) const { return (held_ & bit(key)) != 0; }
    /// True for the one step after the key went down, however long it is held.
    [[nodiscard]] bool pressed(Key key) const { return (pressed_ & bit(key)) != 0; }

    void press(Key key) {
        held_ |= bit(key);
        pressed_ |= bit(key);
    }
    void release(Key key) { held_ &= ~bit(key); }
    /// Copies the held keys of `frame` and adds its presses to those that no step has seen yet.
    void gather(const Input& frame) {
        held_ = frame.held_;
        pressed_ |= frame.pressed_;
    }
    /// Call this after a step has seen the presses.
    void forget_presses() { pressed_ = 0; }

    friend bool operator==(const Input&, const Input&) = default;

private:
    static constexpr std::uint32_t bit(Key key) { return 1U << static_cast<unsigned>(key); }

    std::uint32_t held_ = 0;
    std::uint32_t pressed_ = 0;
};

}  // namespace oiler
