// SPDX-License-Identifier: MIT
#include "oiler/whatif/rate_advice.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace oiler {
namespace {

/// Rounds to two digits.
std::int64_t to_two_digits(double rate) {
    const double unit = std::pow(10, std::floor(std::log10(rate)) - 1);
    return std::llround(std::round(rate / unit) * unit);
}

bool has_certain_error(const WhatIfRun& run, const WhatIf& measured) {
    return run.is_sound() && run.distance > 0 && measured.error_of(run).is_certain();
}

/// The run of the played method, precision and damping at a rate; null if there is none.
const WhatIfRun* run_at(std::int64_t rate, const WhatIf& measured) {
    Stepping stepping = measured.runs.front().stepping;
    stepping.rate = {rate};
    const auto found = std::ranges::find(measured.runs, stepping, &WhatIfRun::stepping);
    return found == measured.runs.end() ? nullptr : &*found;
}

/// The lowest rate of the played method that is measured and within a pixel.
std::optional<std::int64_t> lowest_measured(const WhatIf& measured) {
    std::optional<std::int64_t> lowest;
    for (const WhatIfRun& run : measured.runs) {
        const std::int64_t rate = run.stepping.rate.steps;
        if (run_at(rate, measured) != &run || !run.is_sound()) continue;
        if (measured.error_of(run).most() <= measured.pixel && (!lowest || rate < *lowest))
            lowest = rate;
    }
    return lowest;
}

/// The convergence of the error up to a rate.
struct Trend {
    std::int64_t rate;  ///< Hz
    double error;       ///< m
    double order;       ///< of the error, between half the rate and the rate
};

/// The trend up to the highest rate whose half and quarter are measured, too; empty if the order is
/// low or not the same at both halvings.
std::optional<Trend> trend_of(const WhatIf& measured) {
    constexpr double least_order = 0.7;
    constexpr double most_apart = 0.3;  // of orders
    std::array<const WhatIfRun*, 3> last{};
    for (const WhatIfRun& run : measured.runs) {
        const std::int64_t rate = run.stepping.rate.steps;
        if (run_at(rate, measured) != &run || rate % 4 != 0) continue;
        const std::array on_the_way{run_at(rate / 4, measured), run_at(rate / 2, measured), &run};
        if (std::ranges::count(on_the_way, nullptr) > 0) continue;
        if (!last[2] || rate > last[2]->stepping.rate.steps) last = on_the_way;
    }
    if (!last[2] || !std::ranges::all_of(last, [&](const WhatIfRun* run) {
            return has_certain_error(*run, measured);
        }))
        return std::nullopt;
    const double order_before = std::log2(last[0]->distance / last[1]->distance);
    const double order = std::log2(last[1]->distance / last[2]->distance);
    if (order < least_order || std::abs(order - order_before) > most_apart) return std::nullopt;
    return Trend{last[2]->stepping.rate.steps, last[2]->distance, order};
}

/// The rate at which the error would be `wanted`, Hz. The extrapolation uses no higher order than
/// the method's.
std::optional<double> promised_rate(const WhatIf& measured, double wanted) {
    const auto trend = trend_of(measured);
    if (!trend) return std::nullopt;
    const int most = measured.runs.front().stepping.method->order;
    const double order = std::min(trend->order, static_cast<double>(most));
    return static_cast<double>(trend->rate) * std::pow(trend->error / wanted, 1 / order);
}

}  // namespace

std::optional<RateAdvice> advise_rate(const WhatIf& measured) {
    if (const auto lowest = lowest_measured(measured)) return RateAdvice{*lowest, true};
    const auto promised = promised_rate(measured, measured.pixel / 2);
    if (!promised) return std::nullopt;
    const std::int64_t played = measured.runs.front().stepping.rate.steps;
    const auto found = std::ranges::find_if(offered_rates, [&](std::int64_t rate) {
        return rate % played == 0 && static_cast<double>(rate) >= *promised;
    });
    // A measured rate with an error beyond a pixel refutes the extrapolation.
    if (found == offered_rates.end() || run_at(*found, measured)) return std::nullopt;
    return RateAdvice{*found, false};
}

std::vector<std::int64_t> rates_to_try(const WhatIf& measured) {
    constexpr std::int64_t most_tried = 4000;  // Hz
    constexpr double most_time = 300'000;      // ns of a frame
    const WhatIfRun& played = measured.runs.front();
    const std::int64_t played_rate = played.stepping.rate.steps;
    std::vector<std::int64_t> rates;
    if (const auto advice = advise_rate(measured))
        rates = {advice->rate};
    else
        for (const std::int64_t factor : {8, 16, 32})
            if (factor * played_rate <= most_tried) rates.push_back(factor * played_rate);
    const double time_per_rate = played.costs.of_steps() / static_cast<double>(played_rate);
    const auto sum = std::accumulate(rates.begin(), rates.end(), std::int64_t{0});
    if (time_per_rate * static_cast<double>(sum) > most_time) return {};
    return rates;
}

namespace {

std::string text_of_advice(const WhatIf& measured) {
    const WhatIfRun& played = measured.runs.front();
    const auto advice = advise_rate(measured);
    if (advice && advice->is_measured)
        return advice->rate == played.stepping.rate.steps
                   ? "This rate is within a pixel so far."
                   : fmt::format("{} Hz of this method is within a pixel so far.", advice->rate);
    if (advice)
        return fmt::format("About {} Hz of this method would be within a pixel so far.",
                           advice->rate);
    constexpr int most_named = 100'000;  // Hz
    if (const auto promised = promised_rate(measured, measured.pixel))
        return fmt::format("To be within a pixel so far, this method would need {}.",
                           *promised > most_named
                               ? fmt::format("more than {} Hz", most_named)
                               : fmt::format("about {} Hz", to_two_digits(*promised)));
    return std::isnan(played.distance) ? ""
                                       : "No rate within a pixel is known yet for this method.";
}

}  // namespace

std::string rate_advice_text(const WhatIf& measured) {
    const std::string advice = text_of_advice(measured);
    return advice.empty() || !measured.has_events_at_steps
               ? advice
               : advice + " Events of update() come at steps: the rate moves them.";
}

}  // namespace oiler
