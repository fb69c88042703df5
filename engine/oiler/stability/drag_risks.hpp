// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/preflight.hpp"

namespace oiler {

/// Adds the bodies whose quadratic drag is too strong for the method: bodies that diverge alone in
/// a trial of 512 steps, and falling bodies whose terminal speed is not stable. The speed alone
/// decides for linked and attracted bodies, and beyond 10,000 trials.
void add_drag_risks(const Bodies& bodies, Region& region, const Steps& steps,
                    std::vector<Risk>& risks);

/// The factor on dt up to which the body of a risk of quadratic drag does not diverge.
[[nodiscard]] double drag_limit(const Risk& risk, const Method& method, const Steps& steps);

/// The largest c·|v|·dt at which no step makes a body faster; infinite if there is none below 1000.
[[nodiscard]] double quadratic_drag_limit(const Method& method, Damping damping);

}  // namespace oiler
