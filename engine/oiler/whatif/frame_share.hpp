// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace oiler {

/// The time of each frame for work that could wait. It grows slowly until frames come late, and then
/// gives way.
class FrameShare {
public:
    using Clock = std::chrono::steady_clock;

    explicit FrameShare(Clock::time_point now) : window_(now) {}

    void begin_frame(Clock::time_point now);
    [[nodiscard]] bool has_time() const { return left_.count() > 0; }
    /// What a frame spends beyond its share, the next ones have not.
    void spend(Clock::duration time) { left_ -= time; }

private:
    using Milliseconds = std::chrono::duration<double, std::milli>;

    static constexpr Milliseconds least{2};
    static constexpr Milliseconds most{6};
    static constexpr int frames_of_window = 30;

    Milliseconds share_{3};
    Milliseconds left_{0};
    Clock::time_point window_;                     ///< when it began
    int frames_ = 0;                               ///< since then
    Milliseconds shortest_ = Milliseconds::max();  ///< of a window
};

}  // namespace oiler
