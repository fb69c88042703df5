// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

#include "oiler/core/error.hpp"
#include "oiler/core/team.hpp"
#include "oiler/core/version.hpp"

namespace oiler::lab {
namespace {

struct SeriesRun {
    RateSeries& series;
    const Scene& scene;
    const Reference& reference;
    const SweepPlan& plan;
    const RunWork& work;
    const std::vector<std::int64_t>& rates;

    /// A stopped call leaves the series unchanged.
    void run(const std::function<bool()>& stopped) {
        std::vector<TradeoffRow> rows;
        std::string end = why_not(scene, Settings{choice(rates.back())});
        const double work_per_hertz = work.per_step(*series.method) * reference.meaningful_until;
        Convergence convergence(largest_converging_error * reference.extent);
        for (const std::int64_t rate : rates) {
            if (!end.empty()) break;
            if (work_per_hertz * static_cast<double>(rate) > plan.most_work) {
                end = "a run at higher rates is too much work";
                break;
            }
            rows.push_back({.stepping = choice(rate),
                            .judgement = judge(scene, Settings{choice(rate)}, reference,
                                               {.stopped = stopped})});
            if (stopped()) return;
            const Judgement& judgement = rows.back().judgement;
            if (!judgement.stable) continue;
            convergence.take(judgement.position_error);
            end = why_ended(rows.back(), convergence, stopped);
        }
        series.rows = std::move(rows);
        series.end = end.empty() ? "the highest rate of the sweep was reached" : end;
        series.done = true;
    }

private:
    /// Why higher rates are not worth a run; empty if they are.
    [[nodiscard]] std::string why_ended(const TradeoffRow& row, Convergence& convergence,
                                        const std::function<bool()>& stopped) const {
        const Judgement& judgement = row.judgement;
        if (judgement.below_floor()) return "smaller errors are below the reference's floor";
        if (only_lines(judgement))
            return "smaller errors are those of the drawn lines, equal for all methods";
        if (!convergence.stalled()) return "";
        if (is_round_off(scene, row, reference, stopped))
            return "round-off keeps errors from falling";
        convergence.restart();
        return "";
    }
    /// Whether drawn lines are almost exact and cause almost all of the error.
    [[nodiscard]] bool only_lines(const Judgement& judgement) const {
        constexpr double exact = 1e-6;  // of the extent
        constexpr double little = 0.01;
        return judgement.position_error < exact * reference.extent &&
               !(judgement.step_error > little * judgement.position_error);
    }
    [[nodiscard]] Stepping choice(std::int64_t rate) const {
        return {series.method, {rate}, series.precision};
    }
};

/// Calls task(i, stopped) for each i below `count`. If one throws, all stop and the exception is
/// rethrown.
template <class Task>
void on_all_cores(std::size_t count, const std::function<bool()>& asked_to_stop, Task task) {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> failed = false;
    std::mutex mutex;
    std::exception_ptr failure;
    const std::function<bool()> stopped = [&] { return failed || asked_to_stop(); };
    const auto work = [&] {
        try {
            for (std::size_t i = next++; i < count && !stopped(); i = next++) task(i, stopped);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
            failed = true;
        }
    };
    {
        std::vector<std::jthread> others;
        start_threads(others, static_cast<std::size_t>(this_machine().cores - 1),
                      [&](std::size_t) { work(); });
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

/// The default resolves the scene's fastest motion.
std::int64_t max_rate_of(const SweepPlan& plan, const Reference& reference) {
    constexpr std::int64_t highest = 1'000'000;
    constexpr std::int64_t usual = 1024 * 60;
    if (plan.max_rate > 0) return plan.max_rate;
    return std::min(highest, std::max(usual, 64 * reference.samples.per_second));
}

}  // namespace

Machine this_machine() {
    Machine machine{.cpu = "unknown",
                    .cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
                    .compiler = compiler()};
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("model name")) continue;
        machine.cpu = line.substr(std::min(line.size(), line.find(':') + 2));
        break;
    }
    return machine;
}

bool Tradeoff::complete() const { return std::ranges::all_of(all_series, &RateSeries::done); }

bool Tradeoff::timed() const {
    return std::ranges::all_of(rows(), [](const TradeoffRow* row) {
        return !row->judgement.stable || !std::isnan(row->ns_per_second);
    });
}

std::vector<const TradeoffRow*> Tradeoff::rows() const {
    std::vector<const TradeoffRow*> all;
    for (const RateSeries& series : all_series)
        for (const TradeoffRow& row : series.rows) all.push_back(&row);
    return all;
}

const TradeoffRow* Tradeoff::find(const Stepping& choice) const {
    for (const TradeoffRow* row : rows())
        if (row->stepping == choice) return row;
    return nullptr;
}

ReferenceSummary summary(const Reference& reference) {
    const Uncertainty floor = reference.floor();
    return {.words = reference.words,
            .closed_form = reference.closed_form,
            .position_error = floor.position / margin,
            .velocity_error = floor.velocity / margin,
            .floor = floor,
            .extent = reference.extent,
            .meaningful_until = reference.meaningful_until,
            .why_no_longer = reference.why_no_longer,
            .period = reference.oscillation ? reference.oscillation->period : unknown};
}

std::vector<const TradeoffRow*> pareto(const Tradeoff& tradeoff, Cost cost) {
    std::vector<const TradeoffRow*> rows;
    for (const TradeoffRow* row : tradeoff.rows())
        if (row->judgement.stable && std::isfinite(cost(*row))) rows.push_back(row);
    const auto error = [](const TradeoffRow* row) {
        return row->judgement.below_floor() ? 0 : row->judgement.position_error;
    };
    std::ranges::stable_sort(
        rows, {}, [&](const TradeoffRow* row) { return std::pair(cost(*row), error(row)); });
    std::vector<const TradeoffRow*> front;
    for (const TradeoffRow* row : rows)
        if (front.empty() || error(row) < error(front.back())) front.push_back(row);
    return front;
}

std::vector<std::int64_t> sweep_rates(const Scene& scene, std::int64_t max_rate) {
    constexpr std::int64_t usual = 60;
    std::set<std::int64_t> all;
    for (std::int64_t rate = 1; rate < usual; ++rate)
        if (usual % rate == 0) all.insert(rate);
    for (std::int64_t rate = usual; rate <= max_rate; rate *= 2) {
        all.insert(rate);
        if (rate * 3 / 2 <= max_rate) all.insert(rate / 2 * 3);
    }
    all.erase(all.upper_bound(max_rate), all.end());
    all.insert(scene.stepping.rate.steps);
    return {all.begin(), all.end()};
}

bool is_round_off(const Scene& scene, const TradeoffRow& row, const Reference& reference,
                  const std::function<bool()>& stopped) {
    Stepping exact = row.stepping;
    exact.precision = Precision::extended;
    const Judgement judgement = judge(scene, Settings{exact}, reference, {.stopped = stopped});
    return judgement.below_floor() || 2 * judgement.position_error < row.judgement.position_error;
}

Tradeoff start_tradeoff(const Scene& scene, const Reference& reference, const SweepPlan& plan) {
    Tradeoff tradeoff{.scene = {},
                      .title = scene.title,
                      .fingerprint = {},
                      .duration = scene.duration,
                      .current = scene.stepping,
                      .reference = summary(reference),
                      .machines = {this_machine()}};
    for (const Method* method : plan.methods)
        for (const Precision precision : plan.precisions)
            tradeoff.all_series.push_back({.method = method, .precision = precision});
    return tradeoff;
}

void sweep(Tradeoff& tradeoff, const Scene& scene, const Reference& reference,
           const SweepPlan& plan, const SweepWatch& watch) {
    const std::vector<std::int64_t> rates = sweep_rates(scene, max_rate_of(plan, reference));
    std::vector<std::size_t> open;
    for (auto i = static_cast<std::size_t>(plan.shard - 1); i < tradeoff.all_series.size();
         i += static_cast<std::size_t>(plan.shards))
        if (!tradeoff.all_series[i].done) open.push_back(i);
    const RunWork work(scene);
    double all = 0;
    for (const std::size_t i : open) all += work.per_step(*tradeoff.all_series[i].method);
    double done = 0;
    std::mutex mutex;
    on_all_cores(open.size(), watch.stopped, [&](std::size_t at, const auto& stopped) {
        RateSeries series = tradeoff.all_series[open[at]];
        SeriesRun{series, scene, reference, plan, work, rates}.run(stopped);
        if (!series.done) return;
        const std::lock_guard lock(mutex);
        done += work.per_step(*series.method);
        tradeoff.all_series[open[at]] = std::move(series);
        watch.series_done(tradeoff);
        watch.progress(done / all);
    });
}

}  // namespace oiler::lab
