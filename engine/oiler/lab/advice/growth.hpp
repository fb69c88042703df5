// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace oiler::lab {

/// The growth of an error with the duration of a run.
struct Growth {
    enum class Law { unfit, bounded, linear, quadratic, exponential };

    Law law = Law::unfit;
    double until = 0;  ///< s, the end of the measured time
    double error = 0;  ///< m, up to then
    double rate = 0;   ///< 1/s, of an exponential law

    /// The time at which the error passes a tolerance (m) if it continues to grow by the law, s.
    /// Infinite for a bounded error.
    [[nodiscard]] double holds_until(double tolerance) const;
};

/// Fits a law to the largest errors up to the ends of equal parts of the time up to `until`, from
/// the growth over its last three quarters.
[[nodiscard]] Growth fit_growth(const std::vector<double>& errors, double until);

/// "bounded", "grows with t"
[[nodiscard]] const char* describe(Growth::Law law);

}  // namespace oiler::lab
