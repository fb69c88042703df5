// SPDX-License-Identifier: MIT
#include "oiler/app/game_clock.hpp"

#include <fmt/core.h>

#include <utility>

namespace oiler {

std::string Pace::text() const {
    if (exponent_ == 0) return {};
    return exponent_ > 0 ? fmt::format("{}× (F7 slower)", numerator())
                         : fmt::format("1/{}× (F8 faster)", denominator());
}

void KeptPace::add(std::chrono::duration<double> work, std::chrono::duration<double> period,
                   std::chrono::duration<double> late) {
    work_ += (work.count() - work_) / 16;
    if (period.count() > 0) late_ += (late / period - late_) / 16;
}

std::string KeptPace::text() const {
    if (late_ > 0.1)
        return fmt::format("too slow here: {:.0f} % of its pace. A lower rate helps",
                           100 * (1 - late_));
    if (work_ > 0.05)
        return fmt::format("{:.0f} frames a second: a smaller window helps", 1 / work_);
    return {};
}

void GameClock::begin(const Rate& rate, std::int64_t step, bool keeps_pause) {
    dropped_ += clock_.dropped_time();
    const bool was_paused = is_paused();
    clock_ = StepClock(static_cast<int>(rate.steps));
    if (was_paused && keeps_pause) pause();
    first_ = step;
    has_timed_steps_ = false;
    kept_pace_ = {};
}

std::int64_t GameClock::advance(std::chrono::nanoseconds now) {
    clock_.set_time_scale(pace_.numerator(), pace_.denominator());
    if (!has_timed_steps_) catch_up_at_most(2 * duration_of_step());
    const StepClock::Frame owed = clock_.advance(now);
    late_ = owed.dropped;
    return owed.steps;
}

void GameClock::limit_steps(std::int64_t steps, std::chrono::nanoseconds time) {
    constexpr double most = 0.1;  // s, for the steps of a frame
    if (!std::exchange(has_timed_steps_, true)) dropped_ -= clock_.dropped_time();
    const double took = std::chrono::duration<double>(time).count();
    const double step = duration_of_step();
    catch_up_at_most(took > 0 ? std::max(step, most / took * static_cast<double>(steps) * step)
                              : 1);
}

void GameClock::end_frame(std::chrono::nanoseconds work, std::chrono::nanoseconds period) {
    if (has_timed_steps_) kept_pace_.add(work, period, late_);
}

/// The real time of a step, s.
double GameClock::duration_of_step() const {
    return static_cast<double>(pace_.denominator()) /
           (static_cast<double>(clock_.rate()) * pace_.numerator());
}

void GameClock::catch_up_at_most(double seconds) {
    const std::chrono::duration<double> limit(std::min(seconds, 0.25));
    clock_.set_longest_frame(std::chrono::ceil<std::chrono::nanoseconds>(limit));
}

}  // namespace oiler
