// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {

/// All of a trade-off, in part or whole, with what decides on it; null is what is unknown.
[[nodiscard]] std::string to_json(const Tradeoff& tradeoff);

/// Numbers read back to the same bits. Throws Error{usage} where the text is no trade-off of this
/// version; `file` is for the message.
[[nodiscard]] Tradeoff parse_tradeoff(std::string_view text, std::string_view file);

/// A line for each row, after one of names.
[[nodiscard]] std::string to_csv(const Tradeoff& tradeoff);

/// Of all that decides on a sweep's errors: two sweeps with the same one have the same errors.
[[nodiscard]] std::string fingerprint(std::string_view scene_text, const Scene& scene,
                                      const Looks& looks, const SweepPlan& plan);

}  // namespace oiler::lab
