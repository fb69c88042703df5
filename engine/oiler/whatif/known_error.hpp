// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace oiler {

/// The visibility of an error to a player.
enum class Grade {
    unknown,
    good,     ///< below a pixel
    visible,  ///< below a hundredth of the picture's height
    bad,
};

/// The grade of an error in pixels; NaN is not known.
[[nodiscard]] Grade grade_of(double pixels);

/// The size of a difference in its unit: "7.5 cm", "0.12 m/s", "100" without one.
[[nodiscard]] std::string amount_text(double size, std::string_view unit);

/// A measured error and its limit: 10 × the uncertainty of the reference. Errors below the limit
/// are only known to be below it.
class KnownError {
public:
    enum class State {
        unknown,  ///< nothing was compared
        below_limit,
        certain,
    };

    /// NaN is unknown.
    KnownError(double error, double uncertainty) : error_(error), limit_(10 * uncertainty) {}

    [[nodiscard]] State state() const {
        if (std::isnan(error_)) return State::unknown;
        return std::abs(error_) < limit_ ? State::below_limit : State::certain;
    }
    [[nodiscard]] bool is_certain() const { return state() == State::certain; }
    [[nodiscard]] double value() const { return error_; }
    [[nodiscard]] double limit() const { return limit_; }
    /// The largest value that the error may have; NaN if it is unknown.
    [[nodiscard]] double most() const { return std::max(std::abs(error_), limit_); }
    /// Whether the error is below its limit, and that is at most a hundredth of a pixel.
    [[nodiscard]] bool is_exact(double pixel) const {
        return state() == State::below_limit && limit_ <= 0.01 * pixel;
    }

    /// The grade of an error in m; `pixel` is the height of a pixel, m.
    [[nodiscard]] Grade grade(double pixel) const;
    /// "7.5 cm", "< 2 mm", "exact", or "?" if it is unknown.
    [[nodiscard]] std::string text(double pixel) const;

private:
    double error_;
    double limit_;
};

}  // namespace oiler
