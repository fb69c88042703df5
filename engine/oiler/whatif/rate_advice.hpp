// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oiler/whatif/what_if.hpp"

namespace oiler {

/// A rate at which the played method, the first of the runs, is within a pixel.
struct RateAdvice {
    std::int64_t rate;  ///< Hz
    bool is_measured;   ///< a run has that rate; else it is extrapolated
};

/// The lowest measured rate with errors below a pixel. If there is none, and if the errors converge
/// with a steady order, the lowest offered multiple of the played rate at which half a pixel is
/// expected. Empty if neither is known.
[[nodiscard]] std::optional<RateAdvice> advise_rate(const WhatIf& measured);

/// The rates of the played method to measure next: the advised one, else rates high enough to show
/// the method's order. None if they would take too much of a frame's time.
[[nodiscard]] std::vector<std::int64_t> rates_to_try(const WhatIf& measured);

/// "120 Hz of this method is within a pixel so far.", or the rate it would need; empty if nothing
/// is measured. Where the game's updates decide events, it says that those depend on the rate.
[[nodiscard]] std::string rate_advice_text(const WhatIf& measured);

}  // namespace oiler
