// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "bench/report.hpp"

namespace oiler::bench {

/// Draws the cost of a step over the number of bodies, beside the limits of this machine: one PNG
/// per measured scene, in float and three axes. Draws bounces if they were measured.
void draw_plots(const Report& report, const std::filesystem::path& folder);

}  // namespace oiler::bench
