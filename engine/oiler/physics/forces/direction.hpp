// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/vec.hpp"

namespace oiler {

/// The length and the unit vector of `d`. Both are 0 if |d|² underflows to 0: below 10⁻²³ m in
/// float and 10⁻¹⁶² m in double.
template <Number V, int Axes>
struct Direction {
    V length;
    V inverse_length;  ///< 0 for length 0
    Vec<V, Axes> unit;

    [[gnu::always_inline]] explicit constexpr Direction(const Vec<V, Axes>& d) {
        using std::sqrt;
        length = sqrt(squared_length(d));
        inverse_length = quotient_or_zero(V(1), length);
        unit = d * inverse_length;
    }
};

}  // namespace oiler
