// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "oiler/sim/bodies.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// A vector in the precision and the axes of columns.
template <class T, int Axes, class V>
[[nodiscard]] Vec<T, Axes> narrow(const Vec<V, 3>& given) {
    return {generate<Axes>([&](auto i) { return static_cast<T>(given.axis[i]); })};
}

/// The opposite: a vector with three axes.
template <class V, class T, int Axes>
[[nodiscard]] Vec<V, 3> widen(const Vec<T, Axes>& vector) {
    Vec<V, 3> wide{};
    for (std::size_t i = 0; i < Axes; ++i) wide.axis[i] = static_cast<V>(vector.axis[i]);
    return wide;
}

/// The columns of all bodies, for each precision and number of axes. Only the files that define
/// Bodies include this, because it takes seconds to compile.
struct AnyColumns {
    std::variant<Columns<float, 1>, Columns<float, 2>, Columns<float, 3>, Columns<double, 1>,
                 Columns<double, 2>, Columns<double, 3>, Columns<long double, 1>,
                 Columns<long double, 2>, Columns<long double, 3>>
        of;
};

}  // namespace oiler
