// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {
class Bodies;
}

namespace oiler::lab {

/// An upper bound of the angular frequencies and rates of decay of the bodies' motion, 1/s: of
/// springs, links, drag at the present and at the terminal speed, and of attractors at the closest
/// point of an orbit around one attractor, else at the present distance.
[[nodiscard]] double fastest_motion(const Bodies& bodies);

}  // namespace oiler::lab
