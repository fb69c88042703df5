// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/core/json.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {

// The results of a sweep as JSON, for files and pages. Unknown numbers are null.

/// A measured number of a row and its name in files.
struct RowNumber {
    const char* name;
    double& (*of)(TradeoffRow& row);
};
inline constexpr RowNumber row_numbers[]{
    {"position_error", [](TradeoffRow& row) -> double& { return row.judgement.position_error; }},
    {"step_error", [](TradeoffRow& row) -> double& { return row.judgement.step_error; }},
    {"velocity_error", [](TradeoffRow& row) -> double& { return row.judgement.velocity_error; }},
    {"phase_error", [](TradeoffRow& row) -> double& { return row.judgement.phase_error; }},
    {"energy_drift", [](TradeoffRow& row) -> double& { return row.judgement.energy_drift; }},
    {"evaluations", [](TradeoffRow& row) -> double& { return row.judgement.evaluations; }},
    {"ns_per_second", [](TradeoffRow& row) -> double& { return row.ns_per_second; }},
    {"ns_spread", [](TradeoffRow& row) -> double& { return row.ns_spread; }},
    {"ns_together", [](TradeoffRow& row) -> double& { return row.ns_together; }},
};

/// The value, or null if it is not finite.
[[nodiscard]] Json number_or_null(double value);
[[nodiscard]] Json json_of(const ReferenceSummary& reference);
[[nodiscard]] Json json_of(const TradeoffRow& row);
[[nodiscard]] Json json_of(const Tradeoff& tradeoff);

}  // namespace oiler::lab
