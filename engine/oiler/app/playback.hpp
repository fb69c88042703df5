// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oiler/app/game.hpp"
#include "oiler/app/recorder.hpp"
#include "oiler/capture/frame_record.hpp"
#include "oiler/core/profile.hpp"

namespace oiler {

/// What a playback keeps for a capture, besides the picture.
enum class Keep {
    nothing,
    hashes,  ///< of each frame, and of each tick of a world with up to 1000 bodies
};

/// Steps a game to the times of its frames. A frame between two ticks interpolates both, so the
/// game is stepped to the later one.
class Playback {
public:
    Playback(AnyGame& game, Recorder& recorder, Keep keep, Profile* profile = nullptr);

    /// Steps to `tick`, which is not before the game's tick. Takes many steps per call unless they
    /// are recorded or hashed, but no more than a short time's, because it stops early if
    /// interrupted.
    void step_to(std::int64_t tick, Input& input);

    /// Returns the picture at `alpha` in [0, 1) between `tick` and the next. `tick` must not
    /// decrease.
    [[nodiscard]] Picture show(std::int64_t tick, double alpha, Input& input);

    [[nodiscard]] const World& world() const { return game_.world(); }
    /// State hash of the last shown tick; 0 if no hashes are kept.
    [[nodiscard]] std::uint64_t state_hash() const { return before_.state_hash; }
    /// The bodies at the last shown tick; none if no hashes are kept, or above 1000.
    [[nodiscard]] const std::vector<BodyState>& bodies() const { return before_.bodies; }
    /// The last four digits of the hash of each tick after `first` up to `last`; empty if one of
    /// them is not kept.
    [[nodiscard]] std::string tick_hashes(std::int64_t first, std::int64_t last) const;

private:
    struct Moment {
        std::int64_t tick = -1;
        std::uint64_t state_hash = 0;
        std::vector<BodyState> bodies{};
        Picture picture{};
    };

    [[nodiscard]] Moment sample() const;
    void step(std::int64_t count, Input& input);
    [[nodiscard]] bool hashes_ticks() const;

    AnyGame& game_;
    Recorder& recorder_;
    Keep keep_;
    Profile* profile_;
    std::int64_t steps_per_call_ = 1;
    std::string tick_hashes_;  ///< four digits for each tick from 1, or dots
    Moment before_;
    Moment after_;
};

}  // namespace oiler
