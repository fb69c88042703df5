// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/linear_motion.hpp"

namespace oiler::lab {

using Real = long double;
using Real3 = Vec<Real, 3>;
using State3 = State<Real, 3>;

LinearFactors factors_at(const LinearMotion& motion, Real t) {
    if (motion.k == 0)
        return {{1, 0},
                linear_drag_motion<Real>({0, 1}, 0, motion.c, t),
                linear_drag_motion<Real>({0, 0}, 1, motion.c, t)};
    // The velocity of the second motion plus c times its position is the position of the first.
    const oiler::Motion<Real> from_v = damped_oscillator<Real>(1, motion.k, motion.c, {0, 1}, t);
    return {{from_v.v + motion.c * from_v.x, -motion.k * from_v.x}, from_v, {}};
}

State3 state_after(const LinearMotion& motion, const State3& start, const LinearFactors& factors) {
    if (motion.k == 0)
        return {start.x + start.v * factors.from_v.x + motion.acceleration * factors.pushed.x,
                start.v * factors.from_v.v + motion.acceleration * factors.pushed.v};
    const Real3 from = start.x - motion.rest;
    return {motion.rest + from * factors.from_x.x + start.v * factors.from_v.x,
            from * factors.from_x.v + start.v * factors.from_v.v};
}

}  // namespace oiler::lab
