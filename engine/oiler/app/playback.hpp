// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oiler/app/trace_writer.hpp"
#include "oiler/capture/frame_record.hpp"
#include "oiler/core/profile.hpp"
#include "oiler/game/game.hpp"
#include "oiler/play/replay.hpp"

namespace oiler {

/// The data that a playback keeps for a capture, besides the picture.
enum class Keep {
    nothing,
    hashes,  ///< of each frame, and of each step of a world with up to 1000 bodies
};

/// Steps a game to the times of its frames. A frame between two ticks is interpolated, so the game
/// is stepped to the later tick.
class Playback {
public:
    Playback(AnyGame& game, TraceWriter& trace, Keep keep, Profile* profile = nullptr);

    /// Steps until the loop has taken `step` steps. Takes many steps per call unless they are
    /// written or hashed. Calls are short, so that an interrupt stops it early.
    void step_to(std::int64_t step, InputSource& inputs);

    /// The picture at `alpha` in [0, 1) between the states after `step` steps and the next; if the
    /// game replaced its world between them, the former state's. `step` must not decrease. The
    /// picture lasts until the next call; the caller may draw over it.
    [[nodiscard]] Picture& show(std::int64_t step, double alpha, InputSource& inputs);
    /// The picture of the last whole step that was shown.
    [[nodiscard]] Picture& show_last() { return shown_ = before_.picture; }
    /// Whether the picture shows a step before a restart or rewind that the game has already made.
    [[nodiscard]] bool shows_before_cut() const {
        return after_.step >= 0 && before_.cuts != after_.cuts;
    }
    /// Shows the game after it was moved to its state after `step` steps.
    void go_to(std::int64_t step);
    [[nodiscard]] AnyGame& game() { return game_; }
    [[nodiscard]] const AnyGame& game() const { return game_; }
    /// Shows the game to a watcher after each step. It must outlive the playback.
    void watch(StepWatcher& watcher) { watcher_ = &watcher; }
    [[nodiscard]] const Loop& loop() const { return game_.loop(); }
    /// The number of steps that the loop has taken.
    [[nodiscard]] std::int64_t steps() const { return steps_; }

    [[nodiscard]] const World& world() const { return game_.world(); }
    /// State hash after the last shown step; 0 if no hashes are kept.
    [[nodiscard]] std::uint64_t state_hash() const { return before_.state_hash; }
    /// The bodies after the last shown step; none if no hashes are kept, or above 1000.
    [[nodiscard]] const std::vector<BodyState>& bodies() const { return before_.bodies; }
    /// The obstacles then; absent if no hashes are kept, or above 1000.
    [[nodiscard]] const std::optional<std::vector<ObstacleState>>& obstacles() const {
        return before_.obstacles;
    }
    /// The last four digits of the hash after each step from `first` + 1 to `last`; empty if one of
    /// them is not kept.
    [[nodiscard]] std::string tick_hashes(std::int64_t first, std::int64_t last) const;

private:
    struct Sample {
        std::int64_t step = -1;
        std::int64_t cuts = 0;
        std::uint64_t state_hash = 0;
        std::vector<BodyState> bodies{};
        std::optional<std::vector<ObstacleState>> obstacles{};
        Picture picture{};
    };

    [[nodiscard]] Sample sample() const;
    void take(std::int64_t count, InputSource& inputs);
    [[nodiscard]] bool hashes_ticks() const;

    AnyGame& game_;
    TraceWriter& trace_;
    Keep keep_;
    Profile* profile_;
    StepWatcher* watcher_ = nullptr;
    std::int64_t steps_ = 0;
    std::int64_t steps_per_call_ = 1;
    std::string tick_hashes_;  ///< four digits for each step, or dots
    Sample before_;
    Sample after_;
    Picture shown_;  ///< kept for its memory: a million discs are 40 MB
};

}  // namespace oiler
