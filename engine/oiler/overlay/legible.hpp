// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/overlay/overlays.hpp"

namespace oiler {

/// Enlarges the illegible labels of a game in an area of that size: to at most twice their size,
/// not beyond the edges of the area, and not into each other or the swatches of legends.
void keep_legible(Picture& picture, const OverlayArea& area);

}  // namespace oiler
