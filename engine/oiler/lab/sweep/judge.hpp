// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The errors of a setting on a scene, over all meaningful samples of the reference. An error below
/// the reference's floor is `unknown`.
struct Judgement {
    bool stable = true;               ///< finite, and errors never exceed 10 × the extent
    double position_error = unknown;  ///< m, the largest of any body at any sample
    double velocity_error = unknown;  ///< m/s
    /// For an oscillating scene, at the last upward crossing of the mean position that both have:
    /// degrees, positive if the run is ahead.
    double phase_error = unknown;
    double energy_drift = unknown;  ///< the largest, relative to Reference::energy_scale
    double evaluations = unknown;   ///< of the forces on the first body, with many steps per call

    /// Whether the position error is below the reference's floor.
    [[nodiscard]] bool below_floor() const { return stable && position_error != position_error; }
};

/// Runs a scene and compares it with the reference. Throws Error{usage} if the method cannot step
/// the scene. The result of a stopped call is incomplete.
[[nodiscard]] Judgement judge(
    const Scene& scene, const Settings& settings, const Reference& reference,
    const std::function<bool()>& stopped = [] { return false; });

/// Why the method cannot step the scene; empty if it can.
[[nodiscard]] std::string why_not(const Scene& scene, const Settings& settings);

/// The methods that people commonly choose.
[[nodiscard]] std::vector<const Method*> obvious_methods();

/// The scene's own method, and the obvious methods that can step it.
[[nodiscard]] std::vector<const Method*> usual_methods(const Scene& scene);

/// Evaluations of the forces on the first body per step, with many steps per call.
[[nodiscard]] double evaluations_per_step(const Scene& scene, const Settings& settings);

}  // namespace oiler::lab
