// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace oiler {

/// The spans of the stages of a run, and counters, for the trace viewers of Chrome and Perfetto.
/// Threads may add to it at the same time.
class Profile {
public:
    using Clock = std::chrono::steady_clock;

    void add(const char* stage, Clock::time_point begin, Clock::time_point end);
    /// Notes the value of a counter now.
    void count(const char* counter, double value);
    /// JSON in Chrome's trace event format; times are in µs since the profile was made.
    [[nodiscard]] std::string to_json() const;

private:
    struct Event {
        const char* stage;
        std::size_t thread;
        Clock::time_point begin;
        Clock::time_point end;
    };
    struct Count {
        const char* counter;
        double value;
        Clock::time_point at;
    };

    mutable std::mutex mutex_;
    Clock::time_point start_ = Clock::now();
    std::vector<Event> events_;
    std::vector<Count> counts_;
};

/// Adds the time from its construction to its destruction. A null profile measures nothing.
class Span {
public:
    Span(Profile* profile, const char* stage) : profile_(profile), stage_(stage) {
        if (profile_) begin_ = Profile::Clock::now();
    }
    ~Span() {
        if (profile_) profile_->add(stage_, begin_, Profile::Clock::now());
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

private:
    Profile* profile_;
    const char* stage_;
    Profile::Clock::time_point begin_{};
};

}  // namespace oiler
