// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// What a player notices, by a method at each of the rates; unknown where it has none, say because
/// the run is unstable.
struct RatesLine {
    const Method* method = nullptr;
    std::vector<double> values{};
    /// From the least to the largest value, of the true one or, where that is 0, of the largest: in
    /// percent.
    double spread_percent = unknown;
};

/// One thing that a player notices of a body.
struct RatesQuantity {
    std::string name;  ///< "apex"
    std::string unit;  ///< "m"
    double truth = unknown;
    std::vector<RatesLine> lines{};
};

struct Rates {
    std::string body;  ///< its name in the scene, or "body 3"
    std::vector<std::int64_t> rates{};
    std::vector<RatesQuantity> quantities{};
};

/// Runs the scene in its own precision with each method at each rate and measures what is drawn:
/// straight lines between steps. Apex, its time, time and place of landing where there is gravity;
/// period, amplitude at the end and the time to settle to a twentieth where the body swings. Only
/// what the exact motion has.
[[nodiscard]] Rates measure_rates(const Scene& scene, const Reference& reference, std::size_t row,
                                  const std::vector<std::int64_t>& rates,
                                  const std::vector<const Method*>& methods,
                                  const std::function<bool()>& stopped);

/// The row of the body that oscillates most; 0 where none does.
[[nodiscard]] std::size_t most_oscillating_row(const Reference& reference);

/// The row of the body that is called so, or has that number from 0 on. Throws Error{usage}.
[[nodiscard]] std::size_t find_body(const Scene& scene, const std::string& name);

}  // namespace oiler::lab
