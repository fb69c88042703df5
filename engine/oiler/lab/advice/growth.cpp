// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace oiler::lab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Coefficients = std::array<double, 3>;

/// The non-negative coefficients of 1, s and s² that fit errors at s = 1/n, 2/n, … 1 best: least
/// squares over the last three quarters, one coefficient after another.
Coefficients fit_powers(const std::vector<double>& errors) {
    constexpr int sweeps = 30'000;
    std::array<Coefficients, 3> products{};
    Coefficients right{};
    for (std::size_t part = errors.size() / 4; part < errors.size(); ++part) {
        const double s = static_cast<double>(part + 1) / static_cast<double>(errors.size());
        const Coefficients powers{1, s, s * s};
        for (std::size_t i = 0; i < 3; ++i) {
            right[i] += powers[i] * errors[part];
            for (std::size_t j = 0; j < 3; ++j) products[i][j] += powers[i] * powers[j];
        }
    }
    Coefficients fitted{};
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t i = 0; i < 3; ++i) {
            double rest = right[i];
            for (std::size_t j = 0; j < 3; ++j)
                if (j != i) rest -= products[i][j] * fitted[j];
            fitted[i] = std::max(0.0, rest / products[i][i]);
        }
    return fitted;
}

/// An error that grows exponentially has a logarithm that doubles in each doubling of the time.
bool is_exponential(const std::vector<double>& errors) {
    constexpr double least = 1.15;
    constexpr double accelerating = 1.5;
    const double at_quarter = errors[errors.size() / 4 - 1];
    const double at_half = errors[errors.size() / 2 - 1];
    const double last = errors.back() / at_half;
    return last > 4 &&
           std::log(last) > accelerating * std::log(std::max(at_half / at_quarter, least));
}

}  // namespace

double Growth::holds_until(double tolerance) const {
    constexpr double longest = 1000;
    const double left = tolerance - lines;
    if (left < at_steps) return until;
    double time = infinity;
    if (law == Law::exponential)
        time = until + std::log(left / at_steps) / rate;
    else if (law != Law::bounded && linear + quadratic > 0)
        // The stable form of the quadratic formula.
        time = 2 * (left - constant) /
               (linear + std::sqrt(linear * linear + 4 * quadratic * (left - constant)));
    return std::min(time > longest * until ? infinity : std::max(time, until), passed);
}

Growth fit_growth(const std::vector<double>& at_steps, double drawn, double until,
                  double round_off) {
    constexpr double negligible = 0.05;
    constexpr double dominant = 0.8;
    Growth growth{.until = until};
    if (at_steps.size() < 8 || !(at_steps.back() > 0)) return growth;
    growth.at_steps = at_steps.back();
    growth.lines = std::max(0.0, drawn - growth.at_steps);
    if (growth.at_steps <= round_off) {
        growth.law = Growth::Law::round_off;
        return growth;
    }
    if (is_exponential(at_steps)) {
        growth.law = Growth::Law::exponential;
        growth.rate = std::log(at_steps.back() / at_steps[at_steps.size() / 2 - 1]) / (until / 2);
        return growth;
    }
    const auto [constant, linear, quadratic] = fit_powers(at_steps);
    const double grown = linear + quadratic;
    growth.constant = constant;
    growth.linear = linear / until;
    growth.quadratic = quadratic / (until * until);
    growth.law = grown < negligible * growth.at_steps ? Growth::Law::bounded
                 : linear > dominant * grown          ? Growth::Law::linear
                 : quadratic > dominant * grown       ? Growth::Law::quadratic
                                                      : Growth::Law::faster_than_linear;
    return growth;
}

const char* describe(Growth::Law law) {
    constexpr const char* words[]{"not fitted",         "round-off",     "bounded",
                                  "grows with t",       "grows with t²", "grows faster than t",
                                  "grows exponentially"};
    return words[static_cast<std::size_t>(law)];
}

}  // namespace oiler::lab
