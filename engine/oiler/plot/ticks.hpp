// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace oiler {

struct Range {
    double low = 0;
    double high = 1;
};

enum class Scale : std::uint8_t {
    linear,
    logarithmic,  ///< for a range above 0; values ≤ 0 are not drawn
};

/// Multiples of 1, 2 or 5 times a power of ten within the range, about `count` of them.
[[nodiscard]] std::vector<double> ticks(Range range, int count);

/// Ticks of a logarithmic axis: powers of ten, or every second, third, … power. A range with fewer
/// than three powers has 1, 2 and 5 times those, or the ticks of a linear axis if these are fewer
/// than three too.
[[nodiscard]] std::vector<double> logarithmic_ticks(Range range, int count);

/// Ticks of a linear or logarithmic axis.
[[nodiscard]] std::vector<double> ticks(Range range, Scale scale, int count);

/// 2 to 9 times the powers of ten of a logarithmic axis, for lines without labels. An axis of more
/// than four decades has none, because the lines would be too close.
[[nodiscard]] std::vector<double> minor_ticks(Range range, Scale scale);

/// Label of a tick. On a logarithmic axis, numbers of more than four digits are "2e-6" and "1e4".
[[nodiscard]] std::string tick_label(double at, Scale scale);

}  // namespace oiler
