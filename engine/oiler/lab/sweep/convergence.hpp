// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace oiler::lab {

/// Errors above this fraction of the extent do not follow the method's order.
inline constexpr double largest_converging_error = 0.1;

/// The convergence of a method's error with its rate. Errors above `begun` (m) are no evidence:
/// they have not begun to fall.
class Convergence {
public:
    explicit Convergence(double begun) : begun_(begun) {}

    /// Takes the error at the next higher rate.
    void take(double error) {
        if (!(error < begun_)) return;
        vain_ = error >= improvement * best_ ? vain_ + 1 : 0;
        best_ = std::fmin(best_, error);
    }
    /// Whether errors no longer fall.
    [[nodiscard]] bool stalled() const { return vain_ >= most_vain; }
    /// Forgets the rungs without improvement.
    void restart() { vain_ = 0; }

private:
    /// An error above this fraction of the best so far is no improvement.
    static constexpr double improvement = 0.9;
    static constexpr int most_vain = 3;

    double begun_;
    double best_ = std::numeric_limits<double>::infinity();
    int vain_ = 0;
};

}  // namespace oiler::lab
