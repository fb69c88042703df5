// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace oiler::test {

/// Random numbers of a seed, the same with every standard library.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}

    /// In [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    /// From low to high.
    int whole(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    /// From 0 to `count` − 1.
    std::size_t below(std::size_t count) { return engine_() % count; }
    bool chance(double share) { return uniform(0, 1) < share; }
    double sign() { return chance(0.5) ? 1 : -1; }

private:
    std::mt19937_64 engine_;
};

}  // namespace oiler::test
