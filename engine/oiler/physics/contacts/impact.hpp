// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "oiler/physics/state.hpp"

namespace oiler {

/// What happened between a body and a plane.
enum class Meeting {
    bounce,
    rest,   ///< the bounces have ended
    lifted  ///< the body was below the plane, and was moved onto it
};

/// A meeting of a body with a plane, within a step.
template <class T, int Axes>
struct ImpactOf {
    Meeting kind;
    std::size_t plane;    ///< its index
    T after_start;        ///< s, since the start of the step
    Vec<T, Axes> x;       ///< m, of the body
    Vec<T, Axes> before;  ///< m/s
    Vec<T, Axes> after;   ///< m/s
};

}  // namespace oiler
