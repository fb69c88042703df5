// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>

#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/process/console.hpp"

namespace oiler::cli {

// The long measurements of a scene, with their progress on standard error.

/// Shows a fraction of the work as a percentage.
class Percent {
public:
    Percent(bool quiet, const std::string& work) : progress_(quiet, "% " + work, whole) {}
    void operator()(double fraction) {
        progress_.show(static_cast<std::int64_t>(std::min(1.0, fraction) * double{whole}));
    }

private:
    static constexpr std::int64_t whole = 100;
    Progress progress_;
};

/// Measures the errors that the trade-off lacks, then the times of all its rows.
void measure_tradeoff(
    lab::Tradeoff& tradeoff, const Scene& scene, const lab::Reference& reference,
    const lab::SweepPlan& plan, bool quiet,
    const std::function<void(const lab::Tradeoff&)>& series_done = [](const auto&) {});

/// Computes a scene's reference. `wanted` is the error to reach in m, 0 for the smallest.
[[nodiscard]] lab::Reference measure_reference(const Scene& scene, double wanted, bool quiet);

}  // namespace oiler::cli
