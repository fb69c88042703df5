// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// The layer of what the loop draws: over all that games draw.
inline constexpr int overlay_layer = std::numeric_limits<int>::max();

/// A part of a window that the loop draws over. Points are in units of the canvas; the part reaches
/// beyond the canvas where it is not 16:9.
struct OverlayArea {
    explicit OverlayArea(Size pixels);

    /// The size of a font, or the least one that can be read.
    [[nodiscard]] float legible(float size) const;

    Point low;     ///< lower left corner
    Point high;    ///< upper right corner
    float pixels;  ///< of a unit
};

}  // namespace oiler
