// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/frame_costs.hpp"
#include "oiler/core/json.hpp"
#include "oiler/play/recording.hpp"
#include "oiler/whatif/known_error.hpp"

namespace oiler {

class DrawTimer;

/// A recording, with the settings and controls to play it.
struct RecordedPlay {
    Settings settings;          ///< those that were recorded
    ChosenControls controls{};  ///< the player's
    Recording recording{};
    std::string name{};     ///< of its file, for messages
    bool plays_on = false;  ///< differences from the recording do not end it
};

/// A recording played with another setting, compared with the reference.
struct WhatIfRun {
    Stepping stepping;
    /// The largest distance of a body, as it is drawn, from the same body of the reference, m; NaN
    /// if none was compared after the beginning.
    double distance = std::numeric_limits<double>::quiet_NaN();
    Entity furthest{};  ///< that body
    /// The largest distance at steps alone, m.
    double distance_at_steps = std::numeric_limits<double>::quiet_NaN();
    double distance_now = 0;  ///< m, as drawn, the largest in the last recorded step
    /// The time from which a body is further away than a pixel plus the uncertainty, s: the first
    /// of the compared instants, of which each recorded step has 16.
    std::optional<double> visible_from{};
    /// The time from which the play is another one, s. No distance is counted from there on.
    std::optional<double> other_play_from{};
    std::string other_play{};  ///< the difference then, such as "coins 2, true 3"
    std::string failure{};     ///< the error that ended the run; empty: none
    /// The readings at the last recorded step that coincides with a step of the run, and the
    /// reference's readings then.
    std::vector<Reading> readings{};
    std::vector<Reading> true_readings{};
    double read_at = 0;  ///< s
    /// At 60 frames per second; means without the fastest and the slowest quarter.
    FrameCosts costs{.draw = std::numeric_limits<double>::quiet_NaN()};
    /// Evaluations of the forces on a body per second of play; 0: none were counted.
    double evaluations = 0;

    /// Whether the run never failed and stayed the same play.
    [[nodiscard]] bool is_sound() const { return failure.empty() && !other_play_from; }
};

/// The result of --what-if.
struct WhatIf {
    double duration = 0;        ///< s
    double measured_until = 0;  ///< s, the time that all runs have come to
    double certain_until = 0;   ///< s, the time until which distances are counted
    double pixel_until = 0;     ///< s, the time until which the played run is within a pixel
    /// The time in which the uncertainty grew tenfold, up to a pixel, where the true motion was
    /// lost; empty if it is known until the end, or was lost by other events.
    std::optional<double> tenfold{};
    /// Whether bodies, teleports or counts of the played run changed between its steps: such events
    /// come at steps, whatever the method.
    bool has_events_at_steps = false;
    double uncertainty = 0;         ///< m, the distance of `check` from the reference until then
    double pixel = 0;               ///< m, at the end
    WhatIfRun reference;            ///< the finest run
    WhatIfRun check;                ///< the reference at another rate
    std::vector<WhatIfRun> runs{};  ///< the recorded setting first

    /// The largest distance of a run, m.
    [[nodiscard]] KnownError error_of(const WhatIfRun& run) const {
        return {run.distance, uncertainty};
    }
    /// Its grade. An error whose size is not certain may be more than a pixel for certain.
    [[nodiscard]] Grade grade_of(const WhatIfRun& run) const {
        const Grade grade = error_of(run).grade(pixel);
        return grade == Grade::unknown && run.visible_from ? Grade::visible : grade;
    }
};

/// Reads settings such as "30,rk4,velocity_verlet@120,float". The words of a setting, with @
/// between them, are a rate in Hz, a method, a precision and a damping. Omitted words are those of
/// the recording. Throws Error{usage}.
[[nodiscard]] std::vector<Stepping> parse_what_if(const std::string& words,
                                                  const Stepping& recorded);

/// The settings to try first: half the rate if it is even, twice the rate, three usual
/// methods and the other precision, without methods that cannot step the bodies of the game.
[[nodiscard]] std::vector<Stepping> usual_what_if(const Settings& recorded, const MakeGame& make);

/// Plays a recording at its own setting, at `steppings`, and as a reference, all together, one
/// recorded step after the other. The reference is rk4 at 16 times the recorded rate, or at the
/// next multiple of that which is at least 7,680 Hz with up to 64 bodies, 960 Hz with more.
///
/// Bodies are compared at the beginning of each recorded step, if the run has a step then, and as
/// they are drawn, at 16 instants of each recorded step, on straight lines between the run's steps.
/// Bodies are the same if their entities are. A run is another play once its bodies, teleports,
/// restarts or whole-number readings have differed for 0.25 s, at recorded steps where it has none
/// for one step of its own longer: a shorter difference is a delay. While they differ, no body is
/// compared.
///
/// A run at slightly less than half of the reference's rate checks the reference, which is
/// uncertain once that run is another play, or further away than a pixel. A pixel is 1/720 of the
/// height that the reference's camera shows then.
///
/// Empty if interrupted. Without `draw`, drawing is not timed. Throws Error{comparison_failed} if
/// the recorded setting does not reproduce the recording, and Error{diverged} if the reference
/// fails.
[[nodiscard]] std::optional<WhatIf> measure_what_if(const RecordedPlay& play,
                                                    const std::vector<Stepping>& steppings,
                                                    const MakeGame& make, DrawTimer* draw,
                                                    bool quiet);

/// The table of a game's result.
[[nodiscard]] std::string text_of(const WhatIf& result, std::string_view game);
[[nodiscard]] Json to_json(const WhatIf& result, std::string_view game);

}  // namespace oiler
