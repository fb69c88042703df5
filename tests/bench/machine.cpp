// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

/// The bandwidth of one level of memory, in bytes per ns = GB/s.
void measure_place(Bench& bench, const std::string& place, std::size_t rows) {
    const HandBodies<float> swept(3, rows);
    const std::vector<float> numbers(swept.scene().rows * 6);
    const HandLoops<float>& loops = bench.limits.loops<float>();
    float factor = 1;
    const auto read = [&](long times) {
        for (long i = 0; i < times; ++i) keep(loops.read(numbers.data(), numbers.size()));
    };
    const auto sweep = [&](long times) {
        for (long i = 0; i < times; ++i) {
            keep(factor);
            loops.sweep(swept.scene(), factor);
        }
    };
    const std::vector<double> seconds = race({read, sweep}, bench.effort);
    const double bytes = static_cast<double>(numbers.size() * sizeof(float));
    bench.report.add("Bandwidth of one core, GB/s",
                     {place,
                      {{"read", bytes / seconds[0] * 1e-9},
                       {"read and write in place", 2 * bytes / seconds[1] * 1e-9}}});
}

}  // namespace

void bench_limits(Bench& bench) {
    if (!bench.wants("bandwidth")) return;
    measure_place(bench, "L1, 24 KB", 1024);
    measure_place(bench, "L2, 480 KB", 20'480);
    measure_place(bench, fmt::format("memory, {} MB", bench.memory_bodies() * 24 / 1'000'000),
                  bench.memory_bodies());
}

}  // namespace oiler::bench
