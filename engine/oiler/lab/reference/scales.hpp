// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "oiler/lab/reference/motion.hpp"

namespace oiler {
class Bodies;
}

namespace oiler::lab {

/// The sizes of a motion, by which errors are judged.
struct Scales {
    double extent = 0;      ///< m, the largest distance of any body from its start
    double energy = 0;      ///< J, the larger of the largest kinetic energy and the range of the
                            ///< potential energy
    double coordinate = 0;  ///< m, the largest coordinate
    double speed = 0;       ///< m/s, the largest component of a velocity
};

/// The scales of a motion over increasing times (s) from 0. `bodies` are those of the scene.
[[nodiscard]] Scales scales_of(const Motion& motion, const std::vector<double>& times,
                               Bodies bodies);

/// Times up to `until` (s) that show the extremes of a motion: close together at the start, where
/// the fastest motion (1/s) may decay, then off any regular grid. For many bodies there are fewer.
[[nodiscard]] std::vector<double> probe_times(double until, double fastest, std::size_t bodies);

/// Whether no force on the bodies takes or gives energy.
[[nodiscard]] bool is_conservative(const Bodies& bodies);

/// An upper bound of the angular frequencies and rates of decay of the bodies' motion, 1/s: of
/// springs, links, drag at the present and at the terminal speed, and of attractors at the closest
/// point of an orbit around one attractor, else at the present distance.
[[nodiscard]] double fastest_motion(const Bodies& bodies);

}  // namespace oiler::lab
