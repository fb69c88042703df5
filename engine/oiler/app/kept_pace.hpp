// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <string>

namespace oiler {

/// The pace that a computer keeps in a window, as means over about 16 frames.
class KeptPace {
public:
    /// A frame that took `work` to make, `period` after the one before, and dropped `late` of the
    /// simulated time because it came too late.
    void add(std::chrono::duration<double> work, std::chrono::duration<double> period,
             std::chrono::duration<double> late) {
        work_ += (work.count() - work_) / 16;
        if (period.count() > 0) late_ += (late / period - late_) / 16;
    }
    /// Tells that the pace or the frame rate is too low, and what helps; empty if both are kept.
    [[nodiscard]] std::string text() const {
        if (late_ > 0.1)
            return fmt::format(
                "too slow here: {:.0f} % of its pace. A lower rate or --headless helps",
                100 * (1 - late_));
        if (work_ > 0.05)
            return fmt::format("{:.0f} frames a second: fewer bodies or --headless help",
                               1 / work_);
        return {};
    }

private:
    double work_ = 0;  ///< s
    double late_ = 0;  ///< share of the period
};

}  // namespace oiler
