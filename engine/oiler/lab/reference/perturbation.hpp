// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/scene/make_world.hpp"

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

}  // namespace oiler::lab
