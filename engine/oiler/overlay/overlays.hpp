// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oiler/overlay/overlay_area.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/whatif/verdict.hpp"

namespace oiler {

/// Adds what the loop does at the moment, such as a pause, at the lower right; nothing if empty.
void add_status(Picture& overlay, const OverlayArea& area, std::string status);

[[nodiscard]] Colour colour_of(Verdict::Grade grade);

/// The height of the band that a verdict takes at the top, pixels: it depends on the area only, so
/// that no picture moves when a verdict changes.
[[nodiscard]] int verdict_height(const OverlayArea& area);

/// Adds a band across the top with a mark in the colour of its grade, and with lines of text that
/// fit into it.
void add_verdict(Picture& overlay, const OverlayArea& area, const Verdict& verdict);

/// Adds a sheet that says what happened, and what is left to do.
void add_notice(Picture& overlay, const OverlayArea& area, const std::string& text,
                const std::string& remedy);

/// Enlarges the labels of a game that nobody could read in an area of that size, at most twice and
/// not beyond its edges.
void keep_legible(Picture& picture, const OverlayArea& area);

}  // namespace oiler
