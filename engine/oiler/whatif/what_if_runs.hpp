// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/play/replay.hpp"
#include "oiler/render/renderer.hpp"
#include "oiler/whatif/moment.hpp"
#include "oiler/whatif/other_play.hpp"
#include "oiler/whatif/what_if.hpp"

namespace oiler {

/// Draws pictures off screen to measure how long that takes.
class DrawTimer {
public:
    /// Throws Error{no_display} without a provider of OpenGL.
    DrawTimer(Offscreen which, Size size)
        : surface_(open_offscreen(which)),
          renderer_([this](const char* name) { return surface_->procedure(name); }),
          size_(size) {}

    /// The time to draw a picture and to read its pixels. Drawing may only end with the reading.
    [[nodiscard]] std::chrono::nanoseconds time(const Picture& picture) {
        const auto start = std::chrono::steady_clock::now();
        renderer_.draw(picture, size_);
        renderer_.read(pixels_);
        return std::chrono::steady_clock::now() - start;
    }

private:
    std::unique_ptr<Surface> surface_;
    Renderer renderer_;
    Size size_;
    Pixels pixels_;
};

/// The number of moments of a recorded step that are compared. With more than 64 bodies, only those
/// that make 960 a second are, and with more than 2000, only every eighth one.
inline constexpr std::int64_t instants_per_step = 16;

/// The true motion at the instant `index`, of which each recorded step has instants_per_step.
struct TrueMoment {
    std::int64_t index = 0;
    Moment moment;
};

/// The place of a body that meets a plane, between two instants.
struct TrueImpact {
    double index = 0;  ///< of the instant, with a fraction
    std::int64_t cuts = 0;
    Moment::Placed body{};
};

/// The true motion: all bodies at instants, and single bodies at their impacts.
struct TrueMotion {
    std::deque<TrueMoment> moments{};
    std::deque<TrueImpact> impacts{};
};

/// A step of the recorded setting as it is drawn, and the true motion meanwhile.
struct DrawnStep {
    Moment before;
    Moment after;
    std::vector<Moment> truth{};  ///< from its beginning to its end, 3 moments or more

    struct Places {
        Moment run;
        Moment truth;
    };
    /// At `alpha` of the step, 0 to 1.
    [[nodiscard]] Places at(double alpha) const;
};

/// The run of a recording with one setting.
class SettingRun {
public:
    /// Throws Error{usage} if the method cannot step the bodies of the game.
    SettingRun(const Stepping& stepping, const RecordedPlay& play, const MakeGame& make);
    SettingRun(const SettingRun&) = delete;
    SettingRun& operator=(const SettingRun&) = delete;

    /// Takes all steps until a recorded one begins, unless one fails.
    void play_until(std::int64_t recorded);
    /// Takes these steps, and compares the bodies as drawn, between the steps and at them, with the
    /// moments of the reference. Distances above `visible`, m, are visible to a player.
    void play_until(std::int64_t recorded, const TrueMotion& truth, double visible);
    /// Takes all steps until an instant, and adds their impacts.
    void play_until_instant(std::int64_t index, std::deque<TrueImpact>* impacts = nullptr);
    /// Compares the play with the reference as that recorded step begins, `time` in s, and the
    /// places of bodies if a step of this run begins then, too. `true_game` is the reference.
    void compare(std::int64_t recorded, double time, const Moment& reference,
                 const AnyGame& true_game, double visible);
    /// Counts the distances until the play differs. Later ones wait until that is over.
    void settle() { settle_until(other_play_.since()); }
    /// Reads the game as that recorded step begins, if a step of this run begins then, too.
    /// `truth` are the readings of the reference.
    void read(std::int64_t recorded, const std::vector<Reading>& truth);
    void time_picture();
    void time_drawing(DrawTimer& draw);

    [[nodiscard]] const AnyGame& game() const { return *game_; }
    /// The play as it is now.
    [[nodiscard]] const Moment& moment();
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    [[nodiscard]] const WhatIfRun& result() const { return result_; }
    /// Whether the play was another one when it was last compared.
    [[nodiscard]] bool differs() const { return other_play_.differs(); }
    [[nodiscard]] bool failed() const { return !result_.failure.empty(); }
    /// The result with costs and readings.
    [[nodiscard]] WhatIfRun finish() const;

private:
    /// A distance from the true motion.
    struct Note {
        double time;  ///< s
        Apart apart;
        double visible;  ///< the least distance that a player sees then, m
        bool is_at_step = false;
    };

