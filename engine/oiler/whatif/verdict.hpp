// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
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
/// names a failure, else a wrong reading, else other events, else the body with the largest error.
/// Then it names the cure: the cheapest other run with an error below a pixel, or else the most
/// accurate one.
///
/// A reading in m is wrong if its error exceeds a pixel, in another unit if it exceeds 1 %.
/// Readings that changed since `before` are not judged: they may be a step late, which is no error.
/// Only certain errors are named, see KnownError. Prices below 10 µs a frame are not compared, and
/// none is negative.
///
/// The grade is that of the present moment: it is unknown where the true motion is known until an
/// earlier moment only. Then the sentence says until when, and why.
[[nodiscard]] Verdict judge_setting(const WhatIf& measured, const std::vector<Reading>& before,
                                    double begin,
                                    const std::function<std::string(Entity)>& name_of);

/// The least time that can be measured reliably beside a game, ns a frame.
inline constexpr double least_cost = 10'000;

}  // namespace oiler
