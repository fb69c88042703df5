// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

#include "oiler/sim/bodies.hpp"

namespace oiler {

/// The scale of energy changes, as in the lab: the larger of the largest kinetic energy and the
/// range of the potential energy so far.
struct EnergyScale {
    double begin = -1;  ///< s, since when
    double kinetic = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();

    /// J, with a further energy
    double with(const Energy& energy) {
        kinetic = std::max(kinetic, energy.kinetic);
        lowest = std::min(lowest, energy.potential);
        highest = std::max(highest, energy.potential);
        return std::max(kinetic, highest - lowest);
    }
};

}  // namespace oiler
