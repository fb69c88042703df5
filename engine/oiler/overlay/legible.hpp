// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/overlay/overlays.hpp"

namespace oiler {

/// A text is no wider than this times its text_width().
inline constexpr float wider_letters = 1.06F;

/// Enlarges the illegible labels of a game in an area of that size: to at most twice their size,
/// not beyond the edges of the area, and not into each other or the swatches of legends.
void keep_legible(Picture& picture, const OverlayArea& area);

}  // namespace oiler
