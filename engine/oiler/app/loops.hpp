// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "oiler/app/options.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/app/run.hpp"

namespace oiler {

/// Draws frame i at t = i/fps into the folder, whatever the machine's clock does. What was written
/// stays complete when it is interrupted or throws Error.
void run_headless(Playback& playback, const Options& options, const About& about);

/// Shows the game in a window at the pace of the clock until the user quits. Returns the time that
/// late frames dropped.
std::chrono::nanoseconds run_window(Playback& playback, const Options& options, const About& about);

/// Plays a game from its start to its end as the options say, and writes what they ask for.
Exit run_game(const Options& options, const About& about, const MakeGame& make);

}  // namespace oiler
