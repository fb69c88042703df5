// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "oiler/physics/advance.hpp"
#include "oiler/physics/methods/methods.hpp"

/// Errors of order p are held against size·(rate·dt)^p.
struct Scale {
    long double rate;  ///< how fast the motion changes: its Taylor series has terms (rate·t)^n
    long double size;  ///< in the unit of the error
};

/// What a halving of dt must do to an error: 2^−order, but for the next term of the error, which is
/// small by now. That term is two orders higher where the method is symmetric; else it is the next
/// order's, and where the leading term is small beside it the error may still fall faster than
/// 2^−order, or, where the two have opposite signs, a little slower.
inline void expect_fall(long double coarse, long double fine, const oiler::Method& method,
                        int order) {
    const long double slope = std::log2(coarse / fine);
    EXPECT_GE(slope, order - (method.symmetric ? 0.1L : 0.3L));
    if (method.symmetric) {
        EXPECT_LE(slope, order + 0.1L);
    }
}

/// Doubles the number of steps in a second (or in whatever rate and `error` count by) until the
/// error is below `ceiling`. On the way it stays within size·(rate·dt)^order, so that this comes to
/// pass; and the last halving of dt divides it by 2^order. An error that tended to a tenth of
/// `ceiling` instead of 0 would not.
template <class Error>
void expect_convergence(const oiler::Method& method, int order, Error error, int steps, Scale scale,
                        long double ceiling) {
    long double coarse = 0;
    long double fine = error(steps);
    while (fine >= ceiling) {
        ASSERT_LE(fine, scale.size * std::pow(scale.rate / steps, order)) << "with " << steps;
        steps *= 2;
        coarse = std::exchange(fine, error(steps));
    }
    ASSERT_GT(coarse, 0) << "met with the first dt";
    expect_fall(coarse, fine, method, order);
}

/// The methods of order 4 and above, but for the exact one.
inline std::vector<const oiler::Method*> high_orders() {
    std::vector<const oiler::Method*> found;
    for (const oiler::Method& method : oiler::methods())
        if (method.order >= 4 && method.order != oiler::exact_order) found.push_back(&method);
    return found;
}

/// A state that one force moves for `steps` steps of `dt`.
template <class T, int Axes, class Physics>
oiler::State<T, Axes> moved(const oiler::Method& method, oiler::State<T, Axes> state,
                            const Physics& physics, T dt, std::int64_t steps) {
    const auto plan = oiler::make_plan<T>(method, dt);
    for (std::int64_t i = 0; i < steps; ++i) oiler::advance(plan, state, physics, 0);
    return state;
}
