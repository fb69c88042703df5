// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// The time that a frame takes, ns; NaN: not measured.
struct FrameCosts {
    double update = 0;
    double step = 0;
    double picture = 0;
    double draw = 0;

    [[nodiscard]] double of_steps() const { return update + step; }
    [[nodiscard]] double total() const { return update + step + picture + draw; }
};

}  // namespace oiler
