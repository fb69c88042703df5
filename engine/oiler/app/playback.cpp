// SPDX-License-Identifier: MIT
#include "oiler/app/playback.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "oiler/app/interrupt.hpp"

namespace oiler {
namespace {

constexpr std::int64_t steps_between_interrupts = 4096;

}  // namespace

Playback::Playback(AnyGame& game, Recorder& recorder, bool hashes)
    : game_(game), recorder_(recorder), hashes_(hashes) {}

void Playback::step_to(std::int64_t tick, Input& input) {
    const World& world = game_.world();
    while (world.tick() < tick && !Interrupt::requested()) {
        const std::int64_t most = recorder_.active() ? 1 : steps_between_interrupts;
        game_.step(std::min(tick - world.tick(), most), input);
        recorder_.record(world);
    }
}

Picture Playback::show(std::int64_t tick, double alpha, Input& input) {
    assert(tick >= before_.tick);
    if (after_.tick == tick) {
        before_ = std::move(after_);
        after_ = {};
    } else if (before_.tick != tick) {
        step_to(tick, input);
        before_ = sample();
        after_ = {};
    }
    if (alpha > 0 && after_.tick < 0) {
        step_to(tick + 1, input);
        after_ = sample();
    }
    return alpha > 0 ? between(before_.picture, after_.picture, static_cast<float>(alpha))
                     : before_.picture;
}

Playback::Moment Playback::sample() const {
    const World& world = game_.world();
    return {world.tick(), hashes_ ? world.state_hash() : 0, game_.picture()};
}

}  // namespace oiler
