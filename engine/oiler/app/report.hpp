// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/core/budget_entry.hpp"
#include "oiler/game/loop.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Results of a run that its world does not hold.
struct RunReport {
    std::int64_t steps = 0;  ///< of the loop
    std::string_view scene;
    Energy first;
    std::optional<Energy> last{};  ///< empty if the run diverged
    std::uint64_t state_hash = 0;
    std::vector<Reading> readings{};  ///< of the game, at the end; empty if the run diverged
    std::string divergence{};         ///< its message; empty if the run did not diverge
    std::chrono::nanoseconds dropped{0};
    std::chrono::nanoseconds wall{0};
    std::vector<BudgetEntry> budget{};
};

/// Writes and commits JSON. After a divergence, the time is that of the last finite steps that are
/// known, and state and last energy are null. Throws Error{io}.
void write_report(File& file, const RunReport& report, const World& world);

}  // namespace oiler
