// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

namespace oiler::bench {

/// Does a piece of work so many times.
using Work = std::function<void(long times)>;

/// How long and how often a piece of work is timed.
struct Effort {
    int repetitions = 15;
    double seconds = 0.001;  ///< of each repetition, at least
    double patience = 0.4;   ///< s, after which slow work is not repeated again
    /// Before each repetition, do it once untimed: for work that what was done in between sets
    /// back.
    bool prepared = false;
};

/// Seconds that each piece of work takes once: the least of several repetitions, which take turns,
/// so that whatever else the machine is doing meets all of them alike.
[[nodiscard]] std::vector<double> race(const std::vector<Work>& work, const Effort& effort);

/// Keeps a result, and what leads to it, from being optimised away.
template <class T>
inline void keep(const T& value) {
    asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace oiler::bench
