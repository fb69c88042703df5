// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "oiler/app/options.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/app/report.hpp"
#include "oiler/app/run.hpp"

namespace oiler {

/// Draws frame i at t = i/fps into the folder, whatever the machine's clock does. What was written
/// stays complete when it is interrupted or throws Error.
void run_headless(Playback& playback, const Options& options, const About& about);

/// Shows the game in a window at the pace of the clock until the user quits. Returns the time that
/// late frames dropped.
std::chrono::nanoseconds run_window(Playback& playback, const Options& options, const About& about);

/// What was measured of a run that plays without a window, if anything.
using MeasureBudget = std::function<std::vector<BudgetEntry>()>;

/// Plays a game from its start to its end as the options say, and writes what they ask for.
/// With --headless or --json the budget is measured, and exceeding it is a failed comparison.
Exit run_game(const Options& options, const About& about, const MakeGame& make,
              const MeasureBudget& measure_budget = {});

}  // namespace oiler
