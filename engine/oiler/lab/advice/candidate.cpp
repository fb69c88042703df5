// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/candidate.hpp"

#include <algorithm>
#include <cmath>

namespace oiler::lab {

double Candidate::cost(std::int64_t rate) const {
    constexpr double frames_per_second = 60;
    const auto steps = static_cast<double>(rate);
    const double frames = std::min(steps, frames_per_second);
    return frames * first + (steps - frames) * further;
}

std::int64_t Candidate::least_rate(const TradeoffRow& row, double excess,
                                   const Requirements& requirements, double extent) const {
    const std::int64_t rate = row.stepping.rate.steps;
    const bool falls = requirements.error_of(row.judgement) < largest_converging_error * extent;
    if (!falls || excess <= 1) return rate + 1;
    const double factor = least_factor(row.judgement, excess, requirements);
    return std::max(rate + 1, static_cast<std::int64_t>(static_cast<double>(rate) * factor));
}

/// The smallest factor on the rate that may bring the error within the tolerances. At the steps,
/// the error is taken to fall by one order more than the method's. The rest, that of the drawn
/// lines, falls with the square of the step.
double Candidate::least_factor(const Judgement& judgement, double excess,
                               const Requirements& requirements) const {
    constexpr double safety = 0.7;
    const double steps =
        method->order == exact_order ? 1 : std::pow(excess, 1.0 / (method->order + 1));
    if (requirements.at_steps || !requirements.position_error || requirements.display > 0)
        return steps;
    const double at_steps = std::isnan(judgement.step_error) ? 0 : judgement.step_error;
    const double lines = (judgement.position_error - at_steps) / *requirements.position_error;
    const bool by_steps = at_steps > lines * *requirements.position_error;
    return std::max(by_steps ? steps : 1, lines > 1 ? safety * std::sqrt(lines) : 1);
}

}  // namespace oiler::lab
