// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/lab/reference/exact_motion.hpp"
#include "support/test.hpp"

namespace oiler::test {
using namespace lab;

using State3 = State<Real, 3>;

/// The motion of every body.
using Motions = std::vector<ExactMotion>;

inline State3 along_x(Real x, Real v) { return {{x, 0, 0}, {v, 0, 0}}; }

/// The article's spring: x0·e^(−γt)·(cos ωd·t + (γ/ωd)·sin ωd·t) from x0 = 1000 m at rest.
inline ExactMotion article_motion(Real damping, Real stiffness = 15) {
    return [=](Real t) {
        const Real gamma = damping / 2;
        const Real omega = std::sqrt(stiffness - gamma * gamma);
        const Real decay = 1000 * std::exp(-gamma * t);
        return along_x(decay * (std::cos(omega * t) + gamma / omega * std::sin(omega * t)),
                       -decay * stiffness / omega * std::sin(omega * t));
    };
}

}  // namespace oiler::test
