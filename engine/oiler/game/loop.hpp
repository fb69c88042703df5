// SPDX-License-Identifier: MIT
#pragma once

// The requests, input, readings and times that a game and its loop exchange.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "oiler/input/input.hpp"

namespace oiler {

/// The requests of a game to the loop that runs it: `void update(const Input& input, Loop& loop)`.
class Loop {
public:
    /// Makes the game anew after this update, with its world's settings. Pictures jump.
    void restart() { restarts_ = true; }
    /// Takes no step of the world after this update, as in a menu: its tick and hash stay, and
    /// forces that the update applied are dropped.
    void hold() { holds_ = true; }
    /// Lets keys enter text, see Input::text, until it is switched off. Meanwhile only Enter,
    /// Escape, Backspace, Tab and the arrows act as keys.
    void text_input(bool on) { takes_text_ = on; }
    /// Ends the program after this update.
    void quit() { quits_ = true; }
    /// Asks a window for that rate, Hz: it makes the game anew with it. A run whose setting is
    /// fixed keeps its rate, as every run without a window does.
    void change_rate(std::int64_t hertz) { wanted_rate_ = hertz; }
    /// Whether this is a copy of the game that plays along to measure what the timestep costs. Such
    /// copies play in another thread: whatever leaves the game, such as a sound, a line of a log or
    /// a saved file, is for the game alone.
    [[nodiscard]] bool is_rehearsal() const { return is_rehearsal_; }

    void rehearse() { is_rehearsal_ = true; }
    [[nodiscard]] bool restarts() const { return restarts_; }
    [[nodiscard]] bool holds() const { return holds_; }
    [[nodiscard]] bool takes_text() const { return takes_text_; }
    [[nodiscard]] bool quits() const { return quits_; }
    /// The requested rate, Hz, once.
    [[nodiscard]] std::optional<std::int64_t> take_wanted_rate() {
        return std::exchange(wanted_rate_, std::nullopt);
    }
    /// Clears the requests that hold for one step.
    void begin_step() { restarts_ = holds_ = false; }

private:
    bool restarts_ = false;
    bool holds_ = false;
    bool takes_text_ = false;
    bool quits_ = false;
    bool is_rehearsal_ = false;
    std::optional<std::int64_t> wanted_rate_{};
};

/// The source of the input that the steps of a game see.
class InputSource {
public:
    virtual ~InputSource() = default;
    InputSource() = default;
    InputSource(const InputSource&) = delete;
    InputSource& operator=(const InputSource&) = delete;

    /// The input of a step of the loop, counted from 0. Steps are asked for in their order.
    [[nodiscard]] virtual Input next(std::int64_t step) = 0;
};

/// A player in the window. Steps see the camera of the picture that was on screen.
class LiveInput final : public InputSource {
public:
    explicit LiveInput(const ChosenControls& controls = {}) : queue(controls) {}

    [[nodiscard]] Input next(std::int64_t) override { return queue.take(shown); }

    InputQueue queue;
    Camera shown{};
};

/// A result of the play that a game offers, such as a score, an apex or the time of a hit:
/// `std::vector<Reading> readings() const`. --what-if compares them between settings. Whole numbers
/// count as state of the play: if they differ, it is another play.
struct Reading {
    std::string name;
    double value = 0;
    std::string unit{};  ///< "m"; empty for a count
    friend bool operator==(const Reading&, const Reading&) = default;
};

/// Throws Error{usage} if two readings have one name.
void require_distinct_names(const std::vector<Reading>& readings);

/// The times that steps of a game take, summed up, in ns.
struct StepTimes {
    std::int64_t update = 0;
    std::int64_t step = 0;  ///< of the world
};

/// Adds the time from its construction to its destruction to one of the sums. Without sums it
/// measures nothing.
class Stopwatch {
public:
    Stopwatch(StepTimes* sums, std::int64_t StepTimes::*which);
    ~Stopwatch();
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    std::int64_t* sum_;
    std::int64_t begin_ = 0;  ///< ns of the steady clock
};

}  // namespace oiler
