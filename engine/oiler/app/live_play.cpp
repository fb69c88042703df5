// SPDX-License-Identifier: MIT
#include "oiler/app/live_play.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "oiler/core/step_clock.hpp"

namespace oiler {
namespace {

/// The remedy where a game cannot be measured from its state on.
constexpr std::string_view measures_on_restart = "F9 measures again.";

std::chrono::nanoseconds now() { return std::chrono::steady_clock::now().time_since_epoch(); }

/// Whether the rate and half of it, which plays along, both have a tick at the world's time.
bool has_common_tick(const World& world, const Rate& rate) {
    const std::optional<std::int64_t> tick = world.tick_at(rate);
    return tick && (*tick % 2 == 0 || rate.steps % 2 != 0);
}

}  // namespace

bool PendingSetting::make(Playback& playback, std::int64_t step, InputSource& inputs) {
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

WayBack::WayBack(AnyGame& game, InputSource& inputs, bool has_way)
    : rewind_(has_way ? std::optional<Rewind>(std::in_place, game, inputs) : std::nullopt),
      inputs_(rewind_ ? static_cast<InputSource&>(*rewind_) : inputs) {}

void WayBack::keep(std::int64_t step) {
    if (rewind_) rewind_->keep(step);
}

void WayBack::begin_frame(bool goes_back, bool is_paused) {
    goes_back_ = goes_back;
    shows_whole_step_ = goes_back || (shows_whole_step_ && is_paused);
}

std::optional<Input> WayBack::go_to(std::int64_t target, std::int64_t step, bool diverged) {
    if (diverged)
        place_ = Place::before_divergence;
    else if (place_ != Place::before_divergence)
        place_ = target < last() ? Place::past : Place::present;
    if (target == step && !diverged) return std::nullopt;
    return rewind_->go_to(target);
}

void WayBack::forget(std::int64_t step) {
    leave();
    if (rewind_) rewind_->forget(step);
}

LivePlay::LivePlay(GameRun& run)
    : run_(run),
      playback_(run.playback),
      clock_(run.options.settings.stepping.rate),
      past_(
          playback_.game(),
          [&]() -> InputSource& {
              if (run.options.quiet && !run.options.inspector) return run.inputs;
              what_if_.emplace(RecordedPlay{run.options.settings, run.options.controls}, run.make);
              return tap_.emplace(run.inputs, *what_if_);
          }(),
          no_way_back(run.options).empty()) {
    playback_.game().measure(run_.times);
}

void LivePlay::set_pace(const Requests& requests) {
    if (requests.pauses && !divergence_) clock_.toggle_pause();
    Pace pace = clock_.pace();
    for (int i = 0; i < requests.slower; ++i) pace.slower();
    for (int i = 0; i < requests.faster; ++i) pace.faster();
    clock_.set_pace(pace);
}

void LivePlay::control(const Requests& requests, bool restarts) {
    if (const auto wanted = playback_.game().take_wanted_rate()) change_rate(*wanted);
    if (requests.stepping) change_to(*requests.stepping, requests.changes_from_start);
    if (requests.threads) is_possible([&] { playback_.game().set_threads(*requests.threads); });
    // A game that takes no steps sees no keys.
    const bool takes_no_steps = divergence_ || clock_.is_paused();
    if (requests.restarts || (takes_no_steps && restarts)) {
        clock_.resume();
        complaint_.clear();
        restart();
    } else if (playback_.game().is_over() && playback_.steps() != restarted_at_ &&
               !past_.is_in_past()) {
        restart();
    }
    seeked_ = has_past() ? requests.step : std::nullopt;
    const bool goes_back =
        has_past() && (clock_.is_paused() ? requests.goes_back : requests.rewinds);
    const bool steps = !divergence_ && requests.steps;
    if (clock_.is_paused() && (steps || goes_back)) clock_.single_step();
    past_.begin_frame(goes_back || seeked_, clock_.is_paused());
}

void LivePlay::change_to(const Stepping& stepping, bool from_start) {
    // Bodies have the precision that they were made with.
    const bool needs_start = divergence_ || !run_.about.changes_in_play ||
                             stepping.precision != playback_.world().settings().stepping.precision;
    change_.forget();
    complaint_.clear();
    if (from_start || needs_start)
        restart_with(stepping);
    else
        change_.want(stepping);
}

/// Makes the game anew at the rate that it asks for, unless the setting is fixed.
void LivePlay::change_rate(std::int64_t hertz) {
    const std::string fixed = why_fixed(run_.options, run_.about);
    if (!fixed.empty()) return complain(fixed);
    if (hertz < 1 || hertz > StepClock::largest_rate)
        return complain(fmt::format("the game asks for {} Hz; a rate is from 1 to {} Hz", hertz,
                                    StepClock::largest_rate));
    Stepping stepping = playback_.world().settings().stepping;
    if (stepping.rate == Rate{hertz}) return;
    stepping.rate = {hertz};
    change_to(stepping, true);
}

/// Whether the game can have a setting, which f() gives it. Else the player is told why.
template <class F>
bool LivePlay::is_possible(F f) {
    try {
        f();
        return true;
    } catch (const Error& error) {
        if (error.exit() != Exit::usage) throw;
        complain(error.what());
        return false;
    }
}

/// Makes the game anew with another setting. Its state is lost.
void LivePlay::restart_with(const Stepping& stepping) {
    Settings settings = playback_.world().settings();
    settings.stepping = stepping;
    if (!is_possible([&] {
            const std::unique_ptr<AnyGame> fresh = run_.make(settings);
            fresh->world().require_applicable();
            playback_.game().assign(*fresh);
        }))
        return;
    begin_setting();
    if (measures_) what_if_->start(playback_.steps());
}

/// Changes to the wanted setting if that has a tick until `step`.
void LivePlay::change_until(std::int64_t step) {
    bool has_changed = false;
    if (!is_possible([&] { has_changed = change_.make(playback_, step, past_.inputs()); })) return;
    if (!has_changed) return;
    begin_setting();
    if (measures_) what_if_->start_from(playback_.game(), playback_.steps());
}

/// Restarts the clock at the game's rate and forgets all earlier steps.
void LivePlay::begin_setting() {
    const std::int64_t step = playback_.steps();
    verdict_before_.clear();
    const Stepping& stepping = playback_.world().settings().stepping;
    if (what_if_) what_if_->set_stepping(stepping);
    clock_.begin(stepping.rate, step, !divergence_);
    playback_.go_to(step);
    divergence_.reset();
    past_.forget(step);
}

void LivePlay::restart() {
    restarted_at_ = playback_.steps();
    verdict_before_.clear();
    if (measures_) what_if_->repeat(restarted_at_);
    divergence_.reset();
    past_.leave();
    if (playback_.game().takes_input()) return run_.live.queue.restart();
    playback_.game().restart();
    past_.forget(restarted_at_);
}

void LivePlay::measure() {
    if (!what_if_ || !has_shown_ || !run_.about.fixed_setting.empty()) return;
    if (std::exchange(measures_, true)) return;
    if (playback_.steps() == 0)
        what_if_->start(0);
    else
        measure_from_here();
}

void LivePlay::measure_from_here() {
    if (run_.about.changes_in_play)
        what_if_->start_from(playback_.game(), playback_.steps());
    else
        what_if_->stop(with_verdict_before(measures_on_restart));
}

Picture& LivePlay::play(std::chrono::nanoseconds time) {
    has_shown_ = true;
    const bool goes_back = past_.goes_back();
    run_.live.queue.set_paused(clock_.is_paused() || goes_back);
    const std::int64_t due = clock_.advance(time);
    if (!divergence_) past_.keep(playback_.steps());
    if (seeked_)
        go_back_to(*seeked_);
    else if (goes_back && due > 0)
        go_back_to(playback_.steps() - due);
    if (!goes_back && due > 0 && past_.is_in_past()) play_on_from_past();
    run_.times = {};
    const std::chrono::nanoseconds before = now();
    Picture& picture = next_picture();
    show_time_ = now() - before;
    if (due > 0)
        clock_.limit_steps(due, std::chrono::nanoseconds(run_.times.update + run_.times.step));
    const Span span(run_.profile, "play along");
    if (measures_) what_if_->play_until(past_.is_in_past() ? past_.last() : playback_.steps());
    return picture;
}

Picture& LivePlay::next_picture() {
    try {
        if (!past_.goes_back() && !divergence_) change_until(clock_.step());
        if (!divergence_)
            return playback_.show(clock_.step(), past_.shows_whole_step() ? 0 : clock_.alpha(),
                                  past_.inputs());
    } catch (const Error& error) {
        if (error.exit() != Exit::diverged) throw;
        divergence_ = error;
        clock_.pause();
    }
    return playback_.show_last();
}

/// Shows a step of the past, or the last one again. The runs that play along wait until the game
/// takes another step.
void LivePlay::go_back_to(std::int64_t step) {
    step = std::clamp(step, past_.first(), past_.last());
    if (what_if_ && !past_.is_in_past()) keep_verdict(what_if_->figures());
    const std::optional<Input> last = past_.go_to(step, playback_.steps(), divergence_.has_value());
    if (last) {
        run_.live.queue.continue_after(*last);
        playback_.go_to(step);
    }
    divergence_.reset();
    clock_.set_step(step);
}

void LivePlay::play_on_from_past() {
    past_.leave();
    if (measures_) measure_from_here();
}

void LivePlay::keep_verdict(const LiveFigures& figures) {
    if (figures.measured && figures.measured->certain_until > 0)
        verdict_before_ = figures.verdict.text;
}

std::string LivePlay::with_verdict_before(std::string_view remedy) const {
    return verdict_before_.empty()
               ? fmt::format("What the timestep costs is not known here. {}", remedy)
               : fmt::format("Before you went back: {} {}", verdict_before_, remedy);
}

LivePlay::State LivePlay::state() const {
    if (divergence_) return State::stopped;
    if (change_.wanted()) return State::waiting_for_change;
    if (clock_.is_paused()) return State::paused;
    return past_.goes_back() ? State::going_back : State::playing;
}

std::string LivePlay::status() const {
    switch (state()) {
        case State::stopped:
            return "stopped";
        case State::waiting_for_change:
            return fmt::format("{} Hz begins when both rates have a step",
                               change_.wanted()->rate.steps);
        case State::paused:
            return fmt::format("paused: F3 resumes, {}F5 steps",
                               has_past() ? "F4 steps back, " : "");
        case State::going_back:
            return fmt::format("back at {:.2f} s{}", playback_.world().time(),
                               playback_.steps() == past_.first() ? ", no further" : "");
        case State::playing:
            break;
    }
    return run_.options.quiet ? "" : clock_.kept_pace().text();
}

std::optional<Inspected::Past> LivePlay::past() const {
    if (!has_past()) return std::nullopt;
    return Inspected::Past{past_.first(), playback_.steps(),
                           std::max(past_.last(), playback_.steps())};
}

double LivePlay::alpha() const {
    // A frame at the time of a step shows that step; other frames interpolate.
    return playback_.steps() == clock_.step() ? 1 : clock_.alpha();
}

std::string LivePlay::no_verdict() const {
    if (!what_if_) return "what the timestep costs is not measured with --quiet";
    if (!past_.is_in_past()) return {};
    return with_verdict_before(run_.about.changes_in_play ? "Playing on measures again."
                                                          : measures_on_restart);
}

Verdict LivePlay::verdict() const {
    const std::string reason = no_verdict();
    return reason.empty() ? what_if_->figures().verdict : Verdict{.text = reason};
}

std::vector<Ghost> LivePlay::ghosts() const {
    if (!measures_ || past_.is_in_past()) return {};
    return what_if_->ghosts(playback_.steps(), alpha());
}

}  // namespace oiler
