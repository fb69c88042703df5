// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/core/require.hpp"

namespace oiler {

/// Random numbers, the same on every machine and with every standard library: SplitMix64 of Steele,
/// Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
class Random {
public:
    explicit constexpr Random(std::uint64_t start) : state_(start) {}

    [[nodiscard]] constexpr std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15;
        return mixed(state_);
    }
    /// A multiple of 2⁻⁵³ in [0, 1).
    [[nodiscard]] constexpr double fraction() {
        return static_cast<double>(next() >> 11) * 0x1p-53;
    }

    /// From `low` up to `high`.
    [[nodiscard]] constexpr double uniform(double low, double high) {
        return low + (high - low) * fraction();
    }
    /// A whole number from 0 to `count` - 1. Its bias is below count/2⁶⁴. Throws Mistake for 0.
    [[nodiscard]] constexpr std::uint64_t below(std::uint64_t count) {
        if (count == 0) throw_mistake("below(0): no whole number is below 0; give 1 or more");
        __extension__ using Wide = unsigned __int128;
        return static_cast<std::uint64_t>(Wide{next()} * count >> 64);
    }
    /// True in a share of calls: 0 never, 1 always.
    [[nodiscard]] constexpr bool chance(double share) { return fraction() < share; }

    friend constexpr bool operator==(const Random&, const Random&) = default;
    [[nodiscard]] constexpr std::uint64_t state() const { return state_; }

    /// Spreads a change of any bit over all bits. 0 stays 0.
    [[nodiscard]] static constexpr std::uint64_t mixed(std::uint64_t bits) {
        bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
        bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
        return bits ^ (bits >> 31);
    }

private:
    std::uint64_t state_;
};

}  // namespace oiler
