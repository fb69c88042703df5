// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/app/options.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

/// Compares the frames in `options.out` with the golden, prints the cause of a change, and writes
/// the page of differences beside the frames. Returns Exit::comparison_failed if a frame changed.
/// Throws Error.
[[nodiscard]] Exit compare_with_golden(const Options& options);

}  // namespace oiler
