// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "oiler/app/resampled.hpp"
#include "oiler/app/step_times.hpp"
#include "oiler/app/what_if.hpp"

namespace oiler {

/// A play at one time.
struct Moment {
    struct Placed {
        Entity entity;
        std::uint32_t jumps;
        Vec3 position;
    };
    std::int64_t cuts = 0;
    bool quits = false;
    std::vector<Placed> bodies{};  ///< in the order of their entities
    std::vector<Reading> readings{};
};

[[nodiscard]] Moment moment_of(const AnyGame& game);

/// A body that is away from where it is in another play.
struct Apart {
    double distance = 0;  ///< m
    Entity body{};
};
/// The body with the largest distance from that of the other play; empty if bodies, teleports,
/// restarts or whole-number readings differ.
[[nodiscard]] std::optional<Apart> largest_distance(const Moment& a, const Moment& b);

/// A recording that is played with one setting.
class PlayedRun {
public:
    /// Throws Error{usage} if the method cannot step the bodies of the game.
    PlayedRun(const Stepping& stepping, const Options& options, const MakeGame& make);
    PlayedRun(const PlayedRun&) = delete;
    PlayedRun& operator=(const PlayedRun&) = delete;

    /// Takes all steps until a recorded one begins, unless one fails.
    void play_until(std::int64_t recorded);
    /// Compares the play with the reference as that recorded step begins, `time` in s, if a step of
    /// this run begins then, too. A larger distance than `visible`, m, can be seen.
    void compare(std::int64_t recorded, double time, const Moment& reference, double visible);
    /// Reads the game as that recorded step begins, if a step of this run begins then, too.
    /// `truth` are the readings of the reference.
    void read(std::int64_t recorded, const std::vector<Reading>& truth);
    void time_picture();
    void time_drawing(DrawTimer& draw);

    [[nodiscard]] const AnyGame& game() const { return *game_; }
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    [[nodiscard]] const WhatIfRun& result() const { return result_; }
    /// Whether the play was another one at the last time of comparison.
    [[nodiscard]] bool differs() const { return differs_from_.has_value(); }
    [[nodiscard]] bool failed() const { return !result_.failure.empty(); }
    /// The result with costs and readings.
    [[nodiscard]] WhatIfRun finish() const;

private:
    void take_step();

    WhatIfRun result_;
    ResampledInput inputs_;
    Rate recorded_rate_;
    StepRatio ratio_;
    StepTimes times_;
    std::unique_ptr<AnyGame> game_;
    std::int64_t steps_ = 0;
    std::int64_t evaluations_ = 0;
    std::optional<double> differs_from_;
    std::vector<std::chrono::nanoseconds> updates_;
    std::vector<std::chrono::nanoseconds> world_steps_;
    std::vector<std::chrono::nanoseconds> pictures_;
    std::vector<std::chrono::nanoseconds> drawings_;
};

}  // namespace oiler
