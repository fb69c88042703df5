// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oiler/whatif/what_if.hpp"

namespace oiler {

/// One sentence on what the timestep costs: the largest error that a player could see, and what
/// mends it.
struct Verdict {
    enum class Grade {
        unknown,
        good,     ///< below a pixel
        visible,  ///< below a hundredth of the picture's height
        bad,
    };
    Grade grade = Grade::unknown;
    std::string text{};
};

/// The grade of an error in pixels; NaN is not known.
[[nodiscard]] Verdict::Grade grade_of(double pixels);

/// Judges the recorded setting, the first of the runs. A reading in m that is off by more than a
/// pixel, or one in another unit that is off by more than a hundredth, comes first, if it is what
/// it was `before`: one that still changes may differ by a step, which is no error. Then comes the
/// body that is furthest off. The cure is the cheapest other run below a pixel, or else the best
/// one. Differences of less than ten times the uncertainty of the reference are not named. Prices
/// below 10 µs a frame are not told apart. The measured run begins at `begin`, s.
[[nodiscard]] Verdict verdict_of(const WhatIf& measured, const std::vector<Reading>& before,
                                 double begin, const std::function<std::string(Entity)>& name_of);

/// Shorter times are not certain beside a game, ns a frame.
inline constexpr double least_cost = 10'000;

/// An error that is known to be below this part of a pixel is called exact.
inline constexpr double part_of_exact = 0.01;

/// "30 nm", "2 mm", "7.5 cm", "3.1 m".
[[nodiscard]] std::string length_text(double metres);

}  // namespace oiler
