// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/preflight.hpp"

namespace oiler {

/// Adds the bodies that an attractor pulls faster than the method follows. If one attractor is the
/// only force on a body that returns, 20 revolutions are tried. Else the local frequency √(2gm/r³)
/// of radial motion decides, at the present distance or at the closest point of a known orbit.
/// Bodies on an attractor are added for every method.
void add_attractor_risks(const Bodies& bodies, Region& region, const Rate& rate,
                         std::vector<Risk>& risks);

/// The factor on dt below which an orbit is followed, by descent in steps of 15 % to the first of
/// four in a row; 0 if it is below 10⁻⁴.
[[nodiscard]] double orbit_limit(const Orbit& orbit, const Method& method, Damping damping,
                                 const Rate& rate);

}  // namespace oiler
