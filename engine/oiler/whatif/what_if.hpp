// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/json.hpp"
#include "oiler/game/reading.hpp"
#include "oiler/play/recording.hpp"
#include "oiler/whatif/draw_timer.hpp"

namespace oiler {

/// A recording, and what else decides how its game is played.
struct RecordedPlay {
    Settings settings;          ///< those that were recorded
    ChosenControls controls{};  ///< the player's
    Recording recording{};
    std::string name{};     ///< of its file, for messages
    bool plays_on = false;  ///< also where it differs from the recording
};

/// The time that a frame takes at 60 frames per second, ns; means without the fastest and the
/// slowest quarter.
struct FrameCosts {
    double update = 0;
    double step = 0;
    double picture = 0;
    double draw = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not measured
};

/// A recording played with another setting, compared with the reference.
struct WhatIfRun {
    Stepping stepping;
    /// The largest distance of a body, as it is drawn, from the same body of the reference, m; NaN
    /// if none was compared after the beginning.
    double distance = std::numeric_limits<double>::quiet_NaN();
    Entity furthest{};  ///< that body
    /// The same at the steps alone.
    double distance_at_steps = std::numeric_limits<double>::quiet_NaN();
    double distance_now = 0;  ///< m, as drawn, the largest in the last recorded step
    /// The time from which a body is further away than a pixel and the uncertainty, s.
    std::optional<double> visible_from{};
    /// The time from which the play is another one, s. No distance is counted from there on.
    std::optional<double> other_play_from{};
    std::string failure{};  ///< the error that ended the run; empty: none
    /// The readings at the end of the last recorded step that the run has, too, and those of the
    /// reference then.
    std::vector<Reading> readings{};
    std::vector<Reading> true_readings{};
    double read_at = 0;  ///< s
    FrameCosts costs{};
    /// Evaluations of the forces on a body per second of play; 0: none were counted.
    double evaluations = 0;
};

/// The result of --what-if.
struct WhatIf {
    double duration = 0;            ///< s
    double certain_until = 0;       ///< s, the time until which distances are counted
    double uncertainty = 0;         ///< m, the distance of `check` from the reference until then
    double pixel = 0;               ///< m, at the end
    WhatIfRun reference;            ///< the finest run
    WhatIfRun check;                ///< the reference at another rate
    std::vector<WhatIfRun> runs{};  ///< the recorded setting first
};

/// Smaller errors than so many uncertainties of the reference are not known to a digit.
inline constexpr double least_certain = 10;

/// Plays a recording at its own setting, at `steppings`, and as a reference with rk4 at 16 times
/// its rate, or a multiple of that which is at least 960 Hz. All runs go through the recording
/// together and are compared at each recorded step that a run has, too, and as they are drawn, on
/// straight lines between their own steps, at 16 moments of each recorded step. Bodies are the same
/// if their entities are. The play is another one once bodies, teleports, restarts or whole-number
/// readings have differed for 0.25 s: a shorter difference is a delay. Between two steps that
/// differ in these, nothing is compared. The reference is uncertain once a run at 7/16 of its rate
/// is another play, or further away than a pixel. A pixel is 1/720 of the height that the camera of
/// the reference shows then.
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
