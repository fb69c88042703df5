// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/search.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"

namespace oiler::lab {
namespace {

/// The fraction of a tolerance that a row must leave unused.
constexpr double safety_margin = 0.02;
/// Settings that are estimated to cost up to this multiple of the best are tried and timed.
constexpr double rival_cost_ratio = 1.3;
/// A runner-up of another method is sought up to this multiple of the best's cost.
constexpr double runner_up_cost_ratio = 2;
constexpr std::size_t most_refined = 4;

double share_of(double error, const std::optional<double>& tolerance) {
    return tolerance && !std::isnan(error) ? error / *tolerance : 0;
}

/// The largest distance of a coordinate from the nearest float, m, at whole seconds. All rates have
/// a step there, and no run in float has a smaller error.
double rounding_to_float(const Reference& reference) {
    long double most = 0;
    for (std::int64_t sample = 0; sample < reference.samples.count;
         sample += reference.samples.per_second)
        for (std::size_t row = 0; row < reference.trajectory.bodies; ++row)
            for (int axis = 0; axis < 3; ++axis) {
                const long double x = reference.trajectory.at(sample, row).x[axis];
                most = std::max(most, std::abs(x - static_cast<float>(x)));
            }
    return static_cast<double>(most);
}

}  // namespace

double excess(const Judgement& judgement, const Requirements& requirements) {
    return std::max(share_of(judgement.position_error, requirements.position_error),
                    share_of(judgement.energy_drift, requirements.energy_drift));
}

double Search::Candidate::cost(std::int64_t rate) const {
    const double share = 1 / static_cast<double>(steps_per_call(rate));
    return static_cast<double>(rate) * (together + (alone - together) * share);
}

Search::Search(const Scene& scene, const Reference& reference, const Requirements& requirements,
               const SweepWatch& watch)
    : scene_(scene),
      reference_(reference),
      requirements_(requirements),
      watch_(watch),
      work_(scene) {
    for (const std::int64_t rate : lab::rungs(scene, reference.samples, requirements.max_rate))
        if (rate >= requirements.min_rate && rate <= requirements.max_rate) rungs_.push_back(rate);
    if (rungs_.empty())
        fail(Exit::usage, "no rates lie between {} and {} Hz: lower --min-rate",
             requirements.min_rate, requirements.max_rate);
    const double rounding = rounding_to_float(reference);
    if (requirements.position_error && rounding > *requirements.position_error)
        too_coarse_float_ = rounding;
    for (const Method* method : requirements.methods)
        for (const Precision precision : {Precision::single, Precision::double_})
            if (!(precision == Precision::single && too_coarse_float_) &&
                why_not(scene, Settings{{method, {rungs_.back()}, precision}}).empty())
                add_candidate(*method, precision);
}

void Search::add_candidate(const Method& method, Precision precision) {
    // All steps cost the same. A short one is stable.
    constexpr std::int64_t rate = 1 << 16;
    constexpr std::int64_t many = 64;
    constexpr double expensive = 5e6;  // ns; the cost of a call is negligible beside it
    Candidate candidate{.method = &method, .precision = precision};
    candidate.alone = candidate.together = watch_.ns_per_step(scene_, candidate.at(rate), 1);
    if (std::isnan(candidate.alone)) return;
    candidate.work_per_hertz = work_.per_step(method) * reference_.meaningful_until();
    if (candidate.alone < expensive)
        candidate.together =
            std::min(candidate.alone, watch_.ns_per_step(scene_, candidate.at(rate), many));
    candidates_.push_back(candidate);
}

void Search::run() {
    requirements_.has_tolerance() ? find_cheapest() : find_most_accurate();
    if (requirements_.has_tolerance()) refine();
}

TradeoffRow Search::try_choice(const Stepping& choice) {
    for (const TradeoffRow& row : rows_)
        if (row.stepping == choice) return row;
    rows_.push_back({.stepping = choice,
                     .judgement = judge(scene_, Settings{choice}, reference_, watch_.stopped),
                     .meets_steps = reference_.samples.meet_steps(choice.rate.steps)});
    return rows_.back();
}

TradeoffRow Search::try_next(const Candidate& candidate) {
    return try_choice(candidate.at(rungs_[candidate.next]));
}

bool Search::meets_tolerance(const TradeoffRow& row) const {
    return meets(row.judgement, requirements_, safety_margin);
}

double Search::cost_of(const Stepping& choice) const {
    for (const Candidate& candidate : candidates_)
        if (candidate.at(choice.rate.steps) == choice) return candidate.cost(choice.rate.steps);
    return INFINITY;
}

double Search::next_cost(const Candidate& candidate) const {
    return candidate.cost(rungs_[candidate.next]);
}

Search::Candidate* Search::cheapest_next() {
    Candidate* cheapest = nullptr;
    for (Candidate& candidate : candidates_)
        if (!candidate.over && (!cheapest || next_cost(candidate) < next_cost(*cheapest)))
            cheapest = &candidate;
    return cheapest;
}

/// The lowest rate above `row` that can meet the tolerance if the error falls by one order more
/// than the method's.
std::int64_t Search::least_rate(const Candidate& candidate, const TradeoffRow& row,
                                double excess) const {
    const std::int64_t next = row.stepping.rate.steps + 1;
    const bool falls = row.judgement.position_error < largest_converging_error * reference_.extent;
    if (!falls || excess <= 1) return next;
    const double order = candidate.method->order + 1;
    return std::max(next, static_cast<std::int64_t>(static_cast<double>(row.stepping.rate.steps) *
                                                    std::pow(excess, 1 / order)));
}

bool Search::affordable(const Candidate& candidate, std::int64_t rate) const {
    return candidate.work_per_hertz * static_cast<double>(rate) <= requirements_.most_work;
}

/// Moves a candidate to the next rung that is worth a run, or marks it as over.
void Search::advance(Candidate& candidate, const TradeoffRow& row, double excess) {
    std::int64_t least = row.stepping.rate.steps + 1;
    if (row.judgement.stable && row.meets_steps) {
        const double error = row.judgement.position_error;
        candidate.convergence.take(error);
        candidate.tried = row.stepping.rate.steps;
        candidate.error = error;
        const bool only_rounding = candidate.method->order == exact_order;
        candidate.over = only_rounding || candidate.convergence.ended();
        if (!candidate.over) least = least_rate(candidate, row, excess);
    }
    while (candidate.next < rungs_.size() && rungs_[candidate.next] < least) ++candidate.next;
    if (candidate.next == rungs_.size() || !affordable(candidate, rungs_[candidate.next]))
        candidate.over = true;
}

void Search::find_cheapest() {
    double first = INFINITY;
    const Method* first_method = nullptr;
    bool has_second = false;
    for (Candidate* next = cheapest_next(); next && !watch_.stopped(); next = cheapest_next()) {
        const double cost = next_cost(*next);
        if (cost > first * (has_second ? rival_cost_ratio : runner_up_cost_ratio)) break;
        report_progress();
        const TradeoffRow row = try_next(*next);
        if (!meets_tolerance(row)) {
            advance(*next, row, excess(row.judgement, requirements_));
            continue;
        }
        next->over = true;
        first = std::min(first, cost);
        if (!first_method) first_method = row.stepping.method;
        has_second = has_second || row.stepping.method != first_method;
    }
    if (!first_method) try_highest();
}

void Search::report_progress() const {
    std::size_t done = 0;
    for (const Candidate& candidate : candidates_)
        done += candidate.over ? rungs_.size() : candidate.next;
    watch_.progress(static_cast<double>(done) /
                    static_cast<double>(candidates_.size() * rungs_.size()));
}

/// Tries the three settings with the smallest errors expected by their order, at the highest rates
/// within the work limit. For searches that found no setting within the tolerance.
void Search::try_highest() {
    constexpr std::size_t most = 3;
    std::vector<std::pair<double, Stepping>> highest;
    for (const Candidate& candidate : candidates_) {
        std::int64_t rate = candidate.tried;
        for (const std::int64_t rung : rungs_)
            if (affordable(candidate, rung)) rate = std::max(rate, rung);
        if (candidate.tried == 0 || rate == candidate.tried || candidate.convergence.ended())
            continue;
        const double times = static_cast<double>(rate) / static_cast<double>(candidate.tried);
        highest.emplace_back(candidate.error / std::pow(times, candidate.method->order),
                             candidate.at(rate));
    }
    std::stable_sort(highest.begin(), highest.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    highest.resize(std::min(highest.size(), most));
    for (const auto& [error, choice] : highest)
        if (!watch_.stopped()) try_choice(choice);
}

void Search::find_most_accurate() {
    double least = INFINITY;
    for (Candidate* next = cheapest_next(); next && !watch_.stopped(); next = cheapest_next()) {
        if (next_cost(*next) > *requirements_.ns_per_second && !rows_.empty()) break;
        report_progress();
        const TradeoffRow row = try_next(*next);
        const Judgement& judgement = row.judgement;
        if (judgement.below_floor()) {
            least = reference_.floor().position;
            next->over = true;
            continue;
        }
        if (judgement.stable) least = std::min(least, judgement.position_error);
        advance(*next, row, judgement.position_error / least);
    }
}

void Search::refine() {
    std::vector<TradeoffRow> found = meeting_rows();
    found.resize(std::min(found.size(), most_refined));
    for (const TradeoffRow& row : found)
        if (row.meets_steps) refine(row);
}

/// Bisects between a rung that meets the tolerance and the one below, over multiples of the samples
/// per second.
void Search::refine(const TradeoffRow& row) {
    const auto rung = std::find(rungs_.begin(), rungs_.end(), row.stepping.rate.steps);
    if (rung == rungs_.begin()) return;
    const std::int64_t unit = reference_.samples.per_second;
    std::int64_t low = *std::prev(rung) / unit;
    std::int64_t high = row.stepping.rate.steps / unit;
    Stepping choice = row.stepping;
    // Below 1/32 of the rate, the gain is not worth a run.
    while (high - low > std::max<std::int64_t>(1, high / 32) && !watch_.stopped()) {
        const std::int64_t middle = (low + high) / 2;
        choice.rate.steps = middle * unit;
        (meets_tolerance(try_choice(choice)) ? high : low) = middle;
    }
}

std::vector<TradeoffRow> Search::meeting_rows() const {
    std::vector<TradeoffRow> found;
    for (const TradeoffRow& row : rows_)
        if (meets_tolerance(row)) found.push_back(row);
    std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
        return cost_of(a.stepping) < cost_of(b.stepping);
    });
    return found;
}

std::vector<TradeoffRow> Search::closest_rows() const {
    const auto off = [&](const TradeoffRow& row) {
        if (requirements_.has_tolerance()) return excess(row.judgement, requirements_);
        return row.judgement.below_floor() ? 0 : row.judgement.position_error;
    };
    std::vector<TradeoffRow> found;
    for (const TradeoffRow& row : rows_)
        if (row.judgement.stable) found.push_back(row);
    std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
        return std::pair(off(a), cost_of(a.stepping)) < std::pair(off(b), cost_of(b.stepping));
    });
    return found;
}

}  // namespace oiler::lab
