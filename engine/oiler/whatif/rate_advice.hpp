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
    bool is_measured;   ///< a run has that rate; else it is what the runs at other rates promise
};

/// The lowest rate that was measured to be within a pixel. Else, where errors shrink with the rate
/// as those of a method of some order do, the lowest offered multiple of the played rate that
/// leaves half a pixel to spare. Empty if there is none, or nothing is certain.
[[nodiscard]] std::optional<RateAdvice> advise_rate(const WhatIf& measured);

/// The rates of the played method to measure next: the advised one, else rates so high that their
/// errors shrink as those of the method's order do. None if they took too much of a frame's time.
[[nodiscard]] std::vector<std::int64_t> rates_to_try(const WhatIf& measured);

/// "120 Hz of this method is within a pixel so far.", or what it takes; empty if nothing is
/// measured.
[[nodiscard]] std::string rate_advice_text(const WhatIf& measured);

}  // namespace oiler
