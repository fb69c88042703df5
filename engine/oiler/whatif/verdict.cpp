// SPDX-License-Identifier: MIT
#include "oiler/whatif/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "oiler/core/length_text.hpp"
#include "oiler/core/timing.hpp"

namespace oiler {
namespace {

constexpr double least_difference = 0.01;
constexpr double most_pixels = 99'999;

double cost(const WhatIfRun& run) { return run.costs.of_steps(); }

/// The largest error of a cure, pixels: a hundredth of the picture's height.
constexpr double most_cured = 7.2;

/// The other run with the smallest error; null if that is above half of the played run's error or
/// above a hundredth of the picture's height.
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
    const bool certain = shows_costs() && std::max(cost(a), cost(b)) >= least_cost;
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

/// ", below 10 µs a frame"; empty if it is unknown.
std::string price_text(const WhatIfRun& run, const WhatIf& measured) {
    if (!shows_costs()) return "";
    const double played = cost(measured.runs.front());
    if (std::max(cost(run), played) < least_cost) return ", below 10 µs a frame";
    const double more = cost(run) - played;
    if (std::abs(more) < std::max(least_cost, 0.2 * played)) return ", for about the same time";
    if (more > 0) return fmt::format(", +{:.0f} µs a frame", more / 1000);
    if (cost(run) < least_cost) return ", below 10 µs a frame";
    return fmt::format(", {:.0f} instead of {:.0f} µs a frame", cost(run) / 1000, played / 1000);
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
    return fmt::format(" {}: {}{}.", difference_text(run->stepping, played.stepping),
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
    constexpr double up = 1 + 1e-9;  // rounds halves up, whatever their last places
    return fmt::format("{} {:.4g} {}, true {:.4g} {}: {} too {} at {}.", played.name,
                       up * played.value, played.unit, up * truth, played.unit,
                       amount_text(off, played.unit), played.value < truth ? "low" : "high",
                       short_text(measured.runs.front().stepping));
}

/// s: whether a difference is a delay is known that much later, and a verdict is a tenth of a
/// second old.
constexpr double of_now = 0.5;

/// Whether the true motion is known at the moment that the game has come to.
bool is_known_now(const WhatIf& measured) {
    return measured.duration - measured.certain_until < of_now;
}

/// Why and when the knowledge of the true motion ends, if that is before now.
std::string end_text(const WhatIf& measured, double begin) {
    const double until = begin + measured.certain_until;
    if (is_known_now(measured)) return "";
    if (measured.measured_until - measured.certain_until < of_now)
        return fmt::format(" Measured until {:.1f} s so far.", until);
    if (measured.tenfold)
        return fmt::format(
            " After {:.1f} s nobody knows the true motion: the least error grows tenfold in {:.2g} "
            "s.",
            until, *measured.tenfold);
    return fmt::format(" After {:.1f} s the true motion is not known.", until);
}

/// Names the first event that is not one of the true motion.
std::string other_play_text(const WhatIf& measured, double begin) {
    const WhatIfRun& played = measured.runs.front();
    return fmt::format("From {:.1f} s on, other things happen at {}: {}.",
                       begin + *played.other_play_from, short_text(played.stepping),
                       played.other_play);
}

/// Describes a distance that is only known to be below a limit, which is above a pixel.
std::string limit_text(const WhatIf& measured, double begin, const std::string& setting) {
    const WhatIfRun& played = measured.runs.front();
    const std::string limit = length_text(measured.error_of(played).limit());
    if (played.visible_from)
        return fmt::format("More than a pixel off since {:.1f} s at {}, {} at most.",
                           begin + *played.visible_from, setting, limit);
    if (!(measured.pixel_until > 0))
        return fmt::format("Right to {} so far at {}.", limit, setting);
    const double until = std::floor(10 * (begin + measured.pixel_until)) / 10;
    return fmt::format("Right to a pixel until {:.1f} s at {}, to {} since.", until, setting,
                       limit);
}

/// The largest distance of a body as drawn.
std::string distance_text(const WhatIf& measured, double begin,
                          const std::function<std::string(Entity)>& name_of) {
    const WhatIfRun& played = measured.runs.front();
    const std::string setting = short_text(played.stepping);
    const KnownError error = measured.error_of(played);
    if (error.most() == 0) return fmt::format("No error so far at {}.", setting);
    if (error.grade(measured.pixel) == Grade::good)
        return fmt::format("Drawn within {} of the true motion, less than a pixel, at {}.",
                           length_text(error.most()), setting);
    if (!error.is_certain()) return limit_text(measured, begin, setting);
    const double pixels = played.distance / measured.pixel;
    return fmt::format("{} up to {} off, {}{:.0f} px, at {}.{}", name_of(played.furthest),
                       length_text(played.distance), pixels > most_pixels ? "more than " : "",
                       std::min(pixels, most_pixels), setting, cure_text(measured));
}

}  // namespace

Verdict judge_setting(const WhatIf& measured, const std::vector<Reading>& before, double begin,
                      const std::function<std::string(Entity)>& name_of) {
    const WhatIfRun& played = measured.runs.front();
    const std::string setting = short_text(played.stepping);
    if (!played.failure.empty()) return {Grade::bad, played.failure + cure_text(measured)};
    if (!(measured.certain_until > 0) || (std::isnan(played.distance) && !played.other_play_from))
        return {Grade::unknown, fmt::format("What {} costs is not known yet.", setting)};
    const std::string end = end_text(measured, begin);
    const Reading* const reading = worst_reading(measured, before);
    if (played.other_play_from)
        return {Grade::bad,
                (reading ? reading_text(measured, *reading) : other_play_text(measured, begin)) +
                    cure_text(measured) + end};
    const auto now = [&](Grade grade) { return is_known_now(measured) ? grade : Grade::unknown; };
    const Grade grade = measured.grade_of(played);
    if (reading)
        return {now(std::max(grade, Grade::visible)),
                reading_text(measured, *reading) + cure_text(measured) + end};
    return {now(grade), distance_text(measured, begin, name_of) + end};
}

}  // namespace oiler
