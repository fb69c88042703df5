// SPDX-License-Identifier: MIT
#include "oiler/app/live_change.hpp"

#include <utility>

namespace oiler {
namespace {

/// Whether a world can go on at another rate now, and half of that rate, which plays along, too.
bool has_common_tick(const World& world, const Rate& rate) {
    const std::optional<std::int64_t> tick = world.tick_at(rate);
    return tick && (*tick % 2 == 0 || rate.steps % 2 != 0);
}

}  // namespace

bool LiveChange::make(Playback& playback, std::int64_t step, InputSource& inputs) {
    while (wanted_ && !has_common_tick(playback.world(), wanted_->rate)) {
        const std::int64_t before = playback.steps();
        if (before >= step) return false;
        playback.step_to(before + 1, inputs);
        if (playback.steps() == before) return false;  // the game has quit
    }
    if (!wanted_) return false;
    playback.game().set_stepping(*std::exchange(wanted_, std::nullopt));
    return true;
}

}  // namespace oiler
