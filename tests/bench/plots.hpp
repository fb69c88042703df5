// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "bench/report.hpp"

namespace oiler::bench {

/// What a step costs over how many bodies there are, beside the limits of this machine: a PNG for
/// each scene that was measured, in float and three axes.
void draw_plots(const Report& report, const std::filesystem::path& folder);

}  // namespace oiler::bench
