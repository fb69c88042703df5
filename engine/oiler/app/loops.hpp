// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "oiler/app/options.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/app/report.hpp"
#include "oiler/app/run.hpp"
#include "oiler/app/shelf.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

/// Draws frames into a folder. Frame i shows t = i/fps, independent of the machine's clock. If the
/// run is interrupted or throws Error, frames and manifest are complete up to there. With a single
/// frame of a manifest, returns Exit::comparison_failed if the frame differs from it.
Exit run_headless(Playback& playback, InputSource& inputs, const Options& options,
                  const About& about, const MakeGame& make, Profile* profile);

/// The end of a run in a loop.
struct Played {
    Exit exit = Exit::done;               ///< Exit::no_display if the display ended
    std::chrono::nanoseconds dropped{0};  ///< simulated time that late frames dropped
};

/// Shows the game in a window in real time until the user quits, the display or a replay ends.
/// Steps take their input from `inputs`, which may be `live`. `make` makes the games that play
/// along for the verdict. `shelf` may be null.
Played run_window(Playback& playback, LiveInput& live, InputSource& inputs, const Options& options,
                  const About& about, const MakeGame& make, Shelf* shelf, Profile* profile);

/// Measures the budget of a run of so many seconds without a window; empty if it has none.
using MeasureBudget = std::function<std::vector<BudgetEntry>(double seconds)>;

/// Plays a game with the given options and writes its files. With --headless or --json it checks
/// the budget over the time played, and returns Exit::comparison_failed if the budget is exceeded.
/// Throws Error{diverged} if the state or the energy is not finite; the files then end before that.
/// With a shelf, a window can show other games.
Exit run_game(const Options& options, const About& about, const MakeGame& make,
              const MeasureBudget& measure_budget = {}, Shelf* shelf = nullptr);

}  // namespace oiler
