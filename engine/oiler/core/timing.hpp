// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace oiler {

/// A median and half the interquartile range. NaN for no values.
struct Median {
    double value = std::numeric_limits<double>::quiet_NaN();
    double spread = std::numeric_limits<double>::quiet_NaN();
};

/// The median of the finite values. Quartiles between two values are interpolated.
[[nodiscard]] inline Median median_of(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto quantile = [&](double share) {
        const double at = share * static_cast<double>(values.size() - 1);
        const auto low = static_cast<std::size_t>(at);
        const double high = values[std::min(low + 1, values.size() - 1)];
        return values[low] + (high - values[low]) * (at - static_cast<double>(low));
    };
    return {quantile(0.5), (quantile(0.75) - quantile(0.25)) / 2};
}

[[nodiscard]] inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The step in which the clock moves, s: far below 1 µs, but up to 100 µs in a page.
[[nodiscard]] double clock_step();
/// Whether the clock shows what a frame of a game costs.
[[nodiscard]] inline bool shows_costs() { return clock_step() <= 10e-6; }

}  // namespace oiler
