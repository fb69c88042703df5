// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/app/game.hpp"
#include "oiler/app/recorder.hpp"

namespace oiler {

/// Steps a game to the times at which it is looked at. What is shown at a time between two ticks
/// lies between the states at both, so the game is stepped to the later one.
class Playback {
public:
    /// `hashes`: whether somebody will ask for state_hash().
    Playback(AnyGame& game, Recorder& recorder, bool hashes);

    /// Steps to tick `tick`, which is not before the game's, many steps at once unless they are
    /// recorded. Stops early when interrupted.
    void step_to(std::int64_t tick, Input& input);

    /// What is to be seen `alpha` of the way from tick `tick` to the next. Ticks may not go back.
    [[nodiscard]] Picture show(std::int64_t tick, double alpha, Input& input);

    /// Of the tick shown last; 0 without `hashes`.
    [[nodiscard]] std::uint64_t state_hash() const { return before_.state_hash; }

private:
    struct Moment {
        std::int64_t tick = -1;
        std::uint64_t state_hash = 0;
        Picture picture;
    };

    [[nodiscard]] Moment look() const;

    AnyGame& game_;
    Recorder& recorder_;
    bool hashes_;
    Moment before_;
    Moment after_;
};

}  // namespace oiler
