// SPDX-License-Identifier: MIT
#include "oiler/core/step_clock.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

namespace oiler {
namespace {

using std::chrono::nanoseconds;

constexpr std::int64_t per_second = 1'000'000'000;
constexpr std::int64_t largest_whole = per_second * StepClock::largest_scale;

static_assert(StepClock::longest_frame_limit.count() <=
                  (std::numeric_limits<std::int64_t>::max() - largest_whole) /
                      StepClock::largest_rate / StepClock::largest_scale,
              "the longest frame at the largest rate and scale overflows the accumulator");
static_assert(largest_whole <= std::numeric_limits<std::int64_t>::max() / StepClock::largest_scale,
              "changing the scale overflows the accumulator");
static_assert(largest_whole < std::int64_t{1} << std::numeric_limits<double>::digits,
              "alpha could round up to 1");

}  // namespace

StepClock::StepClock(int rate, nanoseconds longest_frame) : rate_(rate) {
    assert(rate >= 1 && rate <= largest_rate);
    set_longest_frame(longest_frame);
}

void StepClock::set_longest_frame(nanoseconds longest_frame) {
    assert(longest_frame > nanoseconds{0} && longest_frame <= longest_frame_limit);
    longest_frame_ = longest_frame;
}

StepClock::Frame StepClock::advance(nanoseconds now) {
    Frame frame;
    const nanoseconds difference = last_stamp_ ? now - *last_stamp_ : nanoseconds{0};
    const nanoseconds elapsed = std::max(difference, nanoseconds{0});
    frame.backward = elapsed - difference;
    last_stamp_ = now;
    if (paused_) {
        frame.steps = std::exchange(single_step_, false) ? 1 : 0;
    } else {
        const nanoseconds kept = std::min(elapsed, longest_frame_);
        frame.dropped = elapsed - kept;
        frame.steps = whole_steps(kept);
    }
    ticks_ += frame.steps;
    dropped_time_ += frame.dropped;
    return frame;
}

std::int64_t StepClock::whole_steps(nanoseconds elapsed) {
    accumulated_ += elapsed.count() * rate_ * scale_numerator_;
    const std::int64_t whole = per_second * scale_denominator_;
    const std::int64_t steps = accumulated_ / whole;
    accumulated_ %= whole;
    return steps;
}

StepClock::Remainder StepClock::remainder() const {
    return {accumulated_, per_second * scale_denominator_};
}

double StepClock::alpha() const {
    const auto [parts, whole] = remainder();
    return static_cast<double>(parts) / static_cast<double>(whole);
}

void StepClock::resume() {
    if (!paused_) return;
    paused_ = false;
    single_step_ = false;
    last_stamp_.reset();
}

void StepClock::single_step() {
    assert(paused_);
    single_step_ = true;
}

void StepClock::set_time_scale(int numerator, int denominator) {
    assert(numerator >= 0 && numerator <= largest_scale);
    assert(denominator >= 1 && denominator <= largest_scale);
    const std::int64_t divisor = std::gcd(numerator, denominator);
    const std::int64_t reduced = denominator / divisor;
    const std::int64_t common = std::lcm(scale_denominator_, reduced);
    const std::int64_t common_numerator = numerator / divisor * (common / reduced);
    const bool exact = common <= largest_scale && common_numerator <= largest_scale;

    const std::int64_t before = scale_denominator_;
    scale_denominator_ = exact ? common : reduced;
    scale_numerator_ = exact ? common_numerator : numerator / divisor;
    accumulated_ = accumulated_ * scale_denominator_ / before;
}

HeadlessFrame headless_frame(std::int64_t frame, int rate, int fps) {
    assert(frame >= 0 && rate >= 1 && fps >= 1);
    // Splitting off whole seconds keeps frame · rate from overflowing.
    const std::int64_t rest = frame % fps * rate;
    return {frame / fps * rate + rest / fps, static_cast<double>(rest % fps) / fps};
}

}  // namespace oiler
