// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/advance.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "support/test.hpp"

/// The scale of errors: an error of order p is compared with size·(rate·dt)^p.
struct Scale {
    long double rate;  ///< how fast the motion changes: its Taylor series has terms (rate·t)^n
    long double size;  ///< in the unit of the error
};

/// Expects that halving dt divides an error by 2^order, apart from the next term of the error,
/// which is small by now. That term is two orders higher for a symmetric method, otherwise one. If
/// the leading term is small beside it, the error may fall faster, or, with opposite signs, a
/// little slower.
inline void expect_fall(long double coarse, long double fine, const oiler::Method& method,
                        int order) {
    const long double slope = std::log2(coarse / fine);
    EXPECT_GE(slope, order - (method.symmetric ? 0.1L : 0.3L));
    if (method.symmetric) {
        EXPECT_LE(slope, order + 0.1L);
    }
}

/// Doubles the number of steps per second (or per unit of `error`) until the error is below
/// `ceiling`. Every error must be within size·(rate·dt)^order, so that the loop ends. The last
/// halving of dt must divide it by 2^order. An error that tended to a tenth of `ceiling` instead of
/// 0 would fail.
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
    ASSERT_GT(coarse, 0) << "the first dt has no error";
    expect_fall(coarse, fine, method, order);
}

/// The methods of order 4 and above, except the exact one.
inline std::vector<const oiler::Method*> high_orders() {
    std::vector<const oiler::Method*> found;
    for (const oiler::Method& method : oiler::methods())
        if (method.order >= 4 && method.order != oiler::exact_order) found.push_back(&method);
    return found;
}

/// The state after `steps` steps of `dt` with one force.
template <class T, int Axes, class Physics>
oiler::State<T, Axes> moved(const oiler::Method& method, oiler::State<T, Axes> state,
                            const Physics& physics, T dt, std::int64_t steps) {
    const auto plan = oiler::make_plan<T>(method, dt);
    for (std::int64_t i = 0; i < steps; ++i) oiler::advance(plan, state, physics, 0);
    return state;
}
