// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/game/input_source.hpp"
#include "oiler/physics/rate.hpp"
#include "oiler/play/recording.hpp"

namespace oiler {

/// Steps of two rates that start at the same time, matched in integers.
class StepRatio {
public:
    StepRatio(Rate from, Rate to);

    /// Whether the step begins at or after step `from` of the other rate.
    [[nodiscard]] bool reaches(std::int64_t to, std::int64_t from) const {
        return to * denominator_ >= from * numerator_;
    }
    /// The last step that begins until the time at which `from` begins.
    [[nodiscard]] std::int64_t last_until(std::int64_t from) const {
        return from * numerator_ / denominator_;
    }
    /// How long after the beginning of step `to` the step `from` begins, in steps of the former.
    [[nodiscard]] double since(std::int64_t to, std::int64_t from) const {
        return static_cast<double>(from * numerator_ - to * denominator_) /
               static_cast<double>(denominator_);
    }
    /// Whether a step begins at the same time as `from`.
    [[nodiscard]] bool has(std::int64_t from) const {
        return from * numerator_ % denominator_ == 0;
    }

private:
    std::int64_t numerator_;
    std::int64_t denominator_;
};

/// Plays the input of a recording at another rate. An event of a recorded step goes to the first
/// step that begins no earlier, so that no press is lost: presses of several recorded steps in one
/// step add up. A button that goes down and up within one step is seen released by the next one, as
/// in live play.
class ResampledInput final : public InputSource {
public:
    ResampledInput(const Recording& recording, Rate rate, ChosenControls controls = {})
        : recording_(recording),
          ratio_(recording.header.stepping.rate, rate),
          player_(std::move(controls)) {}

    [[nodiscard]] Input next(std::int64_t step) override;

private:
    const Recording& recording_;
    StepRatio ratio_;
    EventPlayer player_;
    std::size_t played_ = 0;
};

}  // namespace oiler
