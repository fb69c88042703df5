// SPDX-License-Identifier: MIT
#include "oiler/whatif/played_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

using Times = std::vector<std::chrono::nanoseconds>;

constexpr double lasting_difference = 0.25;  // s
constexpr double frames_per_second = 60;

Rate rate_of_instants(Rate recorded) {
    recorded.steps *= instants_per_step;
    return recorded;
}

/// The largest distance as drawn, `alpha` of the way between two steps of a run; empty if there are
/// no bodies or if the three are not the same play.
std::optional<Apart> largest_drawn(const Moment& before, const Moment& after, double alpha,
                                   const Moment& truth) {
    if (truth.bodies.empty() || !is_same_play(before, after)) return std::nullopt;
    return largest_distance(truth, between(before, after, alpha));
}

/// Keeps a time, of many the last ones.
void keep(Times& times, std::chrono::nanoseconds time, std::int64_t step) {
    constexpr std::size_t most = 4096;
    if (times.size() < most)
        times.push_back(time);
    else
        times[static_cast<std::size_t>(step) % most] = time;
}

/// The mean without the fastest and the slowest quarter, ns; 0 of none. Clocks count in steps of
/// some 10 ns, so a median of short times would be 0 or a step.
double middle_mean(Times times) {
    if (times.empty()) return 0;
    std::ranges::sort(times);
    const auto quarter = static_cast<std::ptrdiff_t>(times.size() / 4);
    const auto sum = std::accumulate(times.begin() + quarter, times.end() - quarter,
                                     std::chrono::nanoseconds{0});
    return static_cast<double>(sum.count()) / static_cast<double>(std::ssize(times) - 2 * quarter);
}

/// The time that a stopwatch measures of itself, ns.
double time_of_stopwatch() {
    Times times(101);
    for (std::chrono::nanoseconds& time : times) {
        StepTimes sums;
        { const Stopwatch empty(&sums, &StepTimes::step); }
        time = sums.step;
    }
    return middle_mean(times);
}

}  // namespace

PlayedRun::PlayedRun(const Stepping& stepping, const RecordedPlay& play, const MakeGame& make)
    : result_{.stepping = stepping},
      inputs_(play.recording, stepping.rate, play.controls),
      recorded_rate_(play.recording.header.stepping.rate),
      ratio_(recorded_rate_, stepping.rate),
      instants_(rate_of_instants(recorded_rate_), stepping.rate) {
    Settings settings = play.settings;
    settings.stepping = stepping;
    game_ = make(settings);
    game_->world().require_applicable();
    game_->measure(times_);
}

void PlayedRun::play_until(std::int64_t recorded) {
    play_until_instant(recorded * instants_per_step);
}

void PlayedRun::play_until_instant(std::int64_t index) {
    while (steps_ < instants_.last_until(index) && goes_on()) take_step();
}

void PlayedRun::play_until(std::int64_t recorded, const std::deque<TrueMoment>& truth,
                           double visible) {
    result_.distance_now = 0;
    const Rate rate = rate_of_instants(recorded_rate_);
    auto next = std::ranges::partition_point(
        truth, [&](const TrueMoment& at) { return instants_.since(steps_, at.index) <= 0; });
    while (steps_ < ratio_.last_until(recorded) && goes_on()) {
        const bool is_compared = next != truth.end() && !result_.other_play_from &&
                                 instants_.since(steps_, next->index) <= 1;
        if (!is_compared) {
            take_step();
            continue;
        }
        const Moment before = moment();
        const std::int64_t step = steps_;
        take_step();
        if (steps_ == step) return;
        for (; next != truth.end(); ++next) {
            const double alpha = instants_.since(step, next->index);
            if (alpha > 1) break;
            if (const auto apart = largest_drawn(before, moment(), alpha, next->moment))
                note(*apart, rate.time(next->index), visible);
        }
    }
}

const Moment& PlayedRun::moment() {
    if (!moment_) moment_ = moment_of(*game_);
    return *moment_;
}

void PlayedRun::take_step() {
    times_ = {};
    moment_.reset();
    const std::int64_t before = game_->world().bodies().evaluations();
    try {
        steps_ += game_->step(steps_, 1, inputs_);
        // A world that a game makes anew counts from 0.
        const std::int64_t after = game_->world().bodies().evaluations();
        evaluations_ += after - (after < before ? 0 : before);
    } catch (const Error& error) {
        if (error.exit() != Exit::diverged && error.exit() != Exit::usage) throw;
        result_.failure = error.what();
    }
    keep(updates_, times_.update, steps_);
    if (times_.step.count() > 0) keep(world_steps_, times_.step, steps_);
}

void PlayedRun::compare(std::int64_t recorded, double time, const Moment& reference,
                        double visible) {
    if (failed() || result_.other_play_from || !ratio_.has(recorded)) return;
    const std::optional<Apart> apart = largest_distance(reference, moment());
    if (!apart) {
        differs_from_ = differs_from_.value_or(time);
        if (time - *differs_from_ >= lasting_difference) result_.other_play_from = differs_from_;
        return;
    }
    differs_from_.reset();
    if (recorded == 0 || reference.bodies.empty()) return;
    if (!(apart->distance <= result_.distance_at_steps))
        result_.distance_at_steps = apart->distance;
    note(*apart, time, visible);
}

void PlayedRun::note(const Apart& apart, double time, double visible) {
    if (!(apart.distance <= result_.distance)) {
        result_.distance = apart.distance;
        result_.furthest = apart.body;
    }
    result_.distance_now = std::max(result_.distance_now, apart.distance);
    if (apart.distance > visible && !result_.visible_from) result_.visible_from = time;
}

void PlayedRun::read(std::int64_t recorded, const std::vector<Reading>& truth) {
    if (failed() || !ratio_.has(recorded)) return;
    result_.readings = game_->readings();
    result_.true_readings = truth;
    result_.read_at = recorded_rate_.time(recorded);
}

void PlayedRun::time_picture() {
    if (failed()) return;
    const auto start = std::chrono::steady_clock::now();
    const Picture picture = game_->picture();
    pictures_.push_back(std::chrono::steady_clock::now() - start);
}

void PlayedRun::time_drawing(DrawTimer& draw) {
    if (!failed()) drawings_.push_back(draw.time(game_->picture()));
}

WhatIfRun PlayedRun::finish() const {
    const double stopwatch = time_of_stopwatch();
    const auto typical = [&](const Times& times) {
        return std::max(0.0, middle_mean(times) - stopwatch);
    };
    WhatIfRun result = result_;
    const double steps_per_frame = 1 / (result.stepping.rate.dt() * frames_per_second);
    result.costs = {.update = steps_per_frame * typical(updates_),
                    .step = steps_per_frame * typical(world_steps_),
                    .picture = typical(pictures_)};
    if (steps_ > 0)
        result.evaluations = static_cast<double>(evaluations_) /
                             (result.stepping.rate.dt() * static_cast<double>(steps_));
    if (!drawings_.empty()) result.costs.draw = typical(drawings_);
    return result;
}

}  // namespace oiler
