// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include "oiler/core/step_clock.hpp"
#include "oiler/physics/stepping.hpp"

namespace oiler {

/// Factor of simulated time over real time: a power of two from 1/16 to 16.
class Pace {
public:
    void slower() { exponent_ = std::max(exponent_ - 1, -4); }
    void faster() { exponent_ = std::min(exponent_ + 1, 4); }
    [[nodiscard]] int numerator() const { return 1 << std::max(exponent_, 0); }
    [[nodiscard]] int denominator() const { return 1 << std::max(-exponent_, 0); }
    [[nodiscard]] std::string text() const;

private:
    int exponent_ = 0;
};

/// The pace that this computer keeps in a window, as means over about 16 frames.
class KeptPace {
public:
    /// Adds a frame that took `work`, came `period` after the one before, and dropped `late` of
    /// simulated time because it was late.
    void add(std::chrono::duration<double> work, std::chrono::duration<double> period,
             std::chrono::duration<double> late);
    /// A warning with a remedy if the pace or the frame rate is too low; else empty.
    [[nodiscard]] std::string text() const;

private:
    double work_ = 0;  ///< s
    double late_ = 0;  ///< share of the period
};

/// The clock of a game in a window: the steps due at the player's pace, and how many of them a late
/// frame catches up. It counts steps as the game does, also after going back.
class GameClock {
public:
    explicit GameClock(const Rate& rate) : clock_(static_cast<int>(rate.steps)) {}

    /// Restarts with another rate after the game's step `step`. `keeps_pause`: a pause continues.
    void begin(const Rate& rate, std::int64_t step, bool keeps_pause);
    /// Moves the clock to the game's step `step`, after going back or forward.
    void set_step(std::int64_t step) { first_ = step - clock_.ticks(); }
    /// The step of the game that is due, and the fraction of the next one.
    [[nodiscard]] std::int64_t step() const { return first_ + clock_.ticks(); }
    [[nodiscard]] double alpha() const { return clock_.alpha(); }

    /// Begins a frame. Returns the number of steps that became due since the last one.
    std::int64_t advance(std::chrono::nanoseconds now);
    /// Limits the steps of the next frames, given that `steps` took `time`. Without the limit,
    /// steps slower than real time would hold a frame for seconds.
    void limit_steps(std::int64_t steps, std::chrono::nanoseconds time);
    /// Adds a frame that took `work` and came `period` after the one before to the kept pace.
    void end_frame(std::chrono::nanoseconds work, std::chrono::nanoseconds period);

    [[nodiscard]] bool is_paused() const { return clock_.paused(); }
    void pause() { clock_.pause(); }
    void resume() { clock_.resume(); }
    void toggle_pause() { is_paused() ? resume() : pause(); }
    /// Makes one step due in the next frame of a pause.
    void single_step() { clock_.single_step(); }

    void set_pace(const Pace& pace) { pace_ = pace; }
    [[nodiscard]] const Pace& pace() const { return pace_; }
    [[nodiscard]] const KeptPace& kept_pace() const { return kept_pace_; }
    /// Simulated time that late frames dropped, with all rates so far.
    [[nodiscard]] std::chrono::nanoseconds dropped_time() const {
        return dropped_ + clock_.dropped_time();
    }

private:
    [[nodiscard]] double duration_of_step() const;
    void catch_up_at_most(double seconds);

    StepClock clock_;
    Pace pace_;
    KeptPace kept_pace_;
    std::int64_t first_ = 0;               ///< the game's step at the clock's tick 0
    bool has_timed_steps_ = false;         ///< since the rate began
    std::chrono::nanoseconds late_{0};     ///< dropped by the last frame
    std::chrono::nanoseconds dropped_{0};  ///< with earlier rates
};

}  // namespace oiler
