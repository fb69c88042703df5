// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/growth.hpp"

#include <cmath>
#include <limits>

namespace oiler::lab {

double Growth::holds_until(double tolerance) const {
    const double times = tolerance / error;
    switch (law) {
        case Law::linear:
            return until * times;
        case Law::quadratic:
            return until * std::sqrt(times);
        case Law::exponential:
            return until + std::log(times) / rate;
        default:
            return std::numeric_limits<double>::infinity();
    }
}

// An error that grows with a power of the time grows by the same factor in each doubling of the
// time; the logarithm of one that grows exponentially doubles.
Growth fit_growth(const std::vector<double>& errors, double until) {
    constexpr double least = 1.15;           // per doubling
    constexpr double between_powers = 2.83;  // 2^1.5
    constexpr double accelerating = 1.5;
    Growth growth{.until = until, .error = errors.empty() ? 0 : errors.back()};
    if (errors.size() < 8 || !(growth.error > 0)) return growth;
    const double at_quarter = errors[errors.size() / 4 - 1];
    const double at_half = errors[errors.size() / 2 - 1];
    const double last = growth.error / at_half;
    const double before = at_half / at_quarter;
    if (!(last > least))
        growth.law = Growth::Law::bounded;
    else if (last > 2 && std::log(last) > accelerating * std::log(std::fmax(before, least)))
        growth.law = Growth::Law::exponential;
    else
        growth.law = last < between_powers ? Growth::Law::linear : Growth::Law::quadratic;
    growth.rate = std::log(last) / (until / 2);
    return growth;
}

const char* describe(Growth::Law law) {
    switch (law) {
        case Growth::Law::bounded:
            return "bounded";
        case Growth::Law::linear:
            return "grows with t";
        case Growth::Law::quadratic:
            return "grows with t²";
        case Growth::Law::exponential:
            return "grows exponentially";
        default:
            return "not fitted";
    }
}

}  // namespace oiler::lab