    [[nodiscard]] bool goes_on() const { return !game_->loop().quits() && !failed(); }
    void take_step();
    /// Ends the run with an error of the game; throws any other one.
    void fail_with(const Error& error);
    void add_impacts(std::deque<TrueImpact>& impacts) const;
    void compare_impacts(const Moment& before, const std::deque<TrueImpact>& impacts,
                         double visible);
    void note(const Note& note);
    /// Counts what was noted before that time, s, when the play was certainly the same.
    void settle_until(double time);
    void count(const Note& note);

    WhatIfRun result_;
    ResampledInput inputs_;
    Rate recorded_rate_;
    StepRatio ratio_;
    StepRatio instants_;
    StepTimes times_;
    std::unique_ptr<AnyGame> game_;
    std::int64_t steps_ = 0;
    std::int64_t evaluations_ = 0;
    std::optional<Moment> moment_;  ///< empty if a step was taken since
    OtherPlay other_play_;
    std::vector<Note> notes_;  ///< not yet counted
    std::vector<std::chrono::nanoseconds> updates_;
    std::vector<std::chrono::nanoseconds> world_steps_;
    std::vector<std::chrono::nanoseconds> pictures_;
    std::vector<std::chrono::nanoseconds> drawings_;
};

/// Plays a recording at its own setting, at others and as a reference, all together, so that no
/// trajectory is kept. The recording may grow meanwhile.
class WhatIfRuns {
public:
    /// The play must outlive it. Throws as SettingRun does.
    WhatIfRuns(const RecordedPlay& play, const std::vector<Stepping>& steppings,
               const MakeGame& make);

    /// Plays all runs until a recorded step begins, and compares them until there. Throws
    /// Error{diverged} if the reference fails, and Error{comparison_failed} if the recorded states
    /// differ.
    void play_until(std::int64_t step) {
        while (!play_part(step)) {
        }
    }
    /// Plays one run until there, or the reference until its next instant. Returns whether that was
    /// the last part, and all were compared.
    [[nodiscard]] bool play_part(std::int64_t step);
    /// Throws Error{comparison_failed} if the recorded setting does not quit after all recorded
    /// steps, though the game did.
    void compare_end();
    void time_pictures(DrawTimer* draw);
    [[nodiscard]] WhatIf result() const;
    [[nodiscard]] const AnyGame& reference() const { return reference_.game(); }
    [[nodiscard]] const AnyGame& recorded_game() const { return runs_.front()->game(); }
    /// The recorded setting, without its costs.
    [[nodiscard]] const WhatIfRun& recorded() const { return runs_.front()->result(); }
    /// The last recorded step; null if its true motion is unknown or another play.
    [[nodiscard]] std::shared_ptr<const DrawnStep> drawn() const;
    /// Whether later steps are compared, too.
    [[nodiscard]] bool certain() const { return certain_; }

private:
    void play_instant();
    /// Plays the check run, and keeps the reference's moments while it is certain. Returns whether
    /// it is certain when that recorded step begins.
    bool play_check(std::int64_t step);
    /// Compares the reference with the check run.
    bool check(std::int64_t step, const Moment& moment);
    void compare(std::int64_t step);
    [[nodiscard]] double visible() const { return pixel_ + uncertainty_; }

    const Recording& recording_;
    Replay replay_;
    std::vector<std::unique_ptr<SettingRun>> runs_;  ///< the recorded setting and the others
    SettingRun reference_;
    SettingRun check_;       ///< the check run: the reference at another rate
    Moment before_;          ///< of the recorded setting, one step ago
    TrueMotion truth_;       ///< since the slowest run's last step
    std::int64_t step_ = 0;  ///< the last that was played
    // Of the next step:
    std::int64_t instant_ = -1;          ///< the last that the reference played
    std::vector<TrueMoment> moments_{};  ///< of the reference
    std::deque<TrueImpact> impacts_{};   ///< of the reference
    bool is_known_ = false;              ///< whether the reference is certain when it begins
    std::size_t run_ = 0;                ///< the next run

    std::int64_t longest_ = 1;  ///< the recorded steps that a step of the slowest run takes
    bool certain_ = true;
    bool has_events_at_steps_ = false;     ///< of the recorded setting
    double certain_until_ = 0;             ///< s
    double pixel_until_ = 0;               ///< s
    std::optional<double> small_until_{};  ///< s, the time until which the uncertainty was small
    std::optional<double> tenfold_{};      ///< s
    double uncertainty_ = 0;               ///< m
    double pixel_ = 0;                     ///< m, at the last comparison
};

}  // namespace oiler
