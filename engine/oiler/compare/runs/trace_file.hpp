// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "oiler/compare/runs/state_log.hpp"

namespace oiler {

/// Reads a trace, the CSV file of `--trace`. Throws Error(Exit::usage) with file and line if it is
/// malformed or has no rows, and Error(Exit::io) if it cannot be read.
[[nodiscard]] StateLog read_trace(const std::filesystem::path& path);

}  // namespace oiler
