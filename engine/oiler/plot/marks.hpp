// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/plot/plot.hpp"

namespace oiler {

/// Draws the series' mark on the canvas. It hides the curve below it.
void draw_mark(const Series& series, Point at, Picture& picture);

/// Draws a line of the series on the canvas: solid with its key, or dashed without a key.
void draw_line(const Series& series, const Polyline& whole, Picture& picture);

}  // namespace oiler
