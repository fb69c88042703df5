// SPDX-License-Identifier: MIT
#include "oiler/whatif/play_along.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "oiler/whatif/rate_advice.hpp"

namespace oiler {
namespace {

constexpr std::size_t most_errors = 600;

}  // namespace

bool has_player_input(const std::vector<Recording::Event>& events) {
    using What = InputEvent::What;
    return std::ranges::any_of(events, [](const Recording::Event& one) {
        const What what = one.event.what;
        const bool begins = what == What::restart && one.step == 0;
        return !begins && what != What::pointer && what != What::no_pointer && what != What::camera;
    });
}

void LiveFigures::begin_repeat() {
    repeats = true;
    played = 0;
    errors.clear();
    last.reset();
}

PlayAlong::PlayAlong(AlongFrom from, PlayAlong* before)
    : play_(std::move(from.play)), is_start_(from.is_start) {
    play_.recording.header.stepping = play_.settings.stepping;
    const bool is_repeated = from.may_repeat && before && before->is_start_;
    if (is_repeated && before->is_too_large_) {
        is_too_large_ = true;
        figures_ = before->figures_;
        return;
    }
    if (is_repeated) before->judge();
    const std::optional<WhatIf> last = is_repeated ? before->figures_.measured : std::nullopt;
    if (last && before->can_repeat()) {
        figures_ = before->figures_;
        figures_.begin_repeat();
    }
    try {
        const std::unique_ptr<AnyGame> game = from.make(play_.settings);
        begin(*game);
        is_too_large_ = game->world().body_count() > most_measured_bodies;
        if (is_too_large_)
            stop("");
        else
            runs_.emplace(play_, other_settings(from.make, last), from.make);
    } catch (const std::exception& error) {
        stop(error.what());
    }
}

bool PlayAlong::can_repeat() const {
    return is_start_ && runs_ && !has_player_input(play_.recording.events);
}

void PlayAlong::begin(const AnyGame& game) {
    const Energy energy = game.world().energy();
    figures_.begin = LiveFigures::Begin{game.world().time(), energy.total()};
    figures_.energy_scale.add(energy);
}

std::vector<Stepping> PlayAlong::other_settings(const MakeGame& make,
                                                const std::optional<WhatIf>& last) const {
    std::vector<Stepping> others = usual_what_if(play_.settings, make);
    if (!last) return others;
    for (const std::int64_t rate : rates_to_try(*last)) {
        Stepping tried = play_.settings.stepping;
        tried.rate = {rate};
        if (tried != play_.settings.stepping && std::ranges::count(others, tried) == 0)
            others.push_back(tried);
    }
    return others;
}

bool PlayAlong::go_on() {
    try {
        if (!runs_->play_part(figures_.played)) return false;
    } catch (const std::exception& error) {
        stop(error.what());
        return true;
    }
    ++figures_.played;
    figures_.energy_scale.add(runs_->recorded_game().world().energy());
    figures_.last = is_behind() ? nullptr : runs_->drawn();
    if (!runs_->certain() || runs_->recorded().other_play_from) return true;
    if (figures_.errors.size() >= most_errors) figures_.errors.erase(figures_.errors.begin());
    figures_.errors.push_back(static_cast<float>(runs_->recorded().distance_now));
    return true;
}

void PlayAlong::stop(std::string reason) {
    runs_.reset();
    figures_ = {
        .begin = figures_.begin, .verdict = {.text = std::move(reason)}, .has_stopped = true};
}

std::string PlayAlong::name_of(Entity body) {
    const AnyGame& game = runs_->recorded_game();
    if (game.world().has_body(body)) named_ = {body, game.name_of(body)};
    return named_.first == body ? named_.second : game.name_of(body);
}

void PlayAlong::judge() {
    if (is_judged()) return;
    judged_ = figures_.played;
    WhatIf measured = runs_->result();
    if (has_player_input(play_.recording.events)) figures_.repeats = false;
    if (figures_.repeats && measured.certain_until < figures_.measured->certain_until) return;
    figures_.repeats = false;
    figures_.verdict = judge_setting(measured, readings_, figures_.begin->time,
                                     [this](Entity body) { return name_of(body); });
    if (std::isnan(measured.runs.front().distance) &&
        runs_->recorded_game().world().body_count() == 0)
        figures_.verdict = {};
    readings_ = measured.runs.front().readings;
    figures_.measured = std::move(measured);
}

}  // namespace oiler
