// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "oiler/scene/make_world.hpp"
#include "oiler/sim/step_work.hpp"

namespace oiler::lab {

/// Random changes of all bodies' starts.
struct Perturbation {
    std::uint64_t seed = 0;  ///< 0 for none
    double position = 0;     ///< m, the largest along each axis
    double velocity = 0;     ///< m/s, the largest along each axis
};

/// Makes a world of the scene whose bodies start from the perturbed state.
[[nodiscard]] World make_world(const Scene& scene, const Settings& settings,
                               const Perturbation& perturbation);

/// The bodies of that world in long double.
[[nodiscard]] Bodies make_exact_bodies(const Scene& scene, const Perturbation& perturbation);

/// The times at which a run is sampled: `per_second` per second, from 0 s to the end.
struct SampleTimes {
    std::int64_t per_second = 60;
    std::int64_t count = 0;

    /// The time of a sample, s.
    [[nodiscard]] double time(std::int64_t sample) const {
        return static_cast<double>(sample) / static_cast<double>(per_second);
    }
    friend bool operator==(const SampleTimes&, const SampleTimes&) = default;
};

/// How densely a motion is sampled.
struct Density {
    double per_period = 48;   ///< samples per period of the fastest motion
    double times = 1;         ///< multiplies all numbers of samples that are wanted
    std::int64_t bodies = 1;  ///< that are kept in memory
    double most_per_second = 1e9;
};

/// Chooses samples that resolve the fastest motion of the scene's springs, links, drag and orbits,
/// at least 60 per second and 20 in all, and no more than fit into memory. The last sample is at
/// the end or after it.
[[nodiscard]] SampleTimes sample_times_of(const Scene& scene, const Bodies& start,
                                          const Density& density = {});

/// Throws Error{usage} for a scene that is too long, too short or has too many bodies to be
/// compared with a reference.
void require_measurable(const Scene& scene);

/// A run that is read at every sample. Each sample coincides with a step.
class Follower {
public:
    /// The rate must be a multiple of the samples per second. Throws Error{usage} if the method
    /// cannot step the scene.
    Follower(const Scene& scene, const Settings& settings, const Perturbation& start,
             std::int64_t samples_per_second);

    /// Steps to a sample. Samples must be visited in order. Returns false if the run has diverged.
    [[nodiscard]] bool go_to(std::int64_t sample);
    /// Whether it has diverged by more impacts in a step than can be followed.
    [[nodiscard]] bool has_too_many_impacts() const {
        return divergence_ && divergence_->of == Divergence::Of::impacts;
    }
    [[nodiscard]] const Bodies& bodies() const { return world_.bodies(); }

private:
    World world_;
    std::int64_t steps_per_sample_;
    std::optional<Divergence> divergence_;
};

/// The work of a step of the scene.
class RunWork : public StepWork {
public:
    explicit RunWork(const Scene& scene);
};

}  // namespace oiler::lab
