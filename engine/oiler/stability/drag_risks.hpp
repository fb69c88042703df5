// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/preflight.hpp"

namespace oiler {

/// Adds the bodies whose quadratic drag is too strong for the method: bodies that a step at their
/// present speed makes faster, and falling bodies whose terminal speed is not stable.
void add_drag_risks(const Bodies& bodies, Region& region, double dt, std::vector<Risk>& risks);

/// The largest c·|v|·dt at which no step makes a body faster; infinite if there is none below 1000.
[[nodiscard]] double quadratic_drag_limit(const Method& method, Damping damping);

}  // namespace oiler
