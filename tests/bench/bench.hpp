// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/limits.hpp"
#include "bench/measure.hpp"
#include "bench/report.hpp"

namespace oiler::bench {

/// One run of the benchmark: what it is to measure, how thoroughly, and what came of it.
struct Bench {
    bool full = false;         ///< the campaign, minutes; else a minute
    bool all_methods = false;  ///< else some that stand for the others
    bool quiet = false;
    std::string only{};  ///< regular expression; empty: everything
    Limits limits{};
    Effort effort{};
    Report report{};

    /// Whether something of this name is to be measured; tells the terminal that it is.
    [[nodiscard]] bool wants(std::string_view name) const;
    /// ns each of `per` parts of a piece of work, from seconds of all.
    [[nodiscard]] static double ns(double seconds, double per) { return seconds / per * 1e9; }
    /// As many bodies as no cache holds.
    [[nodiscard]] std::size_t memory_bodies() const { return full ? 10'000'000 : 4'000'000; }
};

void bench_limits(Bench& bench);
void bench_agreement(Bench& bench);
void bench_steps(Bench& bench);
void bench_methods(Bench& bench);
void bench_threads(Bench& bench);
void bench_settled(Bench& bench);
void bench_nets(Bench& bench);
void bench_entities(Bench& bench);
void bench_memory(Bench& bench);
void bench_loop(Bench& bench);
void bench_frames(Bench& bench);
void bench_peers(Bench& bench);

}  // namespace oiler::bench
