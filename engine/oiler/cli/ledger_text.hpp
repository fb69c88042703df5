// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "oiler/lab/ledger/ledger.hpp"

namespace oiler::cli {

/// Returns the printed form of a ledger. `name` is the scene file's, `wanted` the number of steps
/// asked for.
[[nodiscard]] std::string ledger_text(const Scene& scene, const std::string& name,
                                      const lab::Ledger& ledger, std::int64_t wanted);

}  // namespace oiler::cli
