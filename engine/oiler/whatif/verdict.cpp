// SPDX-License-Identifier: MIT
#include "oiler/whatif/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace oiler {
namespace {

constexpr double least_difference = 0.01;
constexpr double most_pixels = 99'999;

double cost(const WhatIfRun& run) { return run.costs.of_steps(); }

/// The largest error of a cure, pixels: the height of a picture.
constexpr double most_cured = 720;

/// The other run with the smallest error; null if that is above half of the played run's error or
/// above the height of the picture.
const WhatIfRun* best(const WhatIf& measured) {
    const WhatIfRun* best = nullptr;
    double least = std::min(measured.runs.front().distance / 2, most_cured * measured.pixel);
    for (const WhatIfRun& run : std::span(measured.runs).subspan(1)) {
        const double most = measured.error_of(run).most();
        if (!run.is_sound() ||
            !(run.distance <= least && most <= measured.runs.front().distance / 2))
            continue;
        least = run.distance;
        best = &run;
    }
    return best;
}

bool is_cheaper(const WhatIfRun& a, const WhatIfRun& b) {
    const bool certain = std::max(cost(a), cost(b)) >= least_cost;
    return certain ? cost(a) < cost(b) : a.evaluations < b.evaluations;
}

/// The cheapest other run with errors below a pixel, else the best; null if there is none.
const WhatIfRun* cure(const WhatIf& measured) {
    const WhatIfRun* cheapest = nullptr;
    for (const WhatIfRun& run : std::span(measured.runs).subspan(1)) {
        if (!run.is_sound() || !(measured.error_of(run).most() <= measured.pixel)) continue;
        if (!cheapest || is_cheaper(run, *cheapest)) cheapest = &run;
    }
    return cheapest ? cheapest : best(measured);
}

std::string price_text(const WhatIfRun& run, const WhatIf& measured) {
    const double played = cost(measured.runs.front());
    if (std::max(cost(run), played) < least_cost) return "below 10 µs a frame";
    const double more = cost(run) - played;
    if (std::abs(more) < std::max(least_cost, 0.2 * played)) return "for about the same time";
    return fmt::format("{}{:.0f} µs a frame", more < 0 ? "−" : "+", std::abs(more) / 1000);
}

std::string error_text(const WhatIfRun& run, const WhatIf& measured) {
    const KnownError error = measured.error_of(run);
    if (error.is_exact(measured.pixel)) return "exact";
    if (!error.is_certain()) return fmt::format("less than {} off", length_text(error.limit()));
    const KnownError at_steps(run.distance_at_steps, measured.uncertainty);
    const bool only_lines =
        at_steps.state() == KnownError::State::below_limit && run.distance <= measured.pixel;
    return only_lines ? "exact at the steps" : length_text(run.distance) + " off";
}

std::string cure_text(const WhatIf& measured) {
    const WhatIfRun* const run = cure(measured);
    if (!run) return "";
    const WhatIfRun& played = measured.runs.front();
    return fmt::format(" {}: {}, {}.", difference_text(run->stepping, played.stepping),
                       error_text(*run, measured), price_text(*run, measured));
}

/// The unchanging reading with the largest relative error; null if none is wrong.
const Reading* worst_reading(const WhatIf& measured, const std::vector<Reading>& before) {
    const std::vector<Reading>& played = measured.runs.front().readings;
    const std::vector<Reading>& truth = measured.reference.readings;
    const std::vector<Reading>& check = measured.check.readings;
    const std::size_t count = std::min({played.size(), truth.size(), check.size()});
    const Reading* worst = nullptr;
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (played[i].unit.empty() || played[i].name != truth[i].name) continue;
        if (i >= before.size() || before[i] != played[i]) continue;
        const double off = std::abs(played[i].value - truth[i].value);
        const KnownError error(off, std::abs(check[i].value - truth[i].value));
        const bool is_seen = played[i].unit == "m"
                                 ? off > measured.pixel
                                 : off > least_difference * std::abs(truth[i].value);
        const double relative = off / std::max(std::abs(truth[i].value), 1e-300);
        if (!is_seen || !error.is_certain() || relative <= largest) continue;
        largest = relative;
        worst = &played[i];
    }
    return worst;
}

std::string reading_text(const WhatIf& measured, const Reading& played) {
    const auto index = static_cast<std::size_t>(&played - measured.runs.front().readings.data());
    const double truth = measured.reference.readings[index].value;
    const double off = std::abs(played.value - truth);
    const std::string by =
        played.unit == "m" ? length_text(off) : fmt::format("{:.2g} {}", off, played.unit);
    return fmt::format("{} {:.4g} {}, true {:.4g} {}: {} too {} at {}.", played.name, played.value,
                       played.unit, truth, played.unit, by, played.value < truth ? "low" : "high",
                       short_text(measured.runs.front().stepping));
}

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

Verdict judge_setting(const WhatIf& measured, const std::vector<Reading>& before, double begin,
                      const std::function<std::string(Entity)>& name_of) {
    const WhatIfRun& played = measured.runs.front();
    const std::string setting = short_text(played.stepping);
    if (!played.failure.empty()) return {Grade::bad, played.failure + cure_text(measured)};
    if (!(measured.certain_until > 0) || (std::isnan(played.distance) && !played.other_play_from))
        return {Grade::unknown, fmt::format("What {} costs is not known yet.", setting)};
    const std::string limit = measured.certain_until < measured.duration - 1
                                  ? fmt::format(" After {:.1f} s the true motion is not known.",
                                                begin + measured.certain_until)
                                  : "";
    if (played.other_play_from)
        return {
            Grade::bad,
            fmt::format("From {:.1f} s on, other things happen at {} than in the true motion.{}{}",
                        begin + *played.other_play_from, setting, cure_text(measured), limit)};
    const double pixels = played.distance / measured.pixel;
    const KnownError error = measured.error_of(played);
    const double known = error.most();
    const Grade grade = error.grade(measured.pixel);
    if (const Reading* const reading = worst_reading(measured, before))
        return {std::max(grade, Grade::visible),
                reading_text(measured, *reading) + cure_text(measured) + limit};
    if (known == 0) return {grade, fmt::format("No error so far at {}.{}", setting, limit)};
    if (grade == Grade::good)
        return {grade,
                fmt::format("Drawn within {} of the true motion, less than a pixel, at {}.{}",
                            length_text(known), setting, limit)};
    if (grade == Grade::unknown)
        return {grade,
                fmt::format("Off by less than {} at {}. The true motion is not known better.{}",
                            length_text(known), setting, limit)};
    return {grade,
            fmt::format("{} up to {} off, {}{:.0f} px, at {}.{}{}", name_of(played.furthest),
                        length_text(played.distance), pixels > most_pixels ? "more than " : "",
                        std::min(pixels, most_pixels), setting, cure_text(measured), limit)};
}

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

std::string rate_advice_text(const WhatIf& measured) {
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

}  // namespace oiler
