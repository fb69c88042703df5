// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/closed_forms.hpp"

namespace oiler::lab {

/// A motion with linear forces: x'' = acceleration − k·x − c·x'.
struct LinearMotion {
    Vec<long double, 3> acceleration{};  ///< m/s², at the origin
    long double k = 0;                   ///< 1/s²
    long double c = 0;                   ///< 1/s
    State<long double, 3> start{};

    /// The point where a spring balances the acceleration; the origin without a spring.
    Vec<long double, 3> rest = k > 0 ? acceleration*(1 / k) : Vec<long double, 3>{};
};

/// The motions from (1 m, 0 m/s), from (0 m, 1 m/s), and from rest under 1 m/s². Each motion with
/// these k and c is a sum of them.
struct LinearFactors {
    oiler::Motion<long double> from_x;
    oiler::Motion<long double> from_v;
    oiler::Motion<long double> pushed;
};

/// The factors after t s.
[[nodiscard]] LinearFactors factors_at(const LinearMotion& motion, long double t);

/// The state that follows `start` after the time of the factors.
[[nodiscard]] State<long double, 3> state_after(const LinearMotion& motion,
                                                const State<long double, 3>& start,
                                                const LinearFactors& factors);

}  // namespace oiler::lab
