// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <limits>
#include <utility>

namespace oiler {

/// An interval on which a function changes from not negative to negative.
template <std::floating_point T>
struct Bracket {
    T before;  ///< the function is not negative
    T after;   ///< it is negative
};

/// Narrows a bracket of `f`, whose values at its ends are `f_before` and `f_after`, until its ends
/// are two units of round-off of `after` apart, or f(before) is at most `noise`. False position
/// with the weights of the Illinois method (Dowell and Jarratt, 1971), and a bisection where three
/// iterations have not halved the bracket.
template <std::floating_point T, class F>
[[nodiscard]] Bracket<T> narrow_bracket(F f, Bracket<T> in, T f_before, T f_after, T noise) {
    constexpr int most_evaluations = 200;
    const auto width = [&] { return in.after - in.before; };
    T weight_before = f_before;
    T weight_after = f_after;
    T width_before = width();
    int stayed = 0;  // how often in a row `after` stayed (positive) or `before` (negative)
    for (int i = 1; i < most_evaluations; ++i) {
        if (f_before <= noise || width() <= 2 * std::numeric_limits<T>::epsilon() * in.after) break;
        T at = in.before + width() * (weight_before / (weight_before - weight_after));
        const bool slow = i % 3 == 0 && std::exchange(width_before, width()) < 2 * width();
        if (slow || !(at > in.before && at < in.after)) at = in.before + width() / 2;
        if (!(at > in.before && at < in.after)) break;
        const T value = f(at);
        if (value >= 0) {
            in.before = at;
            f_before = weight_before = value;
            stayed = std::max(stayed, 0) + 1;
            if (stayed > 1) weight_after /= 2;
        } else {
            in.after = at;
            weight_after = value;
            stayed = std::min(stayed, 0) - 1;
            if (stayed < -1) weight_before /= 2;
        }
    }
    return in;
}

}  // namespace oiler
