// SPDX-License-Identifier: MIT
#include "oiler/play/resampled.hpp"

#include <numeric>

namespace oiler {

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
