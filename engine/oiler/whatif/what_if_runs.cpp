// SPDX-License-Identifier: MIT
#include "oiler/whatif/what_if_runs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "oiler/core/error.hpp"
#include "oiler/whatif/what_if_settings.hpp"

namespace oiler {
namespace {

constexpr std::int64_t least_rate = 960;  // Hz
constexpr double pixels_of_height = 720;

/// How many steps of the reference a recorded step has, a multiple of the instants that are
/// compared, and so many that its rate is at least `least_rate`.
std::int64_t reference_factor(const RecordedPlay& play) {
    const std::int64_t recorded = play.recording.header.stepping.rate.steps;
    const std::int64_t factor = (least_rate + recorded - 1) / recorded;
    return (factor + instants_per_step - 1) / instants_per_step * instants_per_step;
}
Stepping reference_stepping(const RecordedPlay& play) {
    Rate rate = play.recording.header.stepping.rate;
    rate.steps *= reference_factor(play);
    return {.method = &find_method("rk4"), .rate = rate};
}
/// A little less than half the rate of the reference: both begin a step at the same time only
/// where a recorded one begins, so that what a game does in its updates, such as a bounce, is late
/// by different times.
Stepping check_stepping(const RecordedPlay& play) {
    Stepping stepping = reference_stepping(play);
    stepping.rate = play.recording.header.stepping.rate;
    stepping.rate.steps *= reference_factor(play) / 2 - 1;
    return stepping;
}

}  // namespace

WhatIfRuns::WhatIfRuns(const RecordedPlay& play, const std::vector<Stepping>& steppings,
                       const MakeGame& make)
    : recording_(play.recording),
      replay_(recording_, play.name, {}, play.plays_on),
      reference_(reference_stepping(play), play, make),
      check_(check_stepping(play), play, make) {
    runs_.push_back(std::make_unique<PlayedRun>(recording_.header.stepping, play, make));
    for (const Stepping& stepping : steppings)
        runs_.push_back(std::make_unique<PlayedRun>(stepping, play, make));
    const double dt = recording_.header.stepping.rate.dt();
    for (const Stepping& stepping : steppings)
        longest_ =
            std::max<std::int64_t>(longest_, std::llround(std::ceil(stepping.rate.dt() / dt)));
}

void WhatIfRuns::play_until(std::int64_t step) {
    const bool is_known = play_reference(step);
    before_ = runs_.front()->moment();
    step_ = step;
    for (const auto& run : runs_) run->play_until(step, truth_, visible());
    const std::vector<Reading> truth = reference_.game().readings();
    for (PlayedRun* const run : {&reference_, &check_}) run->read(step, truth);
    for (const auto& run : runs_) run->read(step, truth);
    if (const AnyGame& game = runs_.front()->game(); game.loop().quits())
        replay_.compare_end(runs_.front()->steps(), true);
    if (step > 0 && !runs_.front()->failed()) replay_.after(step - 1, runs_.front()->game());
    if (!is_known) return;
    const double time = recording_.header.stepping.rate.time(step);
    for (const auto& run : runs_) run->compare(step, time, truth_.back().moment, visible());
}

void WhatIfRuns::compare_end() {
    PlayedRun& recorded = *runs_.front();
    if (!recording_.quits || recorded.failed()) return;
    // A game that quits does it in the update of a step that it does not take.
    recorded.play_until(recording_.steps + 1);
    replay_.compare_end(recorded.steps(), recorded.game().loop().quits());
}

bool WhatIfRuns::play_reference(std::int64_t step) {
    std::vector<TrueMoment> moments;
    const std::int64_t last = step * instants_per_step;
    for (std::int64_t i = step == 0 ? 0 : last - instants_per_step + 1; i <= last; ++i) {
        reference_.play_until_instant(i);
        if (certain_) moments.push_back({i, moment_of(reference_.game())});
    }
    check_.play_until(step);
    for (PlayedRun* const run : {&reference_, &check_})
        if (run->failed())
            fail(Exit::diverged, "--what-if: the reference ({}) failed: {}",
                 describe(run->result().stepping), run->result().failure);
    while (!truth_.empty() && truth_.front().index < last - (longest_ + 1) * instants_per_step)
        truth_.pop_front();
    if (!certain_ || !check(step, moments.back().moment)) return false;
    std::ranges::move(moments, std::back_inserter(truth_));
    return true;
}

bool WhatIfRuns::check(std::int64_t step, const Moment& moment) {
    const double time = recording_.header.stepping.rate.time(step);
    pixel_ = static_cast<double>(reference_.game().picture().camera.height) / pixels_of_height;
    check_.compare(step, time, moment, pixel_);
    certain_ = !check_.result().other_play_from && !check_.result().visible_from;
    if (!certain_ || check_.differs()) return false;
    certain_until_ = time;
    if (const double distance = check_.result().distance; !std::isnan(distance))
        uncertainty_ = distance;
    return true;
}

std::optional<WhatIfRuns::Drawn> WhatIfRuns::drawn(double alpha) const {
    const Moment& after = runs_.front()->moment();
    const std::int64_t first = (step_ - 1) * instants_per_step;
    const auto truth = std::ranges::find(truth_, first, &TrueMoment::index);
    const bool is_known = truth != truth_.end() && truth_.end() - truth > instants_per_step;
    if (!is_known || before_.cuts != after.cuts) return std::nullopt;
    const double place = alpha * static_cast<double>(instants_per_step);
    const auto instant = std::min(static_cast<std::int64_t>(place), instants_per_step - 1);
    return Drawn{between(before_, after, alpha),
                 between(truth[instant].moment, truth[instant + 1].moment,
                         place - static_cast<double>(instant))};
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
                  .check = check_.finish()};
    for (const auto& run : runs_) result.runs.push_back(run->finish());
    return result;
}

}  // namespace oiler
