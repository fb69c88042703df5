// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace oiler {

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

}  // namespace oiler
