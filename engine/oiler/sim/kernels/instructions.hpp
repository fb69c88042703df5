// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace oiler {

/// A remark for a user whose machine lacks all instruction sets of this build's kernels, so that
/// steps take several times as long. Empty if the machine has one, or the build has none.
[[nodiscard]] std::optional<std::string> missing_instructions();

}  // namespace oiler
