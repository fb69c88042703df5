// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "oiler/app/playback.hpp"

namespace oiler {

/// A setting that a game is to go on with, from the next step at which both rates have a tick.
class LiveChange {
public:
    void want(const Stepping& stepping) { wanted_ = stepping; }
    void forget() { wanted_.reset(); }
    [[nodiscard]] const std::optional<Stepping>& wanted() const { return wanted_; }

    /// Steps the game to the setting's first tick, but not beyond `step`. Returns whether the game
    /// has the setting from there on. Throws Error{usage} if it cannot have it, and forgets it.
    [[nodiscard]] bool make(Playback& playback, std::int64_t step, InputSource& inputs);

private:
    std::optional<Stepping> wanted_;
};

}  // namespace oiler
