// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "oiler/game/loop.hpp"
#include "oiler/whatif/aside.hpp"

namespace oiler {

/// Measures the error of the timestep while a game is played. The reference and the usual other
/// settings play along with the player's input. The game never sees them.
class LiveWhatIf {
public:
    /// aside: on a thread of its own, for which a frame waits 0.3 ms at most; frame: in a share of
    /// each frame, as if the machine gave no thread; own: with all the time that it needs.
    enum class Pace { aside, frame, own };

    /// Measures nothing before a start. `play` has the game's settings and controls. `make` is
    /// called by the other thread, too.
    LiveWhatIf(RecordedPlay play, const MakeGame& make, Pace pace = Pace::aside);
    LiveWhatIf(const LiveWhatIf&) = delete;
    LiveWhatIf& operator=(const LiveWhatIf&) = delete;

    /// Begins with a new game, before its step `first`.
    void start(std::int64_t first);
    /// The setting of the next new game.
    void set_stepping(const Stepping& stepping) { play_.settings.stepping = stepping; }
    /// Begins again with a new game; the rate that the last result advises plays along, too. Unless
    /// there is input, the last result stays until as much is measured again.
    void repeat(std::int64_t first);
    /// Begins with the game as it is now, before its step `first`.
    void start_from(const AnyGame& game, std::int64_t first);
    /// Records the input of a step of the game, before that step is played along.
    void add(std::int64_t step, const Input& input);
    /// Plays along until that step of the game begins, or as far as the time of a frame allows.
    void play_until(std::int64_t step);
    /// Stops measuring. The verdict becomes `reason`.
    void stop(std::string reason);
    /// The number of steps until the game's step `step` that are still to be played.
    [[nodiscard]] std::int64_t behind(std::int64_t step) const {
        return step + 1 - first_ - figures_.played;
    }
    /// What was known at the last call of play_until.
    [[nodiscard]] const LiveFigures& figures() const { return figures_; }
    /// The bodies and their true positions, at `alpha` between the last two steps; empty if those
    /// are unknown or the game's step `step` is still to be played along.
    [[nodiscard]] std::vector<Ghost> ghosts(std::int64_t step, double alpha) const;

private:
    void measure(std::int64_t first, AlongFrom from);
    [[nodiscard]] AlongFrom start_of_game() const;

    const MakeGame& make_;
    RecordedPlay play_;  ///< without events
    bool is_measuring_ = false;
    std::int64_t first_ = 0;
    Input before_{};
    LiveFigures figures_;
    std::unique_ptr<PlayAlong> own_;
    std::unique_ptr<Aside> aside_;  ///< null at its own pace
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
