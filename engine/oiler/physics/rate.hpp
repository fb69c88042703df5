// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace oiler
