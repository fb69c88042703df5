// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <string>

namespace oiler {

/// Factor of simulated time over real time: a power of two from 1/16 to 16.
class Pace {
public:
    void slower() { exponent_ = std::max(exponent_ - 1, -4); }
    void faster() { exponent_ = std::min(exponent_ + 1, 4); }
    [[nodiscard]] int numerator() const { return 1 << std::max(exponent_, 0); }
    [[nodiscard]] int denominator() const { return 1 << std::max(-exponent_, 0); }
    [[nodiscard]] std::string text() const {
        if (exponent_ == 0) return {};
        return exponent_ > 0 ? fmt::format("{}× (F7 slower)", numerator())
                             : fmt::format("1/{}× (F8 faster)", denominator());
    }

private:
    int exponent_ = 0;
};

}  // namespace oiler
