// SPDX-License-Identifier: MIT
#include "oiler/app/run_inputs.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/process/console.hpp"

namespace oiler {
namespace {

std::vector<ScriptLine> read_script(const Options& options, std::span<const Control> controls) {
    const bool is_stdin = options.script == "-";
    const std::string text = is_stdin ? std::string(std::istreambuf_iterator<char>(std::cin), {})
                                      : read_text(options.script);
    return parse_script(text, is_stdin ? "standard input" : options.script.string(),
                        options.settings.stepping.rate, controls);
}

}  // namespace

RunInputs::RunInputs(const Options& options, const About& about, const AnyGame& game)
    : live(options.controls) {
    if (options.replay)
        replay_.emplace(*options.replay, options.replay_file.string(), options.controls,
                        options.replay_anyway);
    else if (!options.script.empty())
        script_.emplace(read_script(options, controls_of(options, about)), game, options.controls);
    if (!options.record.empty())
        tape_.emplace(played(), options.record,
                      header_of(about.name, options.settings, controls_of(options, about)));
    for (const auto& [option, path] :
         {std::pair("--script", options.script), std::pair("--record", options.record)})
        if (!path.empty() && !game.takes_input())
            remark(options.quiet, "{}: {} has no update(const Input&), so it sees no input", option,
                   about.name);
}

void RunInputs::watch(Playback& playback) {
    if (tape_) playback.watch(*tape_);
    if (replay_) playback.watch(*replay_);
}

Exit RunInputs::finish(Playback& playback, const Options& options, bool diverged) {
    finish_recording(playback, diverged);
    if (tape_ && playback.steps() == 0)
        remark(options.quiet, "no step was taken: {} is not written", options.record.string());
    if (script_ && script_->unplayed() > 0)
        remark(options.quiet, "lines of the script after the last step, not played: {}",
               script_->unplayed());
    return replay_ ? finish_replay(playback, options, diverged) : Exit::done;
}

void RunInputs::finish_recording(const Playback& playback, bool after_error) {
    if (tape_) tape_->finish(playback.steps(), playback.game(), after_error);
}

InputSource& RunInputs::played() {
    if (replay_) return *replay_;
    if (script_) return *script_;
    return live;
}

Exit RunInputs::finish_replay(Playback& playback, const Options& options, bool diverged) {
    const std::int64_t steps = std::min(playback.steps(), replay_->steps());
    const bool whole = steps == replay_->steps();
    // A game quits in the update of a step that it does not take.
    if (replay_->quits() && whole && !diverged) playback.step_to(steps + 1, *replay_);
    replay_->compare_end(playback.steps(), playback.loop().quits());
    if (steps == 0 && !diverged)
        fail(Exit::comparison_failed,
             "{}: no step was replayed, so that no state was compared; replay more of it",
             options.replay_file.string());
    if (steps > 0 && replay_->compared() == 0)
        fail(Exit::comparison_failed,
             "{}: none of the {} steps was compared, because the recording has no state of "
             "them; replay more of it",
             options.replay_file.string(), steps);
    if (!replay_->difference().empty()) {
        remark(false, "{}", replay_->difference());
        return Exit::comparison_failed;
    }
    remark(options.quiet, "the replay equals the recording: {} of {} steps{}{}", steps,
           replay_->steps(),
           replay_->compared() < steps
               ? fmt::format(", of which {} were compared", replay_->compared())
               : "",
           whole && !replay_->complete()
               ? ", where the recording has no end: it was cut, or its program killed"
               : "");
    const std::vector<std::string> unhashed = playback.world().unhashed();
    if (!unhashed.empty())
        remark(options.quiet, "not compared, because they have no hash(): {}",
               fmt::join(unhashed, ", "));
    return Exit::done;
}

}  // namespace oiler
