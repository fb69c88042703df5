// SPDX-License-Identifier: MIT
#include "trap/system.hpp"
#include "oiler/sim/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oiler::trap {

bool System::is_linear() const {
    return attractors.empty() &&
           std::ranges::all_of(springs, [](const auto& one) { return one.rest_length == 0; }) &&
           std::ranges::all_of(bodies, [](const auto& one) { return one.quadratic_drag == 0; });
}

Real System::shortest_spring_period() const {
    std::vector<Real> stiffness(bodies.size(), 0);
    for (const CoupledSpring& spring : springs) {
        stiffness[spring.body] += spring.to ? 2 * spring.stiffness : spring.stiffness;
        if (spring.to) stiffness[*spring.to] += 2 * spring.stiffness;
    }
    // Gershgorin's circles bound the squares of the frequencies.
    Real largest = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        largest = std::max(largest, stiffness[i] / bodies[i].mass);
    if (largest == 0) return std::numeric_limits<Real>::infinity();
    return 2 * std::acos(Real(-1)) / std::sqrt(largest);
}

}  // namespace oiler::trap
