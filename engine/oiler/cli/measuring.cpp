// SPDX-License-Identifier: MIT
#include "oiler/cli/measuring.hpp"

#include <algorithm>
#include <vector>

#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

using namespace lab;

void Percent::operator()(double fraction) {
    const double share = std::min(1.0, fraction);
    progress_.show(static_cast<std::int64_t>(share * double{whole}));
    if (is_silent_ || progress_.is_visible()) return;
    const std::string line = describe_long_work(work_, progress_.passed(), share);
    is_silent_ = !line.empty();
    remark(line.empty(), "{}", line);
}

Reference measure_reference(const Scene& scene, double wanted, bool quiet) {
    Percent percent(quiet, "of the work limit of the reference");
    return make_reference(
        scene, {.wanted = wanted, .progress = std::ref(percent), .stopped = Interrupt::requested});
}

void measure_tradeoff(Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
                      const SweepPlan& plan, bool quiet,
                      const std::function<void(const Tradeoff&)>& series_done) {
    SweepWatch watch{.stopped = Interrupt::requested, .series_done = series_done};
    {
        Percent percent(quiet, "of the errors");
        watch.progress = std::ref(percent);
        sweep(tradeoff, scene, reference, plan, watch);
    }
    constexpr int rounds = 7;
    Percent percent(quiet, "of the times");
    watch.progress = std::ref(percent);
    std::vector<TradeoffRow*> rows;
    for (RateSeries& series : tradeoff.all_series)
        for (TradeoffRow& row : series.rows) rows.push_back(&row);
    time_rows(scene, rows, rounds, watch);
}

Advice find_advice(const Scene& scene, const Reference& reference, const Requirements& requirements,
                   bool quiet) {
    Percent percent(quiet, "of the settings, most of which need no run");
    return advise(scene, reference, requirements,
                  {.progress = std::ref(percent), .stopped = Interrupt::requested});
}

}  // namespace oiler::cli
