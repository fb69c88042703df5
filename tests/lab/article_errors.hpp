// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace oiler::test {

/// The closed form of x" = -15 x - 0.1 x' from 1000 m at rest: a damped cosine.
inline double article_at(double t) {
    const double w = std::sqrt(15 - 0.05 * 0.05);
    return 1000 * std::exp(-0.05 * t) * (std::cos(w * t) + 0.05 / w * std::sin(w * t));
}

/// The largest errors (m) of the article's two lines over 10 s: at the steps, and as drawn on
/// straight lines between them, at 64 times per step.
struct ArticleErrors {
    explicit ArticleErrors(int rate) {
        double x = 1000;
        double v = 0;
        for (int tick = 0; tick < 10 * rate; ++tick) {
            v += (-15 * x - 0.1 * v) / rate;
            const double next = x + v / rate;
            for (int point = 0; point <= 64; ++point) {
                const double share = point / 64.0;
                const double error =
                    std::abs(x + share * (next - x) - article_at((tick + share) / rate));
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
