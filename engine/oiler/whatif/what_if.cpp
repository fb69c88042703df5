// SPDX-License-Identifier: MIT
#include "oiler/whatif/what_if.hpp"

#include <algorithm>

#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/whatif/what_if_runs.hpp"

namespace oiler {
namespace {

constexpr std::int64_t pictures_timed = 15;

}  // namespace

std::optional<WhatIf> measure_what_if(const RecordedPlay& play,
                                      const std::vector<Stepping>& steppings, const MakeGame& make,
                                      DrawTimer* draw, bool quiet) {
    WhatIfRuns runs(play, steppings, make);
    const std::int64_t steps = play.recording.steps;
    const std::int64_t stride = std::max<std::int64_t>(1, steps / pictures_timed);
    Progress progress(quiet, "steps", steps);
    for (std::int64_t step = 0; step <= steps; ++step) {
        if (Interrupt::requested()) return std::nullopt;
        runs.play_until(step);
        if (step % stride == 0) runs.time_pictures(draw);
        progress.show(step);
    }
    WhatIf result = runs.result();
    runs.compare_end();
    return result;
}

}  // namespace oiler
