// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/vec.hpp"

namespace oiler {

/// The position (m) and velocity (m/s) of a body: the article's State.
template <Number V, int Axes>
struct State {
    Vec<V, Axes> x;
    Vec<V, Axes> v;
};

}  // namespace oiler
