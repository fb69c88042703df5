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

/// The eccentric anomaly of an ellipse, by bisection of Kepler's equation E − e·sin E = mean.
inline Real anomaly(Real e, Real mean) {
    Real low = mean - 1;
    Real high = mean + 1;
    for (int i = 0; i < 80; ++i) {
        const Real middle = (low + high) / 2;
        (middle - e * std::sin(middle) < mean ? low : high) = middle;
    }
    return low;
}

/// gm = 1, semi-axis 1, from the perihelion.
inline State3 planet(Real e, Real t) {
    const Real now = anomaly(e, t);
    const Real minor = std::sqrt(1 - e * e);
    const Real rate = 1 / (1 - e * std::cos(now));
    return {{std::cos(now) - e, minor * std::sin(now), 0},
            {-rate * std::sin(now), rate * minor * std::cos(now), 0}};
}

/// The left (sign 1) or right mass (−1) of assets/scenes/chain.toml: the displacements from −2 m
/// and 2 m are (cos ω1·t ± cos ω2·t)/2, with ω1 = √15 in phase and ω2 = √18 in antiphase. Neither
/// reaches a wall or the other, where its spring would turn over.
inline ExactMotion chain_motion(Real sign) {
    return [sign](Real t) {
        const Real together = std::sqrt(15.0L);
        const Real against = std::sqrt(18.0L);
        return along_x(
            (std::cos(together * t) + sign * std::cos(against * t)) / 2 - sign * 2,
            -(together * std::sin(together * t) + sign * against * std::sin(against * t)) / 2);
    };
}

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

/// The largest errors (m) of the article's two lines over 10 s: at the steps, and as drawn on
/// straight lines between them, at 64 times per step.
struct ArticleErrors {
    explicit ArticleErrors(int rate) {
        const ExactMotion exact = article_motion(0.1L);
        double x = 1000;
        double v = 0;
        for (int tick = 0; tick < 10 * rate; ++tick) {
            v += (-15 * x - 0.1 * v) / rate;
            const double next = x + v / rate;
            for (int point = 0; point <= 64; ++point) {
                const double share = point / 64.0;
                const double error =
                    std::abs(x + share * (next - x) -
                             static_cast<double>(exact((tick + share) / rate).x[0]));
                as_drawn = std::max(as_drawn, error);
                if (point == 0 || point == 64) at_steps = std::max(at_steps, error);
            }
            x = next;
        }
    }

    double at_steps = 0;
    double as_drawn = 0;
};

}  // namespace oiler::test
