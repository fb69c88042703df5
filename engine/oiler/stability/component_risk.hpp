// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/stability/component.hpp"
#include "oiler/stability/preflight.hpp"

namespace oiler {

/// Tests the stability of a component with the region's method. The test of few
/// bodies is exact: by the eigenvalues of the stiffness matrix up to 100 freedoms if damping is
/// even, else by those of the step up to 30. Larger components are tested at their fastest
/// oscillation and, if damping is uneven, where stiffness and damping are most uneven.
[[nodiscard]] std::optional<Risk> find_risk(Component component, Region& region, double dt);

/// The factor on dt up to which the steps of a component are stable, to 7 digits; 0 if it is below
/// 10⁻⁷.
[[nodiscard]] double component_limit(const Component& component, const Method& method,
                                     Damping damping, double dt);

}  // namespace oiler
