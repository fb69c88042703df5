// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "oiler/scene/make_world.hpp"

namespace oiler::lab {

/// When a run is looked at: so often in every second, from 0 s to the end.
struct Looks {
    std::int64_t per_second = 60;
    std::int64_t count = 0;

    /// In s.
    [[nodiscard]] double time(std::int64_t look) const {
        return static_cast<double>(look) / static_cast<double>(per_second);
    }
    /// Whether all looks meet a step at that rate.
    [[nodiscard]] bool meet_steps(std::int64_t rate) const { return rate % per_second == 0; }
    friend bool operator==(const Looks&, const Looks&) = default;
};

/// The divisor of the scene's rate that is nearest to 60, so that the scene as it stands is looked
/// at where it steps; a multiple of a rate below 15, and 60 where no divisor lies from 15 to 240.
/// More often where the scene is short, less where it has many bodies. Throws Error{usage} for
/// scenes that are too long or have too many bodies to follow.
[[nodiscard]] Looks looks_of(const Scene& scene);

/// A run of a scene as a player sees it: between two steps on the straight line from one to the
/// next.
class Follower {
public:
    /// Throws Error{usage} where the method cannot step the scene.
    Follower(const Scene& scene, const Settings& settings, std::int64_t looks_per_second);

    /// Looks are asked for in order. False where the run has diverged.
    [[nodiscard]] bool go_to(std::int64_t look);
    [[nodiscard]] State<long double, 3> state(std::size_t row) const;
    /// In J.
    [[nodiscard]] double energy() const;
    [[nodiscard]] const Bodies& bodies() const { return world_.bodies(); }

private:
    void remember();

    World world_;
    std::int64_t looks_per_second_;
    std::int64_t before_tick_ = -1;
    long double alpha_ = 0;
    std::vector<State<long double, 3>> before_;
    double energy_before_ = 0;
};

}  // namespace oiler::lab
