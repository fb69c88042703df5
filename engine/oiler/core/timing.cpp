// SPDX-License-Identifier: MIT
#include "oiler/core/timing.hpp"

namespace oiler {

double clock_step() {
    static const double step = [] {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 10; ++i) {
            const auto start = std::chrono::steady_clock::now();
            double passed = 0;
            while (passed == 0) passed = seconds_since(start);
            least = std::min(least, passed);
        }
        return least;
    }();
    return step;
}

}  // namespace oiler
