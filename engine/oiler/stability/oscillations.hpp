// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler {

/// The oscillation of a body on its springs, or of two bodies on their link.
struct BodyOscillation {
    std::size_t row;
    std::optional<std::size_t> linked;  ///< the other row
    Oscillation of;
};

/// The oscillations of a scene: one per body without links and one per link, with all springs and
/// dampers in it. With `dampers_split`, dampers along a line are left out, because the method
/// applies them separately. A body without links oscillates with the sum of its springs. No mode of
/// linked bodies is faster than the fastest link with all springs at its two ends: ω² ≤ Σk/m₁ +
/// Σk/m₂ (Anderson and Morley, Eigenvalues of the Laplacian of a graph, 1985, with masses).
[[nodiscard]] std::vector<BodyOscillation> oscillations(const Bodies& bodies, bool dampers_split);

}  // namespace oiler
