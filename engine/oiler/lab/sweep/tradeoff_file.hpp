// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {

/// A complete or partial trade-off as JSON. Unknown numbers are null.
[[nodiscard]] std::string to_json(const Tradeoff& tradeoff);

/// Reads to_json's text; numbers keep their bits. Throws Error{usage} with the file, the field and
/// a remedy if the text is not a trade-off of this version, if a field is missing or out of range,
/// or if fields contradict each other.
[[nodiscard]] Tradeoff parse_tradeoff(std::string_view text, std::string_view file);

/// A header line, and one line per row.
[[nodiscard]] std::string to_csv(const Tradeoff& tradeoff);

/// A hash of everything that determines a sweep's errors. Sweeps with equal fingerprints have equal
/// errors.
[[nodiscard]] std::string fingerprint(std::string_view scene_text, const Scene& scene,
                                      const SweepPlan& plan);

}  // namespace oiler::lab
