// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "oiler/game/step_times.hpp"
#include "oiler/play/resampled.hpp"
#include "oiler/whatif/moment.hpp"
#include "oiler/whatif/what_if.hpp"

namespace oiler {

/// How many moments of a recorded step are compared.
inline constexpr std::int64_t instants_per_step = 16;

/// The true motion at the instant `index`, of which each recorded step has instants_per_step.
struct TrueMoment {
    std::int64_t index = 0;
    Moment moment;
};

/// A recording that is played with one setting.
class PlayedRun {
public:
    /// Throws Error{usage} if the method cannot step the bodies of the game.
    PlayedRun(const Stepping& stepping, const RecordedPlay& play, const MakeGame& make);
    PlayedRun(const PlayedRun&) = delete;
    PlayedRun& operator=(const PlayedRun&) = delete;

    /// Takes all steps until a recorded one begins, unless one fails.
    void play_until(std::int64_t recorded);
    /// The same, and compares what is drawn between these steps, and at their ends, with the
    /// moments of the reference. A larger distance than `visible`, m, can be seen.
    void play_until(std::int64_t recorded, const std::deque<TrueMoment>& truth, double visible);
    /// Takes all steps until an instant.
    void play_until_instant(std::int64_t index);
    /// Compares the play with the reference as that recorded step begins, `time` in s, if a step of
    /// this run begins then, too.
    void compare(std::int64_t recorded, double time, const Moment& reference, double visible);
    /// Reads the game as that recorded step begins, if a step of this run begins then, too.
    /// `truth` are the readings of the reference.
    void read(std::int64_t recorded, const std::vector<Reading>& truth);
    void time_picture();
    void time_drawing(DrawTimer& draw);

    [[nodiscard]] const AnyGame& game() const { return *game_; }
    /// The play as it is now.
    [[nodiscard]] const Moment& moment();
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    [[nodiscard]] const WhatIfRun& result() const { return result_; }
    /// Whether the play was another one at the last time of comparison.
    [[nodiscard]] bool differs() const { return differs_from_.has_value(); }
    [[nodiscard]] bool failed() const { return !result_.failure.empty(); }
    /// The result with costs and readings.
    [[nodiscard]] WhatIfRun finish() const;

private:
    [[nodiscard]] bool goes_on() const { return !game_->loop().quits() && !failed(); }
    void take_step();
    void note(const Apart& apart, double time, double visible);

    WhatIfRun result_;
    ResampledInput inputs_;
    Rate recorded_rate_;
    StepRatio ratio_;
    StepRatio instants_;
    StepTimes times_;
    std::unique_ptr<AnyGame> game_;
    std::int64_t steps_ = 0;
    std::int64_t evaluations_ = 0;
    std::optional<Moment> moment_;  ///< empty: a step was taken since
    std::optional<double> differs_from_;
    std::vector<std::chrono::nanoseconds> updates_;
    std::vector<std::chrono::nanoseconds> world_steps_;
    std::vector<std::chrono::nanoseconds> pictures_;
    std::vector<std::chrono::nanoseconds> drawings_;
};

}  // namespace oiler
