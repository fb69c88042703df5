// SPDX-License-Identifier: MIT
#include "oiler/whatif/known_error.hpp"

#include <fmt/core.h>

namespace oiler {

Grade grade_of(double pixels) {
    constexpr double pixels_of_bad = 7.2;  // a hundredth of 720 lines
    if (std::isnan(pixels)) return Grade::unknown;
    return pixels > pixels_of_bad ? Grade::bad : pixels > 1 ? Grade::visible : Grade::good;
}

std::string length_text(double metres) {
    if (metres == 0) return "0 m";
    if (metres < 1e-12) return fmt::format("{:.0e} m", metres);
    if (metres < 99e-9) return fmt::format("{:.2g} nm", 1e9 * metres);
    if (metres < 9.95e-5) return fmt::format("{:.2g} µm", 1e6 * metres);
    if (metres < 0.01) return fmt::format("{:.2g} mm", 1000 * metres);
    if (metres < 0.995) return fmt::format("{:.2g} cm", 100 * metres);
    if (metres < 999.5) return fmt::format("{:.3g} m", metres);
    if (metres < 1e6) return fmt::format("{:.0f} m", metres);
    return fmt::format("{:.1e} m", metres);
}

Grade KnownError::grade(double pixel) const {
    if (state() == State::below_limit) return limit_ <= pixel ? Grade::good : Grade::unknown;
    return grade_of(error_ / pixel);
}

std::string KnownError::text(double pixel) const {
    if (state() == State::unknown) return "?";
    if (is_exact(pixel)) return "exact";
    return is_certain() ? length_text(error_) : "< " + length_text(limit_);
}

}  // namespace oiler
