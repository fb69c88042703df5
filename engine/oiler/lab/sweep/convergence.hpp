// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace oiler::lab {

/// How a method's errors fall as its rate rises: at the end of it round-off is what is left.
class Descent {
public:
    /// Of the next rate.
    void take(double error) {
        vain_ = error >= improvement * best_ ? vain_ + 1 : 0;
        best_ = std::fmin(best_, error);
    }
    [[nodiscard]] bool ended() const { return vain_ >= most_vain; }

private:
    /// An error that is at least this part of the best before is no improvement.
    static constexpr double improvement = 0.9;
    static constexpr int most_vain = 3;

    double best_ = std::numeric_limits<double>::infinity();
    int vain_ = 0;
};

}  // namespace oiler::lab
