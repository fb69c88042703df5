// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

namespace oiler::bench {

/// Does a piece of work the given number of times.
using Work = std::function<void(long times)>;

/// The duration and the number of measurements of a piece of work.
struct Effort {
    int repetitions = 15;
    double seconds = 0.001;  ///< the least, of each repetition
    double patience = 0.4;   ///< s, after which slow work is not repeated
    /// Whether to run the work once untimed before each repetition, because other work in between
    /// discards what it prepares.
    bool prepared = false;
};

/// Seconds that each piece of work takes once: the least of several repetitions. The pieces take
/// turns, so that other load on the machine affects all alike.
[[nodiscard]] std::vector<double> race(const std::vector<Work>& work, const Effort& effort);

/// Keeps a result and its computation from being optimised away.
template <class T>
inline void keep(const T& value) {
    asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace oiler::bench
