// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/limits.hpp"
#include "bench/measure.hpp"
#include "bench/report.hpp"

namespace oiler::bench {

/// One run of the benchmark: its options and its report.
struct Bench {
    bool full = false;         ///< the campaign, some minutes instead of one
    bool all_methods = false;  ///< otherwise a representative few
    bool quiet = false;
    std::string only{};  ///< regular expression; empty for everything
    Limits limits{};
    Effort effort{};
    Report report{};

    /// Whether to measure something of this name; if so, shows it on the terminal.
    [[nodiscard]] bool wants(std::string_view name) const;
    /// Converts the seconds of some work to ns for each of its `per` parts.
    [[nodiscard]] static double ns(double seconds, double per) { return seconds / per * 1e9; }
    /// A number of bodies that exceeds every cache.
    [[nodiscard]] std::size_t memory_bodies() const { return full ? 10'000'000 : 4'000'000; }
};

void bench_limits(Bench& bench);
void bench_agreement(Bench& bench);
void bench_steps(Bench& bench);
void bench_methods(Bench& bench);
void bench_prices(Bench& bench);
void bench_threads(Bench& bench);
void bench_settled(Bench& bench);
void bench_nets(Bench& bench);
void bench_entities(Bench& bench);
void bench_memory(Bench& bench);
void bench_loop(Bench& bench);
void bench_frames(Bench& bench);
void bench_peers(Bench& bench);
void bench_bounces(Bench& bench);
void bench_bounce_costs(Bench& bench);

}  // namespace oiler::bench
