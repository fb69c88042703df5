// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include "oiler/world/world.hpp"

namespace oiler {

/// The scale of energy changes, as in the lab: the larger of the largest kinetic energy and the
/// range of the potential energy so far.
class EnergyScale {
public:
    void add(const Energy& energy) {
        kinetic_ = std::max(kinetic_, energy.kinetic);
        lowest_ = std::min(lowest_, energy.potential);
        highest_ = std::max(highest_, energy.potential);
    }
    /// J; 0 if nothing was added.
    [[nodiscard]] double joules() const { return std::max(kinetic_, highest_ - lowest_); }
    [[nodiscard]] bool is_kinetic() const { return kinetic_ >= highest_ - lowest_; }

private:
    double kinetic_ = 0;
    double lowest_ = std::numeric_limits<double>::infinity();
    double highest_ = -std::numeric_limits<double>::infinity();
};

/// The kinetic energy of bodies that move by ten last places of their coordinates per step, J, or
/// ten last places of the energy itself if they are more. A smaller scale is only round-off.
[[nodiscard]] double round_off_energy(const World& world);

/// The scale of the energy changes of a world, J; 0 if it is only round-off.
[[nodiscard]] double joules_of(const EnergyScale& scale, const World& world);

}  // namespace oiler
