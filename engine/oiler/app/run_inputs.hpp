// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "oiler/app/options.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/core/error.hpp"
#include "oiler/play/replay.hpp"
#include "oiler/play/script.hpp"

namespace oiler {

/// The sources of a run's input: the player in a window, a script or a recording; and the recording
/// of that input.
class RunInputs {
public:
    RunInputs(const Options& options, const About& about, const AnyGame& game);

    [[nodiscard]] InputSource& source() { return tape_ ? *tape_ : played(); }
    void watch(Playback& playback);
    /// Completes the recording. Throws Error{comparison_failed} if the replay ends differently or
    /// no step was compared. Returns it if a difference was found and the game played on.
    Exit finish(Playback& playback, const Options& options, bool diverged);
    /// After an error, the state of the game is not that of its last step.
    void finish_recording(const Playback& playback, bool after_error);
    [[nodiscard]] std::int64_t script_steps() const { return script_ ? script_->steps() : 0; }

    LiveInput live;

private:
    [[nodiscard]] InputSource& played();
    Exit finish_replay(Playback& playback, const Options& options, bool diverged);

    std::optional<ScriptInput> script_;
    std::optional<Replay> replay_;
    std::optional<InputRecorder> tape_;
};

}  // namespace oiler
