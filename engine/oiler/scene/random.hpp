// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace oiler {

/// Random numbers, the same on every machine and with every standard library: SplitMix64 of Steele,
/// Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

    [[nodiscard]] constexpr std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15;
        return mixed(state_);
    }
    /// A multiple of 2⁻⁵³ in [0, 1).
    [[nodiscard]] constexpr double fraction() {
        return static_cast<double>(next() >> 11) * 0x1p-53;
    }

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
