// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace oiler::lab {

/// The convergence of a method's error with its rate. It ends when only round-off remains.
class Convergence {
public:
    /// Takes the error at the next higher rate.
    void take(double error) {
        vain_ = error >= improvement * best_ ? vain_ + 1 : 0;
        best_ = std::fmin(best_, error);
    }
    [[nodiscard]] bool ended() const { return vain_ >= most_vain; }

private:
    /// An error above this fraction of the best so far is no improvement.
    static constexpr double improvement = 0.9;
    static constexpr int most_vain = 3;

    double best_ = std::numeric_limits<double>::infinity();
    int vain_ = 0;
};

}  // namespace oiler::lab
