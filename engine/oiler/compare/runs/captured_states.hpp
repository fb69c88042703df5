// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oiler/compare/captures/captured.hpp"
#include "oiler/compare/runs/state_log.hpp"

namespace oiler {

/// The states of a capture's frames that have a record, in three axes. Bodies are numbered by their
/// names: those of `names` first, then new ones. Throws Error{usage} if no frame has a record.
[[nodiscard]] StateLog state_log_of(const Captured& captured, std::vector<std::string> names);

/// Removes the ticks that only one log has, up to the end of the shorter one: frames at other times
/// show other ticks. Throws Error{usage} if no tick is left.
void keep_common_ticks(StateLog& a, StateLog& b);

/// The first tick whose state hashes differ; empty if they are equal as far as both captures go. In
/// a capture of more than 1000 bodies, only frames have hashes.
[[nodiscard]] std::optional<std::int64_t> first_different_tick(const Captured& a,
                                                               const Captured& b);

}  // namespace oiler
