// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "oiler/whatif/what_if.hpp"

namespace oiler {

/// One sentence on the error of the timestep: the largest error that a player could see, and its
/// cure.
struct Verdict {
    using Grade = oiler::Grade;

    Grade grade = Grade::unknown;
    std::string text{};
};

/// Judges the recorded setting, the first of the runs, which begins at `begin`, s. The sentence
/// names a failure, else other events, else a wrong reading, else the body with the largest error.
/// Then it names the cure: the cheapest other run with an error below a pixel, or else the most
/// accurate one.
///
/// A reading in m is wrong if its error exceeds a pixel, in another unit if it exceeds 1 %.
/// Readings that changed since `before` are not judged: they may be a step late, which is no error.
/// Only certain errors are named, see KnownError. Prices below 10 µs a frame are not compared.
[[nodiscard]] Verdict judge_setting(const WhatIf& measured, const std::vector<Reading>& before,
                                    double begin,
                                    const std::function<std::string(Entity)>& name_of);

/// The least time that can be measured reliably beside a game, ns a frame.
inline constexpr double least_cost = 10'000;

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
/// is measured.
[[nodiscard]] std::string rate_advice_text(const WhatIf& measured);

}  // namespace oiler
