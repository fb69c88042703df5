// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/core/json.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {

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
    {"ns_worst_frame", [](TradeoffRow& row) -> double& { return row.ns_worst_frame; }},
    {"ns_together", [](TradeoffRow& row) -> double& { return row.ns_together; }},
};

// The results of a sweep as JSON, for files and pages. Unknown numbers are null.
[[nodiscard]] Json to_json(const TradeoffRow& row);
[[nodiscard]] Json to_json(const Tradeoff& tradeoff);

/// The file of a complete or partial trade-off.
[[nodiscard]] std::string file_text(const Tradeoff& tradeoff);
/// Reads file_text's text; numbers keep their bits. Throws Error{usage} with the file, the field
/// and the remedy if the text is not a trade-off of this version, if a field is missing or out of
/// range, if fields contradict each other, or if a value was changed after it was measured.
[[nodiscard]] Tradeoff parse_tradeoff(std::string_view text, std::string_view file,
                                      std::string_view remedy = "measure again");

/// A header line, and one line per row.
[[nodiscard]] std::string to_csv(const Tradeoff& tradeoff);

/// A hash of everything that determines a sweep's errors. Sweeps with equal fingerprints have equal
/// errors.
[[nodiscard]] std::string fingerprint(std::string_view scene_text, const Scene& scene,
                                      const SweepPlan& plan);

}  // namespace oiler::lab
