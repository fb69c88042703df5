// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What a way to step a scene makes of it, at all looks for which the reference is good. An error
/// that the reference cannot tell from its own is unknown.
struct Judgement {
    bool stable = true;               ///< finite, and never ten times as far off as any body gets
    double position_error = unknown;  ///< m, the largest of any body at any look
    double velocity_error = unknown;  ///< m/s
    /// Where the scene swings, at the last time that both go through the middle: degrees, ahead if
    /// positive.
    double phase_error = unknown;
    double energy_drift = unknown;  ///< the largest difference, of Reference::energy_scale
    double evaluations = unknown;   ///< of the forces on the first body, in a run in one go

    /// Whether the error is so small that the reference cannot tell it.
    [[nodiscard]] bool below_floor() const { return stable && position_error != position_error; }
};

/// Runs a scene and holds it against the reference. Throws Error{usage} where the method cannot
/// step the scene. Stopped, it is of no use.
[[nodiscard]] Judgement judge(
    const Scene& scene, const Settings& settings, const Reference& reference,
    const std::function<bool()>& stopped = [] { return false; });

/// Why the method cannot step the scene at all; empty where it can.
[[nodiscard]] std::string why_not(const Scene& scene, const Settings& settings);

/// The methods that people would think of.
[[nodiscard]] std::vector<const Method*> obvious_methods();

/// The scene's own, and those that people would think of as far as they can step it.
[[nodiscard]] std::vector<const Method*> usual_methods(const Scene& scene);

/// Evaluations of the forces on the first body in a step, in a run in one go.
[[nodiscard]] double evaluations_per_step(const Scene& scene, const Settings& settings);

}  // namespace oiler::lab
