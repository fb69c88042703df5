// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/lab/advice/growth.hpp"
#include "oiler/scene/scene.hpp"

namespace oiler::lab {

/// The time after the measured one at which a run with the setting is farther than the tolerance
/// (m) from one with 8 times as many steps, s; infinite if it is not within the time that the law
/// of the growth gives it, or within some tenths of a second of computing.
[[nodiscard]] double passing_time(const Scene& scene, const Stepping& stepping,
                                  const Growth& growth, double tolerance);

}  // namespace oiler::lab
