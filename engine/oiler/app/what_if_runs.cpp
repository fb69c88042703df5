// SPDX-License-Identifier: MIT
#include "oiler/app/what_if_runs.hpp"

#include <algorithm>

#include "oiler/app/what_if_settings.hpp"
#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr std::int64_t least_factor = 16;
constexpr std::int64_t least_rate = 960;  // Hz
constexpr double pixels_of_height = 720;

/// rk4 at `least_factor` times the recorded rate, and at least at `least_rate`, or half of that.
Stepping reference_stepping(const Options& options, std::int64_t part) {
    Rate rate = options.replay->header.stepping.rate;
    const std::int64_t factor = (least_rate + rate.steps - 1) / rate.steps;
    rate.steps *= std::max(least_factor, factor + factor % 2) / part;
    return {.method = &find_method("rk4"), .rate = rate};
}

}  // namespace

WhatIfRuns::WhatIfRuns(const Options& options, const std::vector<Stepping>& steppings,
                       const MakeGame& make)
    : recording_(*options.replay),
      replay_(recording_, options.replay_file.string()),
      reference_(reference_stepping(options, 1), options, make),
      half_(reference_stepping(options, 2), options, make) {
    runs_.push_back(std::make_unique<PlayedRun>(recording_.header.stepping, options, make));
    for (const Stepping& stepping : steppings)
        runs_.push_back(std::make_unique<PlayedRun>(stepping, options, make));
}

void WhatIfRuns::play_until(std::int64_t step) {
    play_reference(step);
    for (const auto& run : runs_) run->play_until(step);
    if (step > 0 && !runs_.front()->failed()) replay_.after(step - 1, runs_.front()->game());
    if (certain_) compare(step);
}

void WhatIfRuns::play_reference(std::int64_t step) {
    for (PlayedRun* const run : {&reference_, &half_}) {
        run->play_until(step);
        if (run->failed())
            fail(Exit::diverged, "--what-if: the reference ({}) failed: {}",
                 describe(run->result().stepping), run->result().failure);
    }
}

void WhatIfRuns::time_pictures(DrawTimer* draw) {
    for (const auto& run : runs_) run->time_picture();
    if (draw)  // afterwards, because it empties the caches of the processor
        for (const auto& run : runs_) run->time_drawing(*draw);
}

WhatIf WhatIfRuns::result() const {
    WhatIf result{.duration = recording_.header.stepping.rate.time(recording_.steps),
                  .certain_until = certain_until_,
                  .uncertainty = uncertainty_,
                  .pixel = pixel_,
                  .reference = reference_.finish(),
                  .half = half_.finish()};
    for (const auto& run : runs_) result.runs.push_back(run->finish());
    return result;
}

void WhatIfRuns::compare(std::int64_t step) {
    const double time = recording_.header.stepping.rate.time(step);
    const Moment moment = moment_of(reference_.game());
    pixel_ = static_cast<double>(reference_.game().picture().camera.height) / pixels_of_height;
    half_.compare(step, time, moment, pixel_);
    certain_ = !half_.result().other_play_from && !half_.result().visible_from;
    if (!certain_ || half_.differs()) return;
    certain_until_ = time;
    uncertainty_ = half_.result().distance;
    for (const auto& run : runs_) run->compare(step, time, moment, pixel_ + uncertainty_);
}

}  // namespace oiler
