// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cassert>
#include <concepts>
#include <cstdint>

namespace oiler {

/// A fixed rate: `steps` steps per `seconds` seconds. It is a ratio of integers, so that time is
/// never accumulated.
struct Rate {
    std::int64_t steps = 60;
    std::int64_t seconds = 1;

    /// dt in s, rounded once in T if both integers are at most 2²⁴ (float) or 2⁵³ (double).
    template <std::floating_point T = double>
    [[nodiscard]] constexpr T dt() const {
        assert(steps > 0 && seconds > 0);
        return static_cast<T>(seconds) / static_cast<T>(steps);
    }
    /// The time of tick `tick`, s.
    [[nodiscard]] constexpr double time(std::int64_t tick) const {
        return static_cast<double>(tick * seconds) / static_cast<double>(steps);
    }
    friend bool operator==(const Rate&, const Rate&) = default;
};

/// Rates to choose from, Hz. They are even, so that half of each is a rate, too.
inline constexpr std::array<std::int64_t, 26> offered_rates{
    10, 12,  16,  20,  24,  30,  36,  40,  48,  50,  60,  72,  80,
    90, 100, 120, 144, 180, 200, 240, 300, 360, 480, 500, 600, 1000};

}  // namespace oiler
