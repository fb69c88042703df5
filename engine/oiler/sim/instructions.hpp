// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace oiler {

/// A line for a user whose machine lacks every set of instructions that this build has kernels for,
/// so that steps take several times as long.
[[nodiscard]] std::optional<std::string> missing_instructions();

}  // namespace oiler
