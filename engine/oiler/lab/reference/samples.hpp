// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/scene/make_world.hpp"

namespace oiler::lab {

/// The times at which a run is sampled: `per_second` per second, from 0 s to the end.
struct SampleTimes {
    std::int64_t per_second = 60;
    std::int64_t count = 0;

    /// The time of a sample, s.
    [[nodiscard]] double time(std::int64_t sample) const {
        return static_cast<double>(sample) / static_cast<double>(per_second);
    }
    /// Whether every sample coincides with a step at that rate.
    [[nodiscard]] bool meet_steps(std::int64_t rate) const { return rate % per_second == 0; }
    friend bool operator==(const SampleTimes&, const SampleTimes&) = default;
};

/// Chooses samples per second: the divisor of the scene's rate nearest to 60, so that the scene is
/// sampled at its own steps. A rate below 15 gives a multiple of the rate; a rate without a divisor
/// from 15 to 240 gives 60. Short scenes are sampled more often, scenes of many bodies less often.
/// Throws Error{usage} for a scene that is too long or has too many bodies.
[[nodiscard]] SampleTimes sample_times_of(const Scene& scene);

/// A run of a scene as drawn: between two steps, bodies are on the straight line from one to the
/// next.
class Follower {
public:
    /// Throws Error{usage} if the method cannot step the scene.
    Follower(const Scene& scene, const Settings& settings, std::int64_t samples_per_second);

    /// Steps to a sample. Samples must be visited in order. Returns false if the run has diverged.
    [[nodiscard]] bool go_to(std::int64_t sample);
    [[nodiscard]] State<long double, 3> state(std::size_t row) const;
    /// In J.
    [[nodiscard]] double energy() const;
    [[nodiscard]] const Bodies& bodies() const { return world_.bodies(); }

private:
    void remember();

    World world_;
    std::int64_t samples_per_second_;
    std::int64_t before_tick_ = -1;
    long double alpha_ = 0;
    std::vector<State<long double, 3>> before_;
    double energy_before_ = 0;
};

}  // namespace oiler::lab
