// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "oiler/game/loop.hpp"
#include "oiler/whatif/energy_scale.hpp"
#include "oiler/whatif/verdict.hpp"
#include "oiler/whatif/what_if_runs.hpp"

namespace oiler {

/// Measures the error of the timestep while a game is played. The reference and the usual other
/// settings play along with the player's input, in spare time. The game never sees them.
class LiveWhatIf {
public:
    /// of_frames: plays along in the spare time of frames; own: takes all the time it needs.
    enum class Pace { of_frames, own };

    /// `play` has the game's settings and controls. The inputs are added to its recording.
    LiveWhatIf(RecordedPlay play, const MakeGame& make, Pace pace = Pace::of_frames);
    LiveWhatIf(const LiveWhatIf&) = delete;
    LiveWhatIf& operator=(const LiveWhatIf&) = delete;

    /// Begins with a new game, before its step `first`.
    void start(std::int64_t first);
    /// Begins with a new game and another setting.
    void start(std::int64_t first, const Stepping& stepping);
    /// Begins again with a new game; the rate that the last result advises plays along, too. Unless
    /// there is input, the last result stays until as much is measured again.
    void repeat(std::int64_t first);
    /// Begins with the game as it is now, before its step `first`.
    void start_from(const AnyGame& game, std::int64_t first);
    /// Records the input of a step of the game, before that step is played along.
    void add(std::int64_t step, const Input& input);
    /// Plays along until that step of the game begins, or for a short time at the pace of frames.
    void play_until(std::int64_t step);
    /// Stops measuring. The verdict becomes `reason`.
    void stop(std::string reason);
    /// The number of steps until the game's step `step` that are still to be played.
    [[nodiscard]] std::int64_t behind(std::int64_t step) const {
        return step + 1 - first_ - played_;
    }
    /// The game when measuring began.
    struct Begin {
        double time = 0;    ///< s
        double energy = 0;  ///< J
    };
    /// Empty if no game could be made.
    [[nodiscard]] const std::optional<Begin>& begin() const { return begin_; }
    /// The scale of the energy's changes since then, J; in a repeated round, also of the last one;
    /// 0 after measuring has stopped.
    [[nodiscard]] double energy_scale() const { return energy_scale_.joules(); }
    /// The result so far. The measuring must not have stopped.
    [[nodiscard]] WhatIf result() const { return runs_->result(); }
    /// The result so far as a sentence, which is renewed ten times a second at the pace of frames.
    [[nodiscard]] const Verdict& verdict();
    /// Whether the result is still that of the last round, which this one repeats.
    [[nodiscard]] bool repeats() const { return repeats_; }
    /// The result that the last verdict judges; empty if there is none.
    [[nodiscard]] const std::optional<WhatIf>& measured() const { return measured_; }
    /// The bodies and their true positions, at `alpha` between the last two steps; empty if those
    /// are unknown or the game's step `step` is still to be played along.
    [[nodiscard]] std::vector<Ghost> ghosts(std::int64_t step, double alpha) const;
    /// The largest error of a body as it is drawn, in each of the last steps, m.
    [[nodiscard]] const std::vector<float>& errors() const { return errors_; }

private:
    using Clock = std::chrono::steady_clock;

    void measure(std::int64_t first, MakeGame make);
    void judge(WhatIf measured);
    [[nodiscard]] std::vector<Stepping> other_settings() const;

    const MakeGame& make_;
    Pace pace_;
    RecordedPlay play_;  ///< its recording grows
    MakeGame make_run_;  ///< makes the game as it was at the beginning
    std::optional<Begin> begin_;
    std::int64_t first_ = 0;
    Input before_{};
    std::optional<WhatIfRuns> runs_;  ///< empty: no run plays along
    std::int64_t played_ = 0;
    int slow_ = 0;              ///< the number of steps in a row that took too long
    Clock::time_point last_{};  ///< when it last played along
    bool repeats_ = false;
    bool began_at_start_ = false;
    std::int64_t judged_ = 0;  ///< the steps that the last verdict judges
    Clock::time_point next_verdict_{};
    std::vector<Reading> readings_;  ///< at the last verdict
    Verdict verdict_;
    std::optional<WhatIf> measured_;
    std::vector<float> errors_;
    EnergyScale energy_scale_;
};

/// Hands on the input of each step, and records it for the runs that play along.
class InputTap final : public InputSource {
public:
    InputTap(InputSource& inputs, LiveWhatIf& what_if) : inputs_(inputs), what_if_(what_if) {}

    [[nodiscard]] Input next(std::int64_t step) override {
        Input input = inputs_.next(step);
        what_if_.add(step, input);
        return input;
    }

private:
    InputSource& inputs_;
    LiveWhatIf& what_if_;
};

}  // namespace oiler
