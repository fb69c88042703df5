// SPDX-License-Identifier: MIT
#include "oiler/app/rate_advice.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/inspector/inspector.hpp"

namespace oiler {
namespace {

constexpr int most_named = 100'000;  // Hz

/// With two digits.
std::int64_t rounded(double rate) {
    const double unit = std::pow(10, std::floor(std::log10(rate)) - 1);
    return std::llround(std::round(rate / unit) * unit);
}

bool is_certain(const WhatIfRun& run, const WhatIf& measured) {
    return run.failure.empty() && !run.other_play_from &&
           run.distance > least_certain * measured.uncertainty;
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
        if (run_at(rate, measured) != &run || !run.failure.empty() || run.other_play_from) continue;
        const double known = std::max(run.distance, least_certain * measured.uncertainty);
        if (known <= measured.pixel && (!lowest || rate < *lowest)) lowest = rate;
    }
    return lowest;
}

/// The rate at which the error would be `wanted`, Hz, from runs at half, once and twice the rate;
/// empty unless the error shrinks alike between them.
std::optional<double> promised_rate(const WhatIf& measured, double wanted) {
    constexpr double least_order = 0.7;
    constexpr double most_apart = 0.3;  // of orders
    const WhatIfRun& played = measured.runs.front();
    const std::int64_t rate = played.stepping.rate.steps;
    const WhatIfRun* const half = rate % 2 == 0 ? run_at(rate / 2, measured) : nullptr;
    const WhatIfRun* const twice = run_at(2 * rate, measured);
    if (!half || !twice) return std::nullopt;
    for (const WhatIfRun* const run : {half, &played, twice})
        if (!is_certain(*run, measured)) return std::nullopt;
    const double order = std::log2(played.distance / twice->distance);
    const double order_before = std::log2(half->distance / played.distance);
    if (order < least_order || std::abs(order - order_before) > most_apart) return std::nullopt;
    return 2 * static_cast<double>(rate) * std::pow(twice->distance / wanted, 1 / order);
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
    if (found == offered_rates.end()) return std::nullopt;
    return RateAdvice{*found, false};
}

std::string rate_advice_text(const WhatIf& measured) {
    const WhatIfRun& played = measured.runs.front();
    const auto advice = advise_rate(measured);
    if (advice && advice->is_measured)
        return advice->rate == played.stepping.rate.steps
                   ? "This rate is within a pixel so far."
                   : fmt::format("{} Hz of this method is within a pixel so far.", advice->rate);
    if (advice)
        return fmt::format("About {} Hz of this method would be within a pixel.", advice->rate);
    if (const auto promised = promised_rate(measured, measured.pixel))
        return fmt::format("To be within a pixel, this method would need {}.",
                           *promised > most_named ? fmt::format("more than {} Hz", most_named)
                                                  : fmt::format("about {} Hz", rounded(*promised)));
    return "";
}

}  // namespace oiler
