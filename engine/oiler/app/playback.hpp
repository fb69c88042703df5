// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/app/game.hpp"
#include "oiler/app/recorder.hpp"

namespace oiler {

/// Steps a game to the times of its frames. A frame between two ticks interpolates both, so the
/// game is stepped to the later one.
class Playback {
public:
    /// `hashes` enables state_hash().
    Playback(AnyGame& game, Recorder& recorder, bool hashes);

    /// Steps to `tick`, which is not before the game's tick. Takes many steps per call unless they
    /// are recorded. Stops early if interrupted.
    void step_to(std::int64_t tick, Input& input);

    /// Returns the picture at `alpha` in [0, 1) between `tick` and the next. `tick` must not
    /// decrease.
    [[nodiscard]] Picture show(std::int64_t tick, double alpha, Input& input);

    /// State hash of the last shown tick; 0 without `hashes`.
    [[nodiscard]] std::uint64_t state_hash() const { return before_.state_hash; }

private:
    struct Moment {
        std::int64_t tick = -1;
        std::uint64_t state_hash = 0;
        Picture picture;
    };

    [[nodiscard]] Moment sample() const;

    AnyGame& game_;
    Recorder& recorder_;
    bool hashes_;
    Moment before_;
    Moment after_;
};

}  // namespace oiler
