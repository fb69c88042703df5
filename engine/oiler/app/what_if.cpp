// SPDX-License-Identifier: MIT
#include "oiler/app/what_if.hpp"

#include <algorithm>
#include <memory>

#include "oiler/app/console.hpp"
#include "oiler/app/interrupt.hpp"
#include "oiler/app/played_run.hpp"
#include "oiler/app/tape.hpp"
#include "oiler/app/what_if_settings.hpp"
#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr std::int64_t reference_factor = 16;
constexpr double pixels_of_height = 720;
constexpr std::int64_t pictures_timed = 15;

/// The reference, and the same at half the rate.
struct Reference {
    Reference(const Options& options, const MakeGame& make)
        : fine(stepping(options, reference_factor), options, make),
          half(stepping(options, reference_factor / 2), options, make) {}

    static Stepping stepping(const Options& options, std::int64_t factor) {
        Rate rate = options.replay->header.stepping.rate;
        rate.steps *= factor;
        return {.method = &find_method("rk4"), .rate = rate};
    }
    void play_until(std::int64_t recorded) {
        for (PlayedRun* const run : {&fine, &half}) {
            run->play_until(recorded);
            if (run->failed())
                fail(Exit::diverged, "--what-if: the reference ({}) failed: {}",
                     describe(run->result().stepping), run->result().failure);
        }
    }

    PlayedRun fine;
    PlayedRun half;
};

/// Plays all runs together, so that no trajectory is kept.
class WhatIfRuns {
public:
    WhatIfRuns(const Options& options, const std::vector<Stepping>& steppings, const MakeGame& make)
        : recording_(*options.replay),
          replay_(recording_, options.replay_file.string()),
          reference_(options, make) {
        runs_.push_back(std::make_unique<PlayedRun>(recording_.header.stepping, options, make));
        for (const Stepping& stepping : steppings)
            runs_.push_back(std::make_unique<PlayedRun>(stepping, options, make));
    }

    void play_until(std::int64_t step) {
        reference_.play_until(step);
        for (const auto& run : runs_) run->play_until(step);
        if (step > 0 && !runs_.front()->failed())
            replay_.after(step - 1, runs_.front()->game());
        if (certain_) compare(step);
    }
    void time_pictures(DrawTimer* draw) {
        for (const auto& run : runs_) run->time_picture();
        if (draw)  // afterwards, because it empties the caches of the processor
            for (const auto& run : runs_) run->time_drawing(*draw);
    }
    [[nodiscard]] WhatIf finish() {
        WhatIf result{.duration = recording_.header.stepping.rate.time(recording_.steps),
                      .certain_until = certain_until_,
                      .uncertainty = uncertainty_,
                      .reference = reference_.fine.finish(),
                      .half = reference_.half.finish()};
        for (const auto& run : runs_) result.runs.push_back(run->finish());
        return result;
    }

private:
    void compare(std::int64_t step) {
        const double time = recording_.header.stepping.rate.time(step);
        const Moment moment = moment_of(reference_.fine.game());
        const double pixel =
            static_cast<double>(reference_.fine.game().picture().camera.height) / pixels_of_height;
        PlayedRun& half = reference_.half;
        half.compare(step, time, moment, pixel);
        certain_ = !half.result().other_play_from && !half.result().visible_from;
        if (!certain_ || half.differs()) return;
        certain_until_ = time;
        uncertainty_ = half.result().distance;
        for (const auto& run : runs_) run->compare(step, time, moment, pixel + uncertainty_);
    }

    const Recording& recording_;
    Replay replay_;
    Reference reference_;
    std::vector<std::unique_ptr<PlayedRun>> runs_;
    bool certain_ = true;
    double certain_until_ = 0;
    double uncertainty_ = 0;
};

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
    return runs.finish();
}

}  // namespace oiler
