// SPDX-License-Identifier: MIT
#include "bench/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace oiler::bench {
namespace {

double seconds_of(const Work& work, long times) {
    const auto start = std::chrono::steady_clock::now();
    work(times);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The number of times that make a repetition; also warms up.
long times_for(const Work& work, double seconds) {
    long times = 1;
    for (;;) {
        const double took = seconds_of(work, times);
        if (took >= seconds) return times;
        const double more = took > 0 ? 1.2 * seconds / took : 10.0;
        times =
            static_cast<long>(std::ceil(static_cast<double>(times) * std::clamp(more, 1.2, 10.0)));
    }
}

}  // namespace

std::vector<double> race(const std::vector<Work>& work, const Effort& effort) {
    std::vector<long> times;
    for (const Work& one : work) times.push_back(times_for(one, effort.seconds));
    std::vector<double> least(work.size(), INFINITY);
    std::vector<double> spent(work.size());
    for (int repetition = 0; repetition < effort.repetitions; ++repetition)
        for (std::size_t i = 0; i < work.size(); ++i) {
            if (spent[i] > effort.patience) continue;
            if (effort.prepared) work[i](1);
            const double took = seconds_of(work[i], times[i]);
            spent[i] += took;
            least[i] = std::min(least[i], took / static_cast<double>(times[i]));
        }
    return least;
}

}  // namespace oiler::bench
