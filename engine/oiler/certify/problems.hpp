// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "oiler/sim/bodies.hpp"

namespace oiler::certify {

/// Bodies whose exact motion over one second is known in long double.
struct Problem {
    std::string_view name;
    int axes;
    bool linear;  ///< whether all forces are linear in position and velocity
    void (*fill)(Bodies& bodies);
    State<long double, 3> (*end)(std::size_t row);  ///< after 1 s
    /// The order of a method on this problem.
    int (*order)(const Method& method, Damping damping);
};

/// A spring, an orbit, a damped spring and a fall with quadratic drag.
[[nodiscard]] std::span<const Problem> problems();

/// The bodies of a problem at t = 0.
[[nodiscard]] Bodies bodies_of(const Problem& problem, Precision precision);

}  // namespace oiler::certify
