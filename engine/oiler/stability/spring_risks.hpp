// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/preflight.hpp"

namespace oiler {

/// Adds the springs, dampers and linear drag that are outside the region: one risk per body without
/// links and one per component of linked bodies.
void add_spring_risks(const Bodies& bodies, Region& region, double dt, std::vector<Risk>& risks);

/// Whether upper bounds of all springs show that no motion of the bodies is outside the region, in
/// whatever direction their springs turn.
[[nodiscard]] bool contains_all_springs(const Bodies& bodies, Region& region, double dt);

/// The factor on the step up to which the risk's bodies are stable; 0 if they never are.
[[nodiscard]] double spring_limit(const Risk& risk, const Method& method, Damping damping,
                                  double dt);

}  // namespace oiler
