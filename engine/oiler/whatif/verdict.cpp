// SPDX-License-Identifier: MIT
#include "oiler/whatif/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace oiler {
namespace {

constexpr double pixels_of_bad = 7.2;  // a hundredth of 720 lines
constexpr double least_difference = 0.01;
constexpr double most_pixels = 99'999;

std::string setting_text(const Stepping& stepping) {
    return fmt::format("{} Hz {}", stepping.rate.steps, stepping.method->name);
}

/// What a run has that the played one has not.
std::string change_text(const Stepping& change, const Stepping& played) {
    if (change.method != played.method) return std::string(change.method->name);
    if (change.rate != played.rate) return fmt::format("{} Hz", change.rate.steps);
    return std::string(name_of(change.precision));
}

double cost(const WhatIfRun& run) { return run.costs.update + run.costs.step; }

bool is_sound(const WhatIfRun& run) { return run.failure.empty() && !run.other_play_from; }

/// The largest error that a run may have, m.
double most_error(const WhatIfRun& run, const WhatIf& measured) {
    return std::max(run.distance, least_certain * measured.uncertainty);
}

/// A setting that is off by more than the height of a picture, in pixels, mends nothing.
constexpr double most_cured = 720;

/// The other run with the smallest error, if that is at most half of the played one and in the
/// picture; else null.
const WhatIfRun* best(const WhatIf& measured) {
    const WhatIfRun* best = nullptr;
    double least = std::min(measured.runs.front().distance / 2, most_cured * measured.pixel);
    for (const WhatIfRun& run : measured.runs) {
        const double most = most_error(run, measured);
        if (!is_sound(run) ||
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

/// The cheapest other run whose errors no player sees, or else the best; null if there is none.
const WhatIfRun* cure(const WhatIf& measured) {
    const WhatIfRun* cheapest = nullptr;
    for (std::size_t i = 1; i < measured.runs.size(); ++i) {
        const WhatIfRun& run = measured.runs[i];
        if (!is_sound(run) || !(most_error(run, measured) <= measured.pixel)) continue;
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
    const double certain = least_certain * measured.uncertainty;
    if (run.distance < certain)
        return certain <= part_of_exact * measured.pixel
                   ? "exact"
                   : fmt::format("less than {} off", length_text(certain));
    const bool only_lines = run.distance_at_steps < certain && run.distance <= measured.pixel;
    return only_lines ? "exact at the steps" : length_text(run.distance) + " off";
}

std::string cure_text(const WhatIf& measured) {
    const WhatIfRun* const run = cure(measured);
    if (!run) return "";
    const WhatIfRun& played = measured.runs.front();
    return fmt::format(" {}: {}, {}.", change_text(run->stepping, played.stepping),
                       error_text(*run, measured), price_text(*run, measured));
}

/// The reading that is off the most, relative to its truth, of those at rest; null if none is off
/// enough.
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
        const double unsure = least_certain * std::abs(check[i].value - truth[i].value);
        const bool is_seen = played[i].unit == "m"
                                 ? off > measured.pixel
                                 : off > least_difference * std::abs(truth[i].value);
        const double relative = off / std::max(std::abs(truth[i].value), 1e-300);
        if (!is_seen || off < unsure || relative <= largest) continue;
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
                       setting_text(measured.runs.front().stepping));
}

}  // namespace

std::string length_text(double metres) {
    if (metres == 0) return "0 m";
    if (metres < 1e-12) return fmt::format("{:.0e} m", metres);
    if (metres < 99e-9) return fmt::format("{:.2g} nm", 1e9 * metres);
    if (metres < 9.95e-5) return fmt::format("{:.2g} µm", 1e6 * metres);
    if (metres < 0.01) return fmt::format("{:.2g} mm", 1000 * metres);
    if (metres < 0.995) return fmt::format("{:.2g} cm", 100 * metres);
    if (metres < 999.5) return fmt::format("{:.3g} m", metres);
    if (metres < 1e6) return fmt::format("{:.0f} m", metres);
    return fmt::format("{:.1e} m", metres);
}

Verdict::Grade grade_of(double pixels) {
    using Grade = Verdict::Grade;
    if (std::isnan(pixels)) return Grade::unknown;
    return pixels > pixels_of_bad ? Grade::bad : pixels > 1 ? Grade::visible : Grade::good;
}

Verdict verdict_of(const WhatIf& measured, const std::vector<Reading>& before, double begin,
                   const std::function<std::string(Entity)>& name_of) {
    using Grade = Verdict::Grade;
    const WhatIfRun& played = measured.runs.front();
    const std::string setting = setting_text(played.stepping);
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
    const double known = most_error(played, measured);
    const bool is_hidden = known > played.distance && known > measured.pixel;
    const Grade grade = is_hidden ? Grade::unknown : grade_of(pixels);
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

}  // namespace oiler
