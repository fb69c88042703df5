// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/search.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/lab/sweep/drawn_error.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {
namespace {

/// The fraction of a tolerance that a row must leave unused.
constexpr double safety_margin = 0.02;
/// Settings that are estimated to cost up to this multiple of the best are tried and timed.
constexpr double rival_cost_ratio = 1.3;
/// The share of the work that is kept for the highest rates, in case no other meets the tolerance.
constexpr double kept_work = 0.2;
/// A runner-up of another method is sought up to this multiple of the best's cost.
constexpr double runner_up_cost_ratio = 2;
constexpr std::size_t most_refined = 4;
/// Multiples of this, modulo 1, are spread evenly, however many are taken.
constexpr double golden = 0.6180339887498949;

double share_of(double error, const std::optional<double>& tolerance) {
    return tolerance && !std::isnan(error) ? error / *tolerance : 0;
}

/// The highest rate from `low` to `high` that costs no more; `low` if all cost more.
std::int64_t highest_rate(const Candidate& candidate, std::int64_t low, std::int64_t high,
                          double cost) {
    std::int64_t too_high = std::max(low, high) + 1;
    while (too_high - low > 1) {
        const std::int64_t middle = (low + too_high) / 2;
        (candidate.cost(middle) <= cost ? low : too_high) = middle;
    }
    return low;
}

/// The largest distance of a coordinate from the nearest float, m, at some times of the run. No run
/// in float has a smaller error at the steps there.
double rounding_to_float(const Reference& reference) {
    constexpr int times = 16;
    Real most = 0;
    std::vector<State3> states(reference.motion->bodies());
    for (int i = 0; i < times; ++i) {
        reference.motion->all_at(std::fmod(i * golden, 1.0) * reference.meaningful_until, states);
        for (const State3& state : states)
            for (int axis = 0; axis < 3; ++axis)
                most = std::max(most, std::abs(state.x[axis] - static_cast<float>(state.x[axis])));
    }
    return static_cast<double>(most);
}

Vec3 narrowed(const Real3& a) {
    return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

}  // namespace

double excess(const Judgement& judgement, const Requirements& requirements) {
    return std::max(share_of(requirements.error_of(judgement), requirements.position_error),
                    share_of(judgement.energy_drift, requirements.energy_drift));
}

Search::Search(const Scene& scene, const Reference& reference, const Requirements& requirements,
               const SweepWatch& watch)
    : scene_(scene),
      reference_(reference),
      requirements_(requirements),
      watch_(watch),
      meter_(scene, requirements.most_search_work, watch.stopped),
      ensemble_(scene, reference, requirements, watch.stopped, meter_) {
    // A run has at least one step.
    const double least = (1 - 1e-12) / reference.meaningful_until;
    for (const std::int64_t rate : lab::sweep_rates(scene, requirements.max_rate))
        if (rate >= requirements.min_rate && rate <= requirements.max_rate &&
            static_cast<double>(rate) >= least)
            rates_.push_back(rate);
    if (rates_.empty())
        fail(Exit::usage, "no rates lie between {} and {} Hz: lower --min-rate",
             requirements.min_rate, requirements.max_rate);
    drop_low_rates();
    const double rounding = rounding_to_float(reference);
    if (requirements.position_error && rounding > *requirements.position_error)
        too_coarse_float_ = rounding;
    for (const Method* method : requirements.methods)
        for (const Precision precision : {Precision::single, Precision::double_})
            if (!(precision == Precision::single && too_coarse_float_))
                add_candidates(*method, precision);
}

/// Drops the rates at which the lines of any method are too coarse, except the highest.
void Search::drop_low_rates() {
    if (!requirements_.position_error || requirements_.at_steps || requirements_.display > 0)
        return;
    const double most = *requirements_.position_error;
    const auto bodies = static_cast<double>(reference_.motion->bodies());
    const auto is_too_low = [&](std::int64_t rate) {
        const double samples = 2 * static_cast<double>(rate) * reference_.meaningful_until * bodies;
        if (!meter_.is_little(WorkMeter::comparison * samples)) return false;
        return least_drawn_error(*reference_.motion, rate, reference_.meaningful_until, most) >
               most;
    };
    const auto first = std::find_if_not(rates_.begin(), rates_.end() - 1, is_too_low);
    if (first != rates_.begin()) too_low_ = *std::prev(first);
    rates_.erase(rates_.begin(), first);
}

void Search::add_candidates(const Method& method, Precision precision) {
    if (!why_not(scene_, Settings{{&method, {rates_.back()}, precision}}).empty()) return;
    add_candidate(method, precision, std::nullopt);
    if (reference_.conservative || !std::holds_alternative<Splitting>(method.rule)) return;
    const Damping other = method.damping == Damping::in_kick ? Damping::in_drift : Damping::in_kick;
    if (why_not(scene_, Settings{{&method, {rates_.back()}, precision, other}}).empty())
        add_candidate(method, precision, other);
}

/// Worlds in the states of the reference at times spread over the duration: costs grow where bodies
/// land.
const std::vector<World>& Search::starts(Precision precision) {
    constexpr std::size_t most = 12;
    constexpr std::size_t many_bodies = 100'000;
    std::vector<World>& worlds = starts_[precision == Precision::single ? 0 : 1];
    if (!worlds.empty()) return worlds;
    const World start =
        make_world(scene_, Settings{{scene_.stepping.method, scene_.stepping.rate, precision}});
    std::vector<State3> states(start.body_count());
    const std::size_t count =
        std::clamp(many_bodies / std::max<std::size_t>(1, states.size()), std::size_t{2}, most);
    for (std::size_t i = 0; i < count; ++i) {
        const double share = std::fmod(static_cast<double>(i + 1) * golden, 1.0);
        reference_.motion->all_at(share * reference_.meaningful_until, states);
        World& world = worlds.emplace_back(start);
        for (std::size_t row = 0; row < states.size(); ++row) {
            const Entity entity = world.entity_of_row(row);
            world.set_position(entity, narrowed(states[row].x));
            world.set_velocity(entity, narrowed(states[row].v));
        }
    }
    return worlds;
}

void Search::add_candidate(const Method& method, Precision precision,
                           std::optional<Damping> damping) {
    // A short step is stable. Impacts and landings of a frame are in its first step.
    constexpr std::int64_t high_rate = 1 << 16;
    constexpr std::int64_t fps = 60;
    constexpr double expensive = 2e5;  // ns
    Candidate candidate{.method = &method,
                        .precision = precision,
                        .damping = damping,
                        .convergence = Convergence(largest_converging_error * reference_.extent)};
    const auto cost = [&](std::int64_t rate, std::int64_t per_frame) {
        return watch_.ns_per_step(starts(precision), candidate.at(rate), per_frame);
    };
    const double single = cost(high_rate, 1);
    if (std::isnan(single)) return;
    const std::int64_t many = single < expensive ? 16 : 2;
    const double each = cost(high_rate, many);
    const double further = each + (each - single) / static_cast<double>(many - 1);
    // Another program may have disturbed either.
    candidate.further = std::clamp(further, each / 2, std::max(each / 2, single));
    const double of_frame = cost(fps, 1);
    candidate.first = std::isnan(of_frame) ? single : of_frame;
    candidates_.push_back(candidate);
}

void Search::run() {
    if (requirements_.has_tolerance()) {
        find_cheapest();
        refine();
    } else {
        find_most_accurate();
        refine_to_time();
    }
}

TradeoffRow Search::judged(const Stepping& choice, double enough) {
    return {.stepping = choice,
            .judgement = judge(scene_, Settings{choice}, reference_,
                               {.display = requirements_.display,
                                .enough = enough,
                                .at_steps = requirements_.at_steps,
                                .stopped = meter_.counting(*choice.method)})};
}

bool Search::can_measure(const Stepping& choice) const {
    return meter_.is_little(work_of(choice)) || affordable(choice);
}

double Search::work_of(const Stepping& choice) const {
    return meter_.per_step(*choice.method) * static_cast<double>(choice.rate.steps) *
           reference_.meaningful_until;
}

TradeoffRow Search::try_choice(const Stepping& choice) {
    constexpr double far = 20;
    for (const TradeoffRow& row : rows_)
        if (row.stepping == choice) return row;
    rows_.push_back(judged(choice, far * requirements_.position_error.value_or(INFINITY)));
    return rows_.back();
}

TradeoffRow Search::measure(const Stepping& choice) {
    for (TradeoffRow& row : rows_)
        if (row.stepping == choice) {
            if (!row.judgement.complete) row = judged(choice, INFINITY);
            return row;
        }
    rows_.push_back(judged(choice, INFINITY));
    return rows_.back();
}

bool Search::meets_tolerance(const TradeoffRow& row) {
    return meets(row.judgement, requirements_, safety_margin) && objection(row).empty();
}

double Search::cost_of(const Stepping& choice) const {
    for (const Candidate& candidate : candidates_)
        if (candidate.at(choice.rate.steps) == choice) return candidate.cost(choice.rate.steps);
    return INFINITY;
}

Stepping Search::within_cost(const Method& method, double cost) const {
    Stepping best{&method, {rates_.front()}, Precision::double_};
    bool found = false;
    for (const Candidate& candidate : candidates_) {
        if (candidate.method != &method) continue;
        const std::int64_t rate = highest_rate(candidate, rates_.front(), rates_.back(), cost);
        if (!found || rate > best.rate.steps) best = candidate.at(rate);
        found = true;
    }
    return best;
}

double Search::next_cost(const Candidate& candidate) const {
    return candidate.cost(rates_[candidate.next]);
}

/// The candidate whose next rate costs least; none if that is more than `most`. Those that are too
/// much work to try are over.
Candidate* Search::cheapest_next(double most) {
    for (;;) {
        Candidate* cheapest = nullptr;
        for (Candidate& candidate : candidates_)
            if (!candidate.over && (!cheapest || next_cost(candidate) < next_cost(*cheapest)))
                cheapest = &candidate;
        if (!cheapest || next_cost(*cheapest) > most) return nullptr;
        if (affordable(cheapest->at(rates_[cheapest->next]), kept_work)) return cheapest;
        cheapest->over = ended_early_ = true;
    }
}

/// One run may take a part of the work that is left, so that others remain possible. A share of all
/// work may be kept.
bool Search::affordable(const Stepping& choice, double kept) const {
    constexpr double part = 4;
    const double steps = static_cast<double>(choice.rate.steps) * reference_.meaningful_until;
    return meter_.evaluations_per_step(*choice.method) * steps <= requirements_.most_work &&
           meter_.affords(part * work_of(choice) + kept * requirements_.most_search_work);
}

/// Moves a candidate to the next rate that is worth a run, or marks it as over.
void Search::advance(Candidate& candidate, const TradeoffRow& row, double excess) {
    std::int64_t least = row.stepping.rate.steps + 1;
    if (row.judgement.stable) {
        const double error = requirements_.error_of(row.judgement);
        candidate.convergence.take(error);
        candidate.tried = row.stepping.rate.steps;
        candidate.error = error;
        if (candidate.convergence.stalled()) {
            candidate.rounded =
                is_round_off(scene_, row, reference_, meter_.counting(*candidate.method));
            candidate.over = candidate.rounded;
            candidate.convergence.restart();
        }
        if (!candidate.over)
            least = candidate.least_rate(row, excess, requirements_, reference_.extent);
    }
    while (candidate.next < rates_.size() && rates_[candidate.next] < least) ++candidate.next;
    if (candidate.next == rates_.size()) candidate.over = true;
}

void Search::find_cheapest() {
    double first = INFINITY;
    const Method* first_method = nullptr;
    bool has_second = false;
    const auto next_candidate = [&] {
        return cheapest_next(first * (has_second ? rival_cost_ratio : runner_up_cost_ratio));
    };
    for (Candidate* next = next_candidate(); next && !watch_.stopped(); next = next_candidate()) {
        const double cost = next_cost(*next);
        report_progress();
        const TradeoffRow row = try_choice(next->at(rates_[next->next]));
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
        done += candidate.over ? rates_.size() : candidate.next;
    watch_.progress(std::max(
        meter_.share_done(),
        static_cast<double>(done) / static_cast<double>(candidates_.size() * rates_.size())));
}

/// Tries the three settings with the smallest errors expected by their order, at the highest rates
/// within the work limit. For searches that found no setting within the tolerance.
void Search::try_highest() {
    constexpr std::size_t most = 3;
    std::vector<std::pair<double, Stepping>> highest;
    for (const Candidate& candidate : candidates_) {
        std::int64_t rate = candidate.tried;
        for (const std::int64_t higher : rates_)
            if (affordable(candidate.at(higher))) rate = std::max(rate, higher);
        if (candidate.tried == 0 || rate == candidate.tried || candidate.rounded) continue;
        const double times = static_cast<double>(rate) / static_cast<double>(candidate.tried);
        const int order = std::min(candidate.method->order, requirements_.at_steps ? 8 : 2);
        highest.emplace_back(candidate.error / std::pow(times, order), candidate.at(rate));
    }
    std::ranges::stable_sort(highest, {}, &std::pair<double, Stepping>::first);
    highest.resize(std::min(highest.size(), most));
    for (const auto& [error, choice] : highest)
        if (!watch_.stopped()) try_affordable(choice);
}

void Search::find_most_accurate() {
    double least = INFINITY;
    const auto next_candidate = [&] {
        return cheapest_next(rows_.empty() ? INFINITY : *requirements_.ns_per_second);
    };
    for (Candidate* next = next_candidate(); next && !watch_.stopped(); next = next_candidate()) {
        report_progress();
        const TradeoffRow row = try_choice(next->at(rates_[next->next]));
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
    std::size_t left = most_refined;
    for (const TradeoffRow& row : meeting_rows()) {
        if (left == 0) break;
        if (refine(row)) --left;
    }
}

/// Tries the most accurate settings at the highest rate within the time.
void Search::refine_to_time() {
    // A margin for the spread of the time.
    const double most = 0.95 * *requirements_.ns_per_second;
    std::vector<TradeoffRow> rows = rows_by_excess();
    rows.resize(std::min(rows.size(), most_refined));
    for (const TradeoffRow& row : rows) {
        const std::int64_t low = row.stepping.rate.steps;
        for (const Candidate& candidate : candidates_)
            if (candidate.at(low) == row.stepping && !watch_.stopped())
                try_affordable(candidate.at(
                    highest_rate(candidate, low, std::min(4 * low, requirements_.max_rate), most)));
    }
}

/// Tries rates between one that meets the tolerance and the one below, from the lowest up, because
/// errors of few steps do not fall steadily. Returns false if there are none.
bool Search::refine(const TradeoffRow& row) {
    const auto found = std::ranges::find(rates_, row.stepping.rate.steps);
    if (found == rates_.begin() && !too_low_) return false;
    const auto candidate = std::ranges::find_if(candidates_, [&](const Candidate& one) {
        return one.at(row.stepping.rate.steps) == row.stepping;
    });
    Stepping choice = row.stepping;
    choice.rate.steps = found == rates_.begin() ? *too_low_ : *std::prev(found);
    for (std::int64_t least = choice.rate.steps; !watch_.stopped();) {
        // Below 1/32 of the rate, the gain is not worth a run.
        const std::int64_t step = std::max<std::int64_t>(1, choice.rate.steps / 32);
        choice.rate.steps = std::max(choice.rate.steps + step, least);
        if (choice.rate.steps >= row.stepping.rate.steps) break;
        const std::optional<TradeoffRow> tried = try_affordable(choice);
        if (!tried || meets_tolerance(*tried)) break;
        if (tried->judgement.stable)
            least = candidate->least_rate(*tried, excess(tried->judgement, requirements_),
                                          requirements_, reference_.extent);
    }
    return true;
}

std::optional<TradeoffRow> Search::try_affordable(const Stepping& choice) {
    if (affordable(choice)) return try_choice(choice);
    ended_early_ = true;
    return std::nullopt;
}

std::vector<TradeoffRow> Search::meeting_rows() {
    std::vector<TradeoffRow> found;
    for (const TradeoffRow& row : rows_)
        if (meets_tolerance(row)) found.push_back(row);
    std::ranges::stable_sort(found, {},
                             [&](const TradeoffRow& row) { return cost_of(row.stepping); });
    return found;
}

std::vector<TradeoffRow> Search::closest_rows() {
    constexpr std::size_t most = 8;
    for (;;) {
        const std::vector<TradeoffRow> rows = rows_by_excess();
        bool has[2]{};
        std::size_t rank = 0;
        const auto incomplete = std::ranges::find_if(rows, [&](const TradeoffRow& row) {
            bool& known = has[row.stepping.precision == Precision::single ? 0 : 1];
            const bool matters = rank++ < most || !known;
            known = true;
            return matters && !row.judgement.complete;
        });
        if (incomplete == rows.end() || watch_.stopped()) return rows;
        const Stepping& choice = incomplete->stepping;
        if (can_measure(choice))
            measure(choice);
        else
            std::erase_if(rows_, [&](const TradeoffRow& row) { return row.stepping == choice; });
    }
}

std::vector<TradeoffRow> Search::rows_by_excess() {
    const auto off = [&](const TradeoffRow& row) {
        if (requirements_.has_tolerance()) return excess(row.judgement, requirements_);
        return row.judgement.below_floor() ? 0 : row.judgement.position_error;
    };
    std::vector<TradeoffRow> found;
    for (const TradeoffRow& row : rows_)
        if (row.judgement.stable && (requirements_.has_tolerance() || objection(row).empty()))
            found.push_back(row);
    std::ranges::stable_sort(found, {}, [&](const TradeoffRow& row) {
        return std::pair(off(row), cost_of(row.stepping));
    });
    return found;
}

}  // namespace oiler::lab
