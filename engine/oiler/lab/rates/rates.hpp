// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oiler/core/json.hpp"
#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// The values of a quantity by one method at each rate. A value is `unknown` if the run is unstable
/// or does not show the quantity.
struct RatesLine {
    const Method* method = nullptr;
    std::vector<double> values{};
    /// (largest − smallest)/|truth|, in percent; relative to the largest magnitude if the truth is
    /// 0.
    double spread_percent = unknown;
};

/// A quantity of a body's motion that a player notices.
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

/// Runs the scene in its own precision with each method at each rate. Measures the drawn motion:
/// straight lines between steps. With gravity: apex, its time, time and place of landing. With a
/// floor: first impact, heights of bounces, the time at which these stay low. For an oscillating
/// body: period, amplitude at the end; without one period, the mean period and half of the range.
/// For one that comes to rest: time to settle to 5 % of its largest distance from there, overshoot.
/// Quantities that the exact motion does not have are left out.
[[nodiscard]] Rates measure_rates(const Scene& scene, const Reference& reference, std::size_t row,
                                  const std::vector<std::int64_t>& rates,
                                  const std::vector<const Method*>& methods,
                                  const std::function<bool()>& stopped);

[[nodiscard]] Json to_json(const Rates& rates);

/// The row of the body that oscillates most; 0 if none oscillates.
[[nodiscard]] std::size_t most_oscillating_row(const Reference& reference);

/// The row of the body with that name, or with that index, from 0. Throws Error{usage}.
[[nodiscard]] std::size_t find_body(const Scene& scene, const std::string& name);

}  // namespace oiler::lab
