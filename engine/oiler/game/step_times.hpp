// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace oiler {

/// The times that steps of a game take, summed up.
struct StepTimes {
    std::chrono::nanoseconds update{0};
    std::chrono::nanoseconds step{0};  ///< of the world
};

/// Adds the time from its construction to its destruction to one of the sums. Without sums it
/// measures nothing.
class Stopwatch {
public:
    Stopwatch(StepTimes* sums, std::chrono::nanoseconds StepTimes::*which)
        : sum_(sums ? &(sums->*which) : nullptr) {
        if (sum_) begin_ = Clock::now();
    }
    ~Stopwatch() {
        if (sum_) *sum_ += Clock::now() - begin_;
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    using Clock = std::chrono::steady_clock;

    std::chrono::nanoseconds* sum_;
    Clock::time_point begin_{};
};

}  // namespace oiler
