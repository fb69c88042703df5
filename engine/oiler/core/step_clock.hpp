// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace oiler {

/// Computes how many whole steps a frame owes and the fraction of the next step. It counts in
/// integers because every floating-point clock miscounts: 0.25 s at dt = 0.01 s makes 24 steps when
/// summed in double, and a float clock at 60 Hz stops after six days. It is a value and receives
/// the time as an argument: tests need no sleeping, and a copy is a snapshot.
class StepClock {
public:
    static constexpr int largest_rate = 1'000'000;
    static constexpr std::chrono::nanoseconds longest_frame_limit = std::chrono::seconds(1);
    static constexpr int largest_scale = 1000;

    struct Frame {
        std::int64_t steps = 0;
        /// Real time cut from a late frame; no step catches it up.
        std::chrono::nanoseconds dropped{0};
        /// The backward jump of the stamps; such a frame owes no steps.
        std::chrono::nanoseconds backward{0};
    };

    /// The exact fraction of the next step: parts/whole, with parts < whole.
    struct Remainder {
        std::int64_t parts = 0;
        std::int64_t whole = 1;
        friend bool operator==(const Remainder&, const Remainder&) = default;
    };

    /// `rate` is in steps per second, 1 to largest_rate. A frame catches up at most `longest_frame`
    /// (more than 0, up to longest_frame_limit). Without this limit, steps that take longer than
    /// the time they simulate would make every frame later than the one before.
    explicit StepClock(int rate,
                       std::chrono::nanoseconds longest_frame = std::chrono::milliseconds(250));

    /// `now` is an absolute stamp of a monotonic clock; the first call starts the clock. Stamps are
    /// absolute because durations, each rounded, lose one step per hour at 144 Hz.
    Frame advance(std::chrono::nanoseconds now);

    /// The fraction of the next step that has passed, in [0, 1); for display only.
    [[nodiscard]] double alpha() const;
    [[nodiscard]] Remainder remainder() const;
    /// The number of steps handed out so far.
    [[nodiscard]] std::int64_t ticks() const { return ticks_; }
    /// The real time cut from late frames; pauses and backward jumps do not count.
    [[nodiscard]] std::chrono::nanoseconds dropped_time() const { return dropped_time_; }
    [[nodiscard]] int rate() const { return rate_; }

    /// A pause lasts from the last advance() before pause() to the first one after resume(). That
    /// first one owes no steps, however long the host waited.
    void pause() { paused_ = true; }
    void resume();
    [[nodiscard]] bool paused() const { return paused_; }
    /// Only while paused: the next advance() owes exactly one step and keeps alpha.
    void single_step();

    /// Simulated time runs at numerator/denominator of real time. The numerator is 0 (time stops)
    /// to largest_scale, the denominator 1 to largest_scale. A change keeps the accumulated
    /// fraction of a step and never gains or loses a whole step. The fraction stays exact while all
    /// scales so far share a denominator of at most largest_scale; otherwise it is rounded down by
    /// less than 10⁻⁹ of a step.
    void set_time_scale(int numerator, int denominator);
    /// See the constructor.
    void set_longest_frame(std::chrono::nanoseconds longest_frame);

private:
    std::int64_t whole_steps(std::chrono::nanoseconds elapsed);

    int rate_;
    std::chrono::nanoseconds longest_frame_{};
    std::optional<std::chrono::nanoseconds> last_stamp_;
    // Scaled nanoseconds times rate; a step is due at 10^9 · scale_denominator_.
    std::int64_t accumulated_ = 0;
    std::int64_t scale_numerator_ = 1;
    std::int64_t scale_denominator_ = 1;
    std::int64_t ticks_ = 0;
    std::chrono::nanoseconds dropped_time_{0};
    bool paused_ = false;
    bool single_step_ = false;
};

/// A frame of a headless run shows the state after `step` steps, and the fraction `alpha` of the
/// next.
struct HeadlessFrame {
    std::int64_t step = 0;
    double alpha = 0;
};

/// Frame i of a headless run shows t = i/fps: step ⌊i·rate/fps⌋, and the remainder over fps as
/// alpha. Integers are used because rounding to nanoseconds puts 400 of 600 frames at
/// fps = rate = 60 one step back.
[[nodiscard]] HeadlessFrame headless_frame(std::int64_t frame, int rate, int fps);

}  // namespace oiler
