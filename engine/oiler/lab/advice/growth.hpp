// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace oiler::lab {

/// The growth of a setting's error with the duration of a run: errors at the steps grow by a law,
/// and lines between steps add a constant.
struct Growth {
    enum class Law {
        unfit,
        round_off,
        bounded,
        linear,
        quadratic,
        faster_than_linear,
        exponential
    };

    Law law = Law::unfit;
    double until = 0;      ///< s, the end of the measured time
    double at_steps = 0;   ///< m, the error at the steps up to then
    double lines = 0;      ///< m, added by the lines between steps
    double constant = 0;   ///< m, of a law in powers of t
    double linear = 0;     ///< m/s
    double quadratic = 0;  ///< m/s²
    double rate = 0;       ///< 1/s, of an exponential law
    /// s, at which a longer run passes the tolerance; infinite if it does not.
    double passed = std::numeric_limits<double>::infinity();

    /// The time at which the error as drawn passes a tolerance (m), s, if it continues to grow by
    /// the law; `until` if it has passed it before. Infinite for a bounded error, and beyond 1000 ×
    /// the measured time. A run that passed it earlier counts.
    [[nodiscard]] double holds_until(double tolerance) const;
};

/// Fits a law to the largest errors at the steps up to the ends of equal parts of the time up to
/// `until`. `drawn` is the error as drawn at the end, or the error at the steps if only that
/// counts. Errors up to `round_off` (m) follow no law.
[[nodiscard]] Growth fit_growth(const std::vector<double>& at_steps, double drawn, double until,
                                double round_off);

/// "bounded", "grows with t"
[[nodiscard]] const char* describe(Growth::Law law);

}  // namespace oiler::lab
