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
    logarithmic,  ///< of a range above 0; what is not above 0 has no place on it
};

/// Multiples of 1, 2 or 5 times a power of ten within the range, about `count` of them.
[[nodiscard]] std::vector<double> ticks(Range range, int count);

/// The same for a logarithmic axis: powers of ten, or every second, third, … of them. Ranges that
/// hold fewer than three of them have 1, 2 and 5 times those, or else the ticks of a linear axis.
[[nodiscard]] std::vector<double> logarithmic_ticks(Range range, int count);

/// Of either.
[[nodiscard]] std::vector<double> ticks(Range range, Scale scale, int count);

/// 2 to 9 times the powers of ten of a logarithmic axis, which have lines but no labels; none where
/// it shows more than four decades, whose lines would be too close to be told apart.
[[nodiscard]] std::vector<double> minor_ticks(Range range, Scale scale);

/// A logarithmic axis, which may go far beyond numbers of four digits, has "2e-6" and "1e4" there.
[[nodiscard]] std::string tick_label(double at, Scale scale);

}  // namespace oiler
