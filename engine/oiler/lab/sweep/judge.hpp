// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The errors of a setting on a scene, over the meaningful time of the reference. An error below
/// the reference's floor is `unknown`.
struct Judgement {
    bool stable = true;    ///< finite, and errors never exceed 10 × the extent
    bool complete = true;  ///< false for a run that was ended early; errors are then lower bounds
    /// m, the largest distance of any body as drawn from its true position: on straight lines
    /// between steps, at all times or at those of a display's frames.
    double position_error = unknown;
    double step_error = unknown;      ///< m, the largest distance at the steps
    double velocity_error = unknown;  ///< m/s, the largest at the steps
    /// For an oscillating scene, at the last upward crossing of the mean position that both have:
    /// degrees, positive if the run is ahead.
    double phase_error = unknown;
    double energy_drift = unknown;  ///< the largest at the steps, relative to the energy scale
    double evaluations = unknown;   ///< of the forces on the first body, with many steps per call
    /// m, step_error up to the end of each of `growth_parts` equal parts of the time.
    std::vector<double> growth{};

    /// Whether the position error is below the reference's floor.
    [[nodiscard]] bool below_floor() const { return stable && position_error != position_error; }
};

inline constexpr std::int64_t growth_parts = 64;

/// How a run is judged.
struct JudgeOptions {
    /// Between steps, lines are compared at the times of frames, or at any time if 0; 1/s.
    std::int64_t display = 0;
    /// A run ends early when an error exceeds this, m.
    double enough = std::numeric_limits<double>::infinity();
    bool at_steps = false;  ///< only errors at the steps end a run early
    std::function<bool()> stopped = [] { return false; };
};

/// Runs a scene and compares it with the reference at every step and between steps. A rate at which
/// the method's damping overflows is unstable. Throws Error{usage} if the method cannot step the
/// scene at any rate. The result of a stopped call is incomplete.
[[nodiscard]] Judgement judge(const Scene& scene, const Settings& settings,
                              const Reference& reference, const JudgeOptions& options = {});

/// Why the method cannot step the scene; empty if it can.
[[nodiscard]] std::string why_not(const Scene& scene, const Settings& settings);

/// The methods that people commonly choose.
[[nodiscard]] std::vector<const Method*> obvious_methods();

/// The scene's own method, and the obvious methods that can step it.
[[nodiscard]] std::vector<const Method*> usual_methods(const Scene& scene);

/// Evaluations of the forces on the first body per step, with many steps per call.
[[nodiscard]] double evaluations_per_step(const Scene& scene, const Settings& settings);

}  // namespace oiler::lab
