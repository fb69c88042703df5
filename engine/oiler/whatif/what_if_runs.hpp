// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "oiler/play/tape.hpp"
#include "oiler/whatif/draw_timer.hpp"
#include "oiler/whatif/played_run.hpp"
#include "oiler/whatif/what_if.hpp"

namespace oiler {

/// Plays a recording at its own setting, at others and as a reference, all together, so that no
/// trajectory is kept. The recording may grow meanwhile.
class WhatIfRuns {
public:
    /// The play must outlive it. Throws as PlayedRun does.
    WhatIfRuns(const RecordedPlay& play, const std::vector<Stepping>& steppings,
               const MakeGame& make);

    /// Plays all runs until a recorded step begins, and compares them until there. Throws
    /// Error{diverged} if the reference fails, and Error{comparison_failed} if the recorded states
    /// differ.
    void play_until(std::int64_t step);
    /// After all recorded steps: throws Error{comparison_failed} if the recorded setting goes on
    /// where the game quit.
    void compare_end();
    void time_pictures(DrawTimer* draw);
    [[nodiscard]] WhatIf result() const;
    [[nodiscard]] const AnyGame& reference() const { return reference_.game(); }
    [[nodiscard]] const AnyGame& recorded_game() const { return runs_.front()->game(); }
    /// The recorded setting, without its costs.
    [[nodiscard]] const WhatIfRun& recorded() const { return runs_.front()->result(); }
    /// The recorded setting as it is drawn, and the true motion then.
    struct Drawn {
        Moment run;
        Moment truth;
    };
    /// At `alpha` between the last step and that before; empty if the true motion is not known, or
    /// another play.
    [[nodiscard]] std::optional<Drawn> drawn(double alpha) const;
    /// Whether later steps are compared, too.
    [[nodiscard]] bool certain() const { return certain_; }

private:
    /// Plays the reference and the run that checks it, and keeps its moments while it is certain.
    /// Returns whether it is as that recorded step begins.
    bool play_reference(std::int64_t step);
    /// Compares the reference with the run that checks it.
    bool check(std::int64_t step, const Moment& moment);
    [[nodiscard]] double visible() const { return pixel_ + uncertainty_; }

    const Recording& recording_;
    Replay replay_;
    PlayedRun reference_;
    PlayedRun check_;  ///< the reference at another rate
    std::vector<std::unique_ptr<PlayedRun>> runs_;
    Moment before_;                 ///< of the recorded setting, one step ago
    std::deque<TrueMoment> truth_;  ///< since the slowest run's last step
    std::int64_t step_ = 0;         ///< the last that was played
    std::int64_t longest_ = 1;      ///< the recorded steps that a step of the slowest run takes
    bool certain_ = true;
    double certain_until_ = 0;  ///< s
    double uncertainty_ = 0;    ///< m
    double pixel_ = 0;          ///< m, at the last comparison
};

}  // namespace oiler
