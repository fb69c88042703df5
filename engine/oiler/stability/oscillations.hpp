// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler {

/// What may swing: a body on its springs, or two bodies on their link.
struct BodyOscillation {
    std::size_t row;
    std::optional<std::size_t> linked;  ///< the other row
    Oscillation of;
};

/// One for each body without links and one for each link, with all springs and dampers in it; or
/// without those that damp along a line, where a method takes these by themselves.
/// Bodies without links swing as their springs have it. No mode of linked ones is faster than the
/// fastest link with all that pulls at its two ends: ω² ≤ Σk/m₁ + Σk/m₂ (Anderson and Morley,
/// Eigenvalues of the Laplacian of a graph, 1985, with masses).
[[nodiscard]] std::vector<BodyOscillation> oscillations(const Bodies& bodies,
                                                        bool dampers_slow_apart);

}  // namespace oiler
