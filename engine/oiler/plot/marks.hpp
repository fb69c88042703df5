// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/plot/plot.hpp"

namespace oiler {

/// The series' mark on the canvas; nothing of the curve below it shows through.
void draw_mark(const Series& series, Point at, Picture& picture);

/// A line of the series, which is on the canvas: whole with its key, or in dashes without one.
void draw_line(const Series& series, const Polyline& whole, Picture& picture);

}  // namespace oiler
