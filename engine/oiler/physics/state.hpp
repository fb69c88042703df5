// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/vec.hpp"

namespace oiler {

/// Where a body is (m) and how fast it goes (m/s): the article's State.
template <Number V, int Axes>
struct State {
    Vec<V, Axes> x;
    Vec<V, Axes> v;
};

}  // namespace oiler
