// SPDX-License-Identifier: MIT
#include "oiler/whatif/live_what_if.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

using namespace std::chrono_literals;

constexpr auto time_of_frame = 1ms;
constexpr int part_of_slow_frame = 16;  // playing along may take 1/16 of a slow frame
constexpr auto time_of_verdict = 100ms;
constexpr std::int64_t longest_delay = 2;  // s
constexpr std::int64_t longest_delay_in_steps = 60;
constexpr std::size_t most_bodies = 2000;
constexpr int most_slow_steps = 8;  // in a row, each longer than the time of a frame
constexpr const char* too_slow =
    "what the timestep costs is not measured: playing along takes longer than 1 ms per frame";
constexpr std::size_t most_errors = 600;

/// Whether a player did more than move the mouse, after the restart that began the round.
bool has_input(const Recording& recording) {
    using What = InputEvent::What;
    return std::ranges::any_of(recording.events, [](const Recording::Event& one) {
        const What what = one.event.what;
        const bool begins = what == What::restart && one.step == 0;
        return !begins && what != What::pointer && what != What::no_pointer && what != What::camera;
    });
}

}  // namespace

LiveWhatIf::LiveWhatIf(RecordedPlay play, const MakeGame& make, Pace pace)
    : make_(make), pace_(pace), play_(std::move(play)) {
    start(0);
}

void LiveWhatIf::start(std::int64_t first, const Stepping& stepping) {
    play_.settings.stepping = stepping;
    start(first);
}

void LiveWhatIf::start(std::int64_t first) {
    repeats_ = false;
    began_at_start_ = true;
    measure(first, make_);
}

void LiveWhatIf::repeat(std::int64_t first) {
    const bool is_same = runs_ && began_at_start_ && !has_input(play_.recording);
    if (is_same && played_ != judged_) judge(runs_->result());
    repeats_ = is_same && measured_;
    began_at_start_ = true;
    measure(first, make_);
}

void LiveWhatIf::start_from(const AnyGame& game, std::int64_t first) {
    play_.settings.stepping = game.world().settings().stepping;
    repeats_ = began_at_start_ = false;
    measure(first, [now = std::shared_ptr<const AnyGame>(game.clone())](const Settings& settings) {
        std::unique_ptr<AnyGame> run = now->clone();
        run->set_stepping(settings.stepping);
        return run;
    });
}

void LiveWhatIf::measure(std::int64_t first, MakeGame make) {
    make_run_ = std::move(make);
    if (!repeats_) {
        measured_.reset();
        energy_scale_ = {};
    }
    errors_.clear();
    readings_.clear();
    first_ = first;
    played_ = judged_ = 0;
    slow_ = 0;
    last_ = Clock::now();
    before_ = {};
    play_.recording.header.stepping = play_.settings.stepping;
    play_.recording.events.clear();
    try {
        const std::unique_ptr<AnyGame> game = make_run_(play_.settings);
        const World& world = game->world();
        begin_ = Begin{world.time(), world.energy().total()};
        if (world.body_count() > most_bodies)
            return stop(fmt::format("what the timestep costs is not measured for {} bodies",
                                    world.body_count()));
        runs_.emplace(play_, other_settings(), make_run_);
    } catch (const Error& error) {
        stop(error.what());
    }
}

std::vector<Stepping> LiveWhatIf::other_settings() const {
    std::vector<Stepping> others = usual_what_if(play_.settings, make_run_);
    if (!repeats_) return others;
    for (const std::int64_t rate : rates_to_try(*measured_)) {
        Stepping tried = play_.settings.stepping;
        tried.rate = {rate};
        if (tried != play_.settings.stepping && std::ranges::count(others, tried) == 0)
            others.push_back(tried);
    }
    return others;
}

void LiveWhatIf::add(std::int64_t step, const Input& input) {
    if (runs_)
        for (const InputEvent& event : events_between(before_, input))
            play_.recording.events.push_back({step - first_, event});
    before_ = input;
}

void LiveWhatIf::play_until(std::int64_t step) {
    if (!runs_) return;
    const std::int64_t delay = longest_delay * play_.settings.stepping.rate.steps;
    const bool hurries = pace_ == Pace::of_frames;
    if (hurries && behind(step) > std::max(delay, longest_delay_in_steps)) return stop(too_slow);
    play_.recording.steps = step - first_;
    const Clock::time_point now = Clock::now();
    const auto time = std::max<Clock::duration>(time_of_frame, (now - last_) / part_of_slow_frame);
    last_ = now;
    const Clock::time_point end = now + time;
    try {
        while (behind(step) > 0 && (!hurries || Clock::now() < end)) {
            const Clock::time_point begin = Clock::now();
            runs_->play_until(played_++);
            energy_scale_.add(runs_->recorded_game().world().energy());
            slow_ = Clock::now() - begin > time ? slow_ + 1 : 0;
            if (!runs_->certain()) continue;
            if (errors_.size() >= most_errors) errors_.erase(errors_.begin());
            errors_.push_back(static_cast<float>(runs_->recorded().distance_now));
        }
    } catch (const Error& error) {
        stop(error.what());
    }
    if (hurries && slow_ >= most_slow_steps) stop(too_slow);
}

std::vector<Ghost> LiveWhatIf::ghosts(std::int64_t step, double alpha) const {
    if (!runs_ || behind(step) > 0) return {};
    const auto drawn = runs_->drawn(alpha);
    return drawn ? ghosts_of(drawn->run, drawn->truth) : std::vector<Ghost>{};
}

void LiveWhatIf::stop(std::string reason) {
    runs_.reset();
    measured_.reset();
    energy_scale_ = {};
    repeats_ = false;
    verdict_ = {.text = std::move(reason)};
}

void LiveWhatIf::judge(WhatIf measured) {
    judged_ = played_;
    if (has_input(play_.recording)) repeats_ = false;
    if (repeats_ && measured.certain_until < measured_->certain_until) return;
    repeats_ = false;
    measured_ = std::move(measured);
    const AnyGame& game = runs_->recorded_game();
    verdict_ = judge_setting(*measured_, readings_, begin_->time,
                             [&](Entity body) { return game.name_of(body); });
    if (std::isnan(measured_->runs.front().distance) && game.world().body_count() == 0)
        verdict_ = {.text = "no bodies, and so no errors to measure"};
    readings_ = measured_->runs.front().readings;
}

const Verdict& LiveWhatIf::verdict() {
    const bool is_due = pace_ == Pace::own || Clock::now() >= next_verdict_;
    if (runs_ && played_ != judged_ && is_due) {
        judge(runs_->result());
        next_verdict_ = Clock::now() + time_of_verdict;
    }
    return verdict_;
}

}  // namespace oiler
