// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/app/game_clock.hpp"
#include "oiler/app/run_game.hpp"
#include "oiler/core/error.hpp"
#include "oiler/inspector/inspector.hpp"
#include "oiler/play/rewind.hpp"
#include "oiler/whatif/live_what_if.hpp"

namespace oiler {

/// A requested setting. It takes effect at the next step at which both rates have a tick.
class PendingSetting {
public:
    void want(const Stepping& stepping) { wanted_ = stepping; }
    void forget() { wanted_.reset(); }
    [[nodiscard]] const std::optional<Stepping>& wanted() const { return wanted_; }

    /// Steps the game to the setting's first tick, but not beyond `step`. Returns whether the
    /// setting took effect. If the game cannot have it, drops it and throws Error{usage}.
    [[nodiscard]] bool make(Playback& playback, std::int64_t step, InputSource& inputs);

private:
    std::optional<Stepping> wanted_;
};

/// The past of a game, and whether a frame shows a step of it.
class WayBack {
public:
    /// Without `has_way`, no step is kept.
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
    /// Moves the game from `step`, where it may have diverged, to `target`. Returns the input that
    /// its last step saw; empty if the game was there already.
    std::optional<Input> go_to(std::int64_t target, std::int64_t step, bool diverged);
    /// Plays on from the current step: later steps are forgotten.
    void leave() { place_ = Place::present; }
    /// Forgets all steps before `step`, after which the game was replaced.
    void forget(std::int64_t step);

    /// Whether the game is at an earlier step than its last.
    [[nodiscard]] bool is_in_past() const { return place_ != Place::present; }
    /// Whether this frame goes back.
    [[nodiscard]] bool goes_back() const { return goes_back_; }
    /// Whether a whole step is shown: after going back, until the pause ends.
    [[nodiscard]] bool shows_whole_step() const { return shows_whole_step_; }

private:
    /// `before_divergence` lasts even at the last step, because the step after it diverged.
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
        waiting_for_change,  ///< until both rates have a tick
    };

    /// The run must outlive it.
    explicit LivePlay(GameRun& run);

    /// From now on, the errors of the timestep are measured, because the user sees them; not before
    /// the second frame, because the copies that play along would delay the first one.
    void measure();
    /// Pauses or resumes, and changes the pace.
    void set_pace(const Requests& requests);
    /// Goes on with another setting, or makes the game anew with it.
    void change_to(const Stepping& stepping, bool from_start);
    /// Changes the setting, restarts the game or takes a single step, as requested. `restarts`: the
    /// player presses the game's restart button.
    void control(const Requests& requests, bool restarts);
    /// Takes the steps that are due, forward or back. Returns the picture to show, which lasts
    /// until the next call; after a divergence, that of the last step before.
    [[nodiscard]] Picture& play(std::chrono::nanoseconds now);

    [[nodiscard]] State state() const;
    /// The setting of the game, or the one that it is about to have.
    [[nodiscard]] const Stepping& next_stepping() const {
        return change_.wanted() ? *change_.wanted() : playback_.world().settings().stepping;
    }
    /// The state as a text for the player; empty while the game plays at its pace.
    [[nodiscard]] std::string status() const;
    [[nodiscard]] const std::optional<Error>& divergence() const { return divergence_; }
    /// Why the last request was refused; empty: it was not.
    [[nodiscard]] const std::string& complaint() const { return complaint_; }
    void complain(std::string reason) { complaint_ = std::move(reason); }
    [[nodiscard]] GameClock& clock() { return clock_; }
    [[nodiscard]] bool has_way_back() const { return past_.has_way(); }
    [[nodiscard]] bool has_past() const { return past_.has_past(); }
    /// The steps that the player can go to.
    [[nodiscard]] std::optional<Inspected::Past> past() const;
    /// The time that the last steps and their picture took.
    [[nodiscard]] std::chrono::nanoseconds show_time() const { return show_time_; }
    /// The position of the last picture within the game's last step, 0 to 1.
    [[nodiscard]] double alpha() const;

    /// Null in a quiet run, which measures no errors of the timestep.
    [[nodiscard]] const LiveFigures* figures() const {
        return what_if_ ? &what_if_->figures() : nullptr;
    }
    /// Why there is no verdict on the shown step; empty: there is one.
    [[nodiscard]] std::string no_verdict() const;
    [[nodiscard]] Verdict verdict() const;
    /// The true positions of the bodies in the last picture; empty if unknown.
    [[nodiscard]] std::vector<Ghost> ghosts() const;

private:
    [[nodiscard]] Picture& next_picture();
    void measure_from_here();
    void change_rate(std::int64_t hertz);
    void restart();
    void restart_with(const Stepping& stepping);
    void change_until(std::int64_t step);
    void begin_setting();
    void go_back_to(std::int64_t step);
    void play_on_from_past();
    void keep_verdict(const LiveFigures& figures);
    /// The last verdict before the player went back, and how to get a new one.
    [[nodiscard]] std::string with_verdict_before(std::string_view remedy) const;
    template <class F>
    bool is_possible(F f);

    GameRun& run_;
    Playback& playback_;
    GameClock clock_;
    std::optional<LiveWhatIf> what_if_;
    std::optional<InputTap> tap_;  ///< of what_if_
    bool has_shown_ = false;       ///< a frame
    bool measures_ = false;        ///< with what_if_
    WayBack past_;
    PendingSetting change_;
    std::optional<std::int64_t> seeked_;  ///< the step that the time line shows in this frame
    std::optional<Error> divergence_;     ///< it stops the game
    std::int64_t restarted_at_ = -1;      ///< the number of steps before the last restart
    std::string complaint_;
    std::string verdict_before_;  ///< the last one of this play before it went back; empty: none
    std::chrono::nanoseconds show_time_{0};
};

}  // namespace oiler
