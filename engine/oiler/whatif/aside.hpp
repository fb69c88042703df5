// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "oiler/whatif/frame_share.hpp"
#include "oiler/whatif/play_along.hpp"

namespace oiler {

/// A thread on which runs play along with a game. It lags behind if they take longer than the time
/// that the game waits for them. If the machine gives no thread, they play along in a share of each
/// frame.
class Aside {
public:
    explicit Aside(bool wants_thread = true);
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

    /// Begins anew, after the step that is being played. What was known is dropped, unless a round
    /// is repeated: that is first played along to its end, until the next has input.
    void begin(AlongFrom from);
    void add(const Recording::Event& event);
    /// The game has taken that many steps. Waits until all are played along, but not longer than
    /// `time`. Returns what is known then.
    [[nodiscard]] LiveFigures play_until(std::int64_t steps, std::chrono::nanoseconds time);

private:
    using Clock = std::chrono::steady_clock;

    /// What the game's thread has posted.
    struct Posted {
        std::optional<AlongFrom> from{};  ///< to begin with; empty: goes on
        std::vector<Recording::Event> events{};
        std::int64_t steps = 0;
    };

    void run(const std::stop_token& stop);
    /// Waits for what to do next; returns whether there is anything.
    bool wait(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
    [[nodiscard]] bool has_work() const;
    [[nodiscard]] bool is_verdict_due(Clock::time_point now) const;
    /// Takes the mail and plays a part of a step along. The mutex is unlocked meanwhile.
    void go_on(std::unique_lock<std::mutex>& lock);
    void take(Posted posted);
    /// Whether the round that is played along goes on to its end before the next begins.
    [[nodiscard]] bool goes_on_before_next() const;
    /// Plays a part of a step along, or begins. Returns whether more is known.
    bool work();
    [[nodiscard]] LiveFigures known() const;

    std::mutex mutex_;
    std::condition_variable_any posted_;
    std::condition_variable published_;
    std::vector<Posted> mail_ = std::vector<Posted>(1);  ///< never empty; the last one grows
    LiveFigures figures_;
    FrameShare share_{Clock::now()};  ///< without a thread

    // Of the thread alone, if there is one:
    std::unique_ptr<PlayAlong> along_;
    std::optional<Posted> next_;  ///< begins after it
    Clock::time_point next_verdict_{};
    std::jthread thread_;
};

}  // namespace oiler
