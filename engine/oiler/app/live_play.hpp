// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oiler/app/game_clock.hpp"
#include "oiler/app/run_game.hpp"
#include "oiler/core/error.hpp"
#include "oiler/inspector/inspector.hpp"
#include "oiler/play/rewind.hpp"
#include "oiler/whatif/live_what_if.hpp"

namespace oiler {

/// A setting that a game is to go on with, from the next step at which both rates have a tick.
class PendingSetting {
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

/// The past of a game, and whether a frame shows a step of it.
class WayBack {
public:
    /// Without a way, no step is kept.
    WayBack(AnyGame& game, InputSource& inputs, bool has_way);

    /// The input of the game's steps.
    [[nodiscard]] InputSource& inputs() { return inputs_; }
    [[nodiscard]] bool has_way() const { return rewind_.has_value(); }
    [[nodiscard]] bool has_past() const { return rewind_ && rewind_->has_past(); }
    [[nodiscard]] std::int64_t first() const { return rewind_->first(); }
    [[nodiscard]] std::int64_t last() const { return rewind_->last(); }

    /// Copies the game, which has taken `step` steps, if it is time for that.
    void keep(std::int64_t step);
    /// Begins a frame that goes back or forward.
    void begin_frame(bool goes_back, bool is_paused);
    /// Puts the game, which has taken `step` steps and maybe diverged then, to the step `target`.
    /// Returns the input that its last step saw; empty if the game was there already.
    std::optional<Input> go_to(std::int64_t target, std::int64_t step, bool diverged);
    /// The game plays on from where it is: later steps are forgotten.
    void leave() { place_ = Place::present; }
    /// The game was replaced after `step` steps: all steps before are forgotten.
    void forget(std::int64_t step);

    /// Whether the game took later steps than the one it is at.
    [[nodiscard]] bool is_in_past() const { return place_ != Place::present; }
    /// Whether this frame goes back.
    [[nodiscard]] bool goes_back() const { return goes_back_; }
    /// Whether a whole step is shown: after going back, until the pause ends.
    [[nodiscard]] bool shows_whole_step() const { return shows_whole_step_; }

private:
    /// After a divergence, no step is the last one that was taken.
    enum class Place { present, past, before_divergence };

    std::optional<Rewind> rewind_;
    InputSource& inputs_;
    Place place_ = Place::present;
    bool goes_back_ = false;
    bool shows_whole_step_ = false;
};

/// A game that a player controls while it is played: its clock, the way back, changes of its
/// setting, restarts and the divergence that stops it. It has no window.
class LivePlay {
public:
    enum class State {
        playing,
        paused,
        going_back,          ///< in the past
        stopped,             ///< by a divergence
        waiting_for_change,  ///< until both rates have a step
    };

    /// The run must outlive it.
    explicit LivePlay(GameRun& run);

    /// Pauses or resumes, and changes the pace.
    void set_pace(const Requests& requests);
    /// Goes on with another setting, or makes the game anew with it.
    void change_to(const Stepping& stepping, bool from_start);
    /// Changes the setting, restarts the game or takes a single step, as is asked for. `restarts`:
    /// the player presses the game's own button for that.
    void control(const Requests& requests, bool restarts);
    /// Takes the steps that are due, forward or back. Returns the picture to show, which lasts
    /// until the next call; after a divergence, that of the last step before.
    [[nodiscard]] Picture& play(std::chrono::nanoseconds now);

    [[nodiscard]] State state() const;
    /// The state as a text for the player; empty while the game plays at its pace.
    [[nodiscard]] std::string status() const;
    [[nodiscard]] const std::optional<Error>& divergence() const { return divergence_; }
    /// Why the player cannot have what was asked for; empty: there is no reason.
    [[nodiscard]] const std::string& complaint() const { return complaint_; }
    void complain(std::string reason) { complaint_ = std::move(reason); }
    [[nodiscard]] GameClock& clock() { return clock_; }
    [[nodiscard]] bool has_way_back() const { return past_.has_way(); }
    [[nodiscard]] bool has_past() const { return past_.has_past(); }
    /// The steps that the player can go to.
    [[nodiscard]] std::optional<Inspected::Past> past() const;
    /// The time that the last steps and their picture took.
    [[nodiscard]] std::chrono::nanoseconds show_time() const { return show_time_; }
    /// How far the last picture is on the way to the game's last step.
    [[nodiscard]] double alpha() const;

    /// Null in a quiet run, which measures no cost of the timestep.
    [[nodiscard]] LiveWhatIf* what_if() { return what_if_ ? &*what_if_ : nullptr; }
    /// Why the verdict does not tell of the step that is shown; empty: it does.
    [[nodiscard]] std::string no_verdict() const;
    [[nodiscard]] Verdict verdict();
    /// The true places of the bodies in the last picture; empty if they are not known.
    [[nodiscard]] std::vector<Ghost> ghosts() const;

private:
    [[nodiscard]] Picture& next_picture();
    void restart();
    void restart_with(const Stepping& stepping);
    void change_until(std::int64_t step);
    void begin_setting();
    void go_back_to(std::int64_t step);
    void play_on_from_past();
    template <class F>
    bool is_possible(F f);

    GameRun& run_;
    Playback& playback_;
    GameClock clock_;
    std::optional<LiveWhatIf> what_if_;
    std::optional<InputTap> tap_;  ///< of what_if_
    WayBack past_;
    PendingSetting change_;
    std::optional<std::int64_t> seeked_;  ///< the step that the time line shows in this frame
    std::optional<Error> divergence_;     ///< it stops the game
    std::int64_t restarted_at_ = -1;      ///< the number of steps before the last restart
    std::string complaint_;
    std::chrono::nanoseconds show_time_{0};
};

}  // namespace oiler
