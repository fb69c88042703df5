// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/matrix.hpp"

namespace oiler {

/// The derivatives of an acceleration by position (1/s²) and velocity (1/s).
template <Number V, int Axes>
struct Jacobian {
    Matrix<V, Axes> dx{};
    Matrix<V, Axes> dv{};
};

}  // namespace oiler
