// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "oiler/game/loop.hpp"
#include "oiler/physics/rate.hpp"
#include "oiler/play/recording.hpp"

namespace oiler {

/// Samples the game after each step.
class StepWatcher {
public:
    virtual ~StepWatcher() = default;
    /// `step` is the number of the step that was taken, from 0.
    virtual void after(std::int64_t step, const AnyGame& game) = 0;
};

/// Records the input of another source, and the states of the game.
class InputRecorder final : public InputSource, public StepWatcher {
public:
    InputRecorder(InputSource& inputs, const std::filesystem::path& path,
                  const RecordingHeader& header)
        : inputs_(inputs), writer_(path, header) {}

    [[nodiscard]] Input next(std::int64_t step) override {
        Input input = inputs_.next(step);
        writer_.add(step, input);
        return input;
    }
    void after(std::int64_t step, const AnyGame& game) override { writer_.add_state(step, game); }
    void finish(std::int64_t steps, const AnyGame& game, bool diverged = false) {
        writer_.finish(steps, game, diverged);
    }

private:
    InputSource& inputs_;
    RecordingWriter writer_;
};

/// Plays a recording, and compares the game with it after each step.
class Replay final : public InputSource, public StepWatcher {
public:
    /// With `plays_on`, a difference is kept and does not throw.
    Replay(const Recording& recording, std::string name, ChosenControls controls = {},
           bool plays_on = false)
        : recording_(recording),
          name_(std::move(name)),
          player_(std::move(controls)),
          plays_on_(plays_on) {}

    [[nodiscard]] Input next(std::int64_t step) override;
    /// Throws Error{comparison_failed} with the first step that differs, and the part.
    void after(std::int64_t step, const AnyGame& game) override;
    /// Throws Error{comparison_failed} if a game quits after `steps` steps, but later in the
    /// recording, or continues although it quit there.
    void compare_end(std::int64_t steps, bool quits);
    /// The first difference; empty if there is none.
    [[nodiscard]] const std::string& difference() const { return difference_; }
    [[nodiscard]] std::int64_t steps() const { return recording_.steps; }
    [[nodiscard]] bool quits() const { return recording_.quits; }
    /// The number of steps whose states were compared: of many bodies, one per second.
    [[nodiscard]] std::int64_t compared() const { return compared_; }
    [[nodiscard]] bool complete() const { return recording_.complete; }

private:
    void differ(std::string how);

    const Recording& recording_;
    std::string name_;
    EventPlayer player_;
    bool plays_on_;
    std::string difference_;
    std::size_t played_ = 0;
    std::int64_t equal_until_ = -1;
    std::int64_t compared_ = 0;
};

/// Steps of two rates that start at the same time, matched in integers.
class StepRatio {
public:
    StepRatio(Rate from, Rate to);

    /// Whether the step begins at or after step `from` of the other rate.
    [[nodiscard]] bool reaches(std::int64_t to, std::int64_t from) const {
        return to * denominator_ >= from * numerator_;
    }
    /// The last step that begins until the time at which `from` begins.
    [[nodiscard]] std::int64_t last_until(std::int64_t from) const {
        return from * numerator_ / denominator_;
    }
    /// The time from the beginning of step `to` to that of step `from`, in steps of the former.
    [[nodiscard]] double since(std::int64_t to, std::int64_t from) const {
        return static_cast<double>(from * numerator_ - to * denominator_) /
               static_cast<double>(denominator_);
    }
    /// The same from a step with a fraction.
    [[nodiscard]] double since(std::int64_t to, double from) const {
        return from * static_cast<double>(numerator_) / static_cast<double>(denominator_) -
               static_cast<double>(to);
    }
    /// The step of the other rate, with a fraction, that begins at the same time as `to`.
    [[nodiscard]] double other_step(double to) const {
        return to * static_cast<double>(denominator_) / static_cast<double>(numerator_);
    }
    /// Whether a step begins at the same time as `from`.
    [[nodiscard]] bool has(std::int64_t from) const {
        return from * numerator_ % denominator_ == 0;
    }

private:
    std::int64_t numerator_;
    std::int64_t denominator_;
};

/// Plays the input of a recording at another rate. An event of a recorded step goes to the first
/// step that begins no earlier, so that no press is lost: presses of several recorded steps in one
/// step add up. A button that goes down and up within one step is seen released by the next one, as
/// in live play.
class ResampledInput final : public InputSource {
public:
    ResampledInput(const Recording& recording, Rate rate, ChosenControls controls = {})
        : recording_(recording),
          ratio_(recording.header.stepping.rate, rate),
          player_(std::move(controls)) {}

    [[nodiscard]] Input next(std::int64_t step) override;

private:
    const Recording& recording_;
    StepRatio ratio_;
    EventPlayer player_;
    std::size_t played_ = 0;
};

}  // namespace oiler
