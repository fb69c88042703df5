// SPDX-License-Identifier: MIT
#include "oiler/app/what_if.hpp"

#include <algorithm>

#include "oiler/app/console.hpp"
#include "oiler/app/interrupt.hpp"
#include "oiler/app/what_if_runs.hpp"

namespace oiler {
namespace {

constexpr std::int64_t pictures_timed = 15;

}  // namespace

std::optional<WhatIf> measure_what_if(const Options& options,
                                      const std::vector<Stepping>& steppings, const MakeGame& make,
                                      DrawTimer* draw) {
    WhatIfRuns runs(options, steppings, make);
    const std::int64_t steps = options.replay->steps;
    const std::int64_t stride = std::max<std::int64_t>(1, steps / pictures_timed);
    Progress progress(options.quiet, "steps", steps);
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
