// SPDX-License-Identifier: MIT
#include "oiler/play/replay.hpp"

#include <fmt/core.h>

#include <numeric>

#include "oiler/core/error.hpp"

namespace oiler {

Input Replay::next(std::int64_t step) {
    const auto& events = recording_.events;
    for (; played_ < events.size() && events[played_].step <= step; ++played_)
        player_.play(events[played_].event);
    return player_.take();
}

void Replay::after(std::int64_t step, const AnyGame& game) {
    if (!difference_.empty()) return;
    const auto recorded = recording_.states.find(step);
    if (recorded == recording_.states.end()) return;
    const PartHashes now = part_hashes(game);
    if (now == recorded->second) {
        equal_until_ = step;
        ++compared_;
        return;
    }
    const bool in_bodies = now.bodies != recorded->second.bodies;
    differ(fmt::format(
        "in {} after step {}; it is equal after {}",
        in_bodies ? "the bodies" : "components, timers, random numbers or members of the game",
        step + 1, equal_until_ + 1));
}

void Replay::compare_end(std::int64_t steps, bool quits) {
    const std::int64_t end = recording_.steps;
    if (quits && steps < end)
        differ(fmt::format("in that the game quits after step {}, in the recording {}", steps,
                           recording_.quits ? fmt::format("after step {}", end) : "it does not"));
    if (recording_.quits && steps > end)
        differ(fmt::format(
            "in that the game goes on after step {}, where it quits in the recording", end));
}

void Replay::differ(std::string how) {
    if (!difference_.empty()) return;
    difference_ = fmt::format("{}: the replay differs {}", name_, how);
    if (!plays_on_)
        fail(Exit::comparison_failed, "{}; if the game was changed, --replay-anyway plays on",
             difference_);
}

StepRatio::StepRatio(Rate from, Rate to)
    : numerator_(to.steps * from.seconds), denominator_(from.steps * to.seconds) {
    const std::int64_t common = std::gcd(numerator_, denominator_);
    numerator_ /= common;
    denominator_ /= common;
}

Input ResampledInput::next(std::int64_t step) {
    const auto& events = recording_.events;
    for (; played_ < events.size() && ratio_.reaches(step, events[played_].step); ++played_)
        player_.play(events[played_].event);
    return player_.take();
}

}  // namespace oiler
