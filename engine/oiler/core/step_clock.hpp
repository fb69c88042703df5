// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace oiler {

/// Says how many whole steps a frame owes, and how far it stands into the next one. It counts in
/// integers because every floating-point clock miscounts: 0.25 s at dt = 0.01 makes 24 steps when
/// summed in double, and a float clock at 60 Hz stands still after six days. It is a value that is
/// told the time, so that a test needs no sleeping and a copy is a snapshot.
class StepClock {
public:
    static constexpr int largest_rate = 1'000'000;
    static constexpr std::chrono::nanoseconds longest_longest_frame = std::chrono::seconds(1);
    static constexpr int largest_scale = 1000;

    struct Frame {
        std::int64_t steps = 0;
        /// Real time cut from a late frame, which no step will catch up.
        std::chrono::nanoseconds dropped{0};
        /// How far the stamps jumped back; such a frame owes no steps.
        std::chrono::nanoseconds backward{0};
    };

    /// The time towards the next step, exactly: parts of a whole, parts < whole.
    struct Remainder {
        std::int64_t parts = 0;
        std::int64_t whole = 1;
        friend bool operator==(const Remainder&, const Remainder&) = default;
    };

    /// `rate` in steps per second, 1 to largest_rate. A frame asks to be caught up for
    /// `longest_frame` at most (more than 0, up to longest_longest_frame), lest steps that take
    /// longer than the time they simulate make every next frame later still.
    explicit StepClock(int rate,
                       std::chrono::nanoseconds longest_frame = std::chrono::milliseconds(250));

    /// `now` is an absolute stamp of a monotonic clock; the first call starts the clock. Stamps
    /// and not durations, because durations rounded one by one lose a step an hour at 144 Hz.
    Frame advance(std::chrono::nanoseconds now);

    /// How far display time stands between the last step and the next, in [0, 1); display only.
    [[nodiscard]] double alpha() const;
    [[nodiscard]] Remainder remainder() const;
    /// All steps handed out so far.
    [[nodiscard]] std::int64_t ticks() const { return ticks_; }
    /// All real time cut from late frames; neither pauses nor backward jumps count.
    [[nodiscard]] std::chrono::nanoseconds dropped_time() const { return dropped_time_; }
    [[nodiscard]] int rate() const { return rate_; }

    /// A pause lasts whole frames: from the last advance() before pause() to the first one after
    /// resume(), which owes no steps, however long the host waited in between.
    void pause() { paused_ = true; }
    void resume();
    [[nodiscard]] bool paused() const { return paused_; }
    /// Only while paused: the next advance() owes exactly one step and leaves alpha as it is.
    void single_step();

    /// Simulated time runs at numerator/denominator of real time; numerator 0 to largest_scale
    /// (0 stands still), denominator 1 to largest_scale. The fraction of a step already gathered
    /// is kept: exactly while all scales used so far share a denominator of at most
    /// largest_scale, else rounded down by less than a billionth of a step. A change never gains
    /// or loses a whole step.
    void set_time_scale(int numerator, int denominator);

private:
    std::int64_t whole_steps(std::chrono::nanoseconds elapsed);

    int rate_;
    std::chrono::nanoseconds longest_frame_;
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

/// What frame `frame` of a headless run shows: the state after `step` steps, and how far display
/// time stands towards the next.
struct HeadlessFrame {
    std::int64_t step = 0;
    double alpha = 0;
};

/// Frame i of a headless run shows t = i/fps: step ⌊i·rate/fps⌋ and the rest over fps. Without
/// nanoseconds in between: rounding to them puts 400 of 600 frames at fps = rate = 60 a step back.
[[nodiscard]] HeadlessFrame headless_frame(std::int64_t frame, int rate, int fps);

}  // namespace oiler
