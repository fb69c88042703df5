// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "oiler/lab/reference/reference.hpp"

namespace oiler::lab {

/// The energy of a scene's true motion.
class TrueEnergy {
public:
    TrueEnergy(const Scene& scene, const Reference& reference);

    /// The energy at a time (s), J.
    [[nodiscard]] double at(long double t);
    /// The energy in states of the true motion, J.
    [[nodiscard]] double of(std::span<const State<long double, 3>> states);

private:
    const Reference& reference_;
    Bodies bodies_;
    std::vector<State<long double, 3>> states_;
    double at_start_;  ///< J
};

}  // namespace oiler::lab
