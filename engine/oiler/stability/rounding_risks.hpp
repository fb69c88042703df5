// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/preflight.hpp"

namespace oiler {

/// Adds moving bodies whose position in float does not change for 64 steps, because its steps are
/// shorter than half of its last place. Axes with less than a thousandth of the speed are left out,
/// and so are forces of links.
void add_rounding_risks(const Bodies& bodies, const Method& method, double dt,
                        std::vector<Risk>& risks);

}  // namespace oiler
