// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "oiler/app/options.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/app/report.hpp"
#include "oiler/app/shelf.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

/// A run: which game is played with which options, how it is stepped, and where its steps get their
/// input from.
struct GameRun {
    const Options& options;
    const About& about;
    const MakeGame& make;  ///< makes the game, and the runs that play along, anew
    Playback& playback;
    LiveInput& live;      ///< the player in a window
    InputSource& inputs;  ///< of the steps; it may be `live`
    std::int64_t script_steps = 0;
    Shelf* shelf = nullptr;
    Profile* profile = nullptr;
    StepTimes times{};  ///< of the steps since the last frame, in a window
};

/// The end of a run.
struct RunEnd {
    Exit exit = Exit::done;               ///< Exit::no_display if the display ended
    std::chrono::nanoseconds dropped{0};  ///< simulated time that late frames dropped
};

/// Draws frames into a folder. Frame i shows t = i/fps, independent of the machine's clock. If the
/// run is interrupted or throws Error, frames and manifest are complete up to there. With a single
/// frame of a manifest, returns Exit::comparison_failed if the frame differs from it.
Exit run_headless(GameRun& run);

/// Measures the budget of a headless run of that length; empty if it has none.
using MeasureBudget = std::function<std::vector<BudgetEntry>(double seconds)>;

/// Plays a game with the given options and writes its files. With --headless or --json it checks
/// the budget over the time played, and returns Exit::comparison_failed if the budget is exceeded.
/// Throws Error{diverged} if the state or the energy is not finite; the files then end before that.
/// With a shelf, a window can show other games. In a page, it returns before the first frame;
/// `make` and the texts of `about` must hold what they use.
Exit run_game(const Options& options, const About& about, const MakeGame& make,
              const MeasureBudget& measure_budget = {},
              const std::shared_ptr<Shelf>& shelf = nullptr);

}  // namespace oiler
