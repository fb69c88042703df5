// SPDX-License-Identifier: MIT
#include "oiler/whatif/known_error.hpp"

#include <fmt/core.h>

#include "oiler/core/length_text.hpp"

namespace oiler {

Grade grade_of(double pixels) {
    constexpr double pixels_of_bad = 7.2;  // a hundredth of 720 lines
    if (std::isnan(pixels)) return Grade::unknown;
    return pixels > pixels_of_bad ? Grade::bad : pixels > 1 ? Grade::visible : Grade::good;
}

std::string amount_text(double size, std::string_view unit) {
    if (unit == "m") return length_text(size);
    return fmt::format("{:.3g}{}{}", size, unit.empty() ? "" : " ", unit);
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
