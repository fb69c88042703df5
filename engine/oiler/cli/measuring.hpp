// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/process/console.hpp"

namespace oiler::cli {

// The long measurements of a scene, with their progress on standard error.

/// Shows a fraction of the work as a percentage, in a line where no progress bar is visible.
class Percent {
public:
    Percent(bool quiet, const std::string& work)
        : work_(work), progress_(quiet, "% " + work, whole), is_silent_(quiet) {}
    void operator()(double fraction);

private:
    static constexpr std::int64_t whole = 100;
    std::string work_;
    Progress progress_;
    bool is_silent_;  ///< also once the line is printed
};

/// Measures the errors that the trade-off lacks, then the times of all its rows.
void measure_tradeoff(
    lab::Tradeoff& tradeoff, const Scene& scene, const lab::Reference& reference,
    const lab::SweepPlan& plan, bool quiet,
    const std::function<void(const lab::Tradeoff&)>& series_done = [](const auto&) {});

/// Searches for the cheapest setting.
[[nodiscard]] lab::Advice find_advice(const Scene& scene, const lab::Reference& reference,
                                      const lab::Requirements& requirements, bool quiet);

/// Computes a scene's reference. `wanted` is the error to reach in m, 0 for the smallest.
[[nodiscard]] lab::Reference measure_reference(const Scene& scene, double wanted, bool quiet);

}  // namespace oiler::cli
