// SPDX-License-Identifier: MIT
#include "oiler/app/playback.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "oiler/app/obstacle_states.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t most_steps_per_call = 4096;
// Limits of a call between two polls of the interrupt, unless one step takes longer.
constexpr std::chrono::milliseconds shortest_call{5};
constexpr std::chrono::milliseconds longest_call{20};
constexpr std::size_t most_bodies_kept = 1000;
constexpr std::size_t tick_digits = 4;

std::vector<BodyState> states_of(const AnyGame& game) {
    const World& world = game.world();
    const Bodies& bodies = world.bodies();
    std::vector<BodyState> states;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        BodyState& state = states.emplace_back();
        state.name = game.name_of(world.entity_of_row(row));
        for (int axis = 0; axis < bodies.axes(); ++axis) {
            state.position[static_cast<std::size_t>(axis)] = bodies.position(row)[axis];
            state.velocity[static_cast<std::size_t>(axis)] = bodies.velocity(row)[axis];
        }
    }
    return states;
}

}  // namespace

Playback::Playback(AnyGame& game, TraceWriter& trace, Keep keep, Profile* profile)
    : game_(game), trace_(trace), keep_(keep), profile_(profile) {}

bool Playback::hashes_ticks() const {
    return keep_ == Keep::hashes && game_.world().body_count() <= most_bodies_kept;
}

void Playback::step_to(std::int64_t step, InputSource& inputs) {
    const Span span(profile_, "step");
    const World& world = game_.world();
    while (steps_ < step && !game_.loop().quits() && !Interrupt::requested()) {
        const bool single =
            trace_.active() || hashes_ticks() || watcher_ != nullptr || game_.takes_input();
        const std::int64_t most = single ? 1 : steps_per_call_;
        const std::int64_t before = steps_;
        take(std::min(step - steps_, most), inputs);
        if (steps_ == before) continue;  // the game has quit
        trace_.write(steps_, world);
        if (watcher_ != nullptr) watcher_->after(steps_ - 1, game_);
        if (keep_ != Keep::hashes) continue;
        if (hashes_ticks()) tick_hashes_ += hash_text(game_.state_hash()).substr(16 - tick_digits);
        tick_hashes_.resize(tick_digits * static_cast<std::size_t>(steps_), '.');
    }
}

/// Adapts the steps per call to the time that they take. Results do not depend on it.
void Playback::take(std::int64_t count, InputSource& inputs) {
    const Clock::time_point start = Clock::now();
    const std::int64_t tick = game_.world().tick();
    try {
        steps_ += game_.step(steps_, count, inputs);
    } catch (const Error&) {
        if (count > 1) steps_ += game_.world().tick() - tick;
        throw;
    }
    const Clock::duration spent = Clock::now() - start;
    if (spent > longest_call)
        steps_per_call_ = std::max<std::int64_t>(1, count / 2);
    else if (spent < shortest_call && count == steps_per_call_)
        steps_per_call_ = std::min(most_steps_per_call, 2 * count);
}

Picture& Playback::show(std::int64_t step, double alpha, InputSource& inputs) {
    assert(step >= before_.step);
    if (profile_) profile_->count("shown step", static_cast<double>(step) + alpha);
    if (after_.step == step) {
        before_ = std::move(after_);
        after_ = {};
    } else if (before_.step != step) {
        step_to(step, inputs);
        before_ = sample();
        after_ = {};
    }
    if (alpha > 0 && after_.step < 0) {
        step_to(step + 1, inputs);
        after_ = sample();
    }
    const Span span(profile_, "picture");
    if (alpha > 0 && before_.cuts == after_.cuts)
        between(before_.picture, after_.picture, static_cast<float>(alpha), shown_);
    else
        shown_ = before_.picture;
    return shown_;
}

void Playback::go_to(std::int64_t step) {
    assert(keep_ == Keep::nothing);
    steps_ = step;
    before_ = sample();
    after_ = {};
}

Playback::Sample Playback::sample() const {
    const Span span(profile_, "picture");
    Sample now{.step = steps_, .cuts = game_.cuts(), .picture = game_.picture()};
    if (keep_ == Keep::hashes) now.state_hash = game_.state_hash();
    if (hashes_ticks()) {
        now.bodies = states_of(game_);
        now.obstacles = obstacle_states_of(game_);
    }
    return now;
}

std::string Playback::tick_hashes(std::int64_t first, std::int64_t last) const {
    const std::string hashes = tick_hashes_.substr(
        std::min(tick_digits * static_cast<std::size_t>(first), tick_hashes_.size()),
        tick_digits * static_cast<std::size_t>(last - first));
    return hashes.find('.') == std::string::npos ? hashes : "";
}

}  // namespace oiler
