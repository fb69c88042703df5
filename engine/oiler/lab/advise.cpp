// SPDX-License-Identifier: MIT
#include "oiler/lab/advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

/// An independent run may look elsewhere: so much of a tolerance is left.
constexpr double spared = 0.02;
/// What is estimated to cost up to so many times the best is timed beside it.
constexpr double rival = 1.3;
/// A runner-up is looked for up to so many times the best's cost.
constexpr double far_off = 2;
constexpr std::size_t most_refined = 4;
constexpr std::size_t most_vain_runs = 3;
/// An error above this part of what the bodies move says nothing of how it falls.
constexpr double wild = 0.1;
constexpr int timing_rounds = 9;
constexpr std::array obvious{"semi_implicit_euler", "velocity_verlet", "rk4", "exact"};

/// A method in one precision, how far it was tried, and what a step of it costs in ns.
struct Candidate {
    const Method* method;
    Precision precision;
    double alone = unknown;     ///< a call of one step
    double together = unknown;  ///< a step of many in a call
    std::size_t next = 0;       ///< rung
    double best = INFINITY;     ///< m
    std::size_t vain = 0;
    bool over = false;

    [[nodiscard]] SceneChoice at(std::int64_t rate) const { return {method, rate, precision}; }
    [[nodiscard]] double cost(std::int64_t rate) const {
        const double share = 1 / static_cast<double>(steps_at_once(rate));
        return static_cast<double>(rate) * (together + (alone - together) * share);
    }
};

Candidate make_candidate(const Scene& scene, const Method& method, Precision precision) {
    // Any step costs the same; one that is short is stable.
    constexpr std::int64_t rate = 1 << 16;
    constexpr std::int64_t many = 64;
    Candidate candidate{.method = &method, .precision = precision};
    candidate.alone = ns_per_step(scene, candidate.at(rate), 1);
    candidate.together = std::min(candidate.alone, ns_per_step(scene, candidate.at(rate), many));
    return candidate;
}

double share_of(double error, const std::optional<double>& tolerance) {
    return tolerance && !std::isnan(error) ? error / *tolerance : 0;
}

/// How many times the tolerances a run is off.
double excess(const Judgement& judgement, const Wish& wish) {
    return std::max(share_of(judgement.position_error, wish.position_error),
                    share_of(judgement.energy_drift, wish.energy_drift));
}

class Search {
public:
    Search(const Scene& scene, const Reference& reference, const Wish& wish,
           const SweepWatch& watch)
        : scene_(scene), reference_(reference), wish_(wish), watch_(watch) {
        for (const std::int64_t rate : rungs(scene, reference.looks, wish.max_rate))
            if (rate >= wish.min_rate && rate <= wish.max_rate) rungs_.push_back(rate);
        if (rungs_.empty())
            fail(Exit::usage, "no rates lie between {} and {} Hz: lower --min-rate", wish.min_rate,
                 wish.max_rate);
        work_per_step_ = work_per_evaluation(scene) * reference.meaningful_until();
        for (const Method* method : wish.methods) {
            for (const Precision precision : {Precision::single, Precision::double_})
                if (why_not(scene, settings_of({method, rungs_.back(), precision})).empty())
                    candidates_.push_back(make_candidate(scene, *method, precision));
        }
    }

    Advice run() {
        wish_.has_tolerance() ? find_cheapest() : find_most_accurate();
        refine();
        if (watch_.stopped()) return {};
        return conclude();
    }

private:
    // ---- trying

    TradeoffRow& try_choice(const SceneChoice& choice) {
        for (TradeoffRow& row : rows_)
            if (row.choice == choice) return row;
        ++runs_;
        rows_.push_back(
            {.choice = choice,
             .judgement = judge(scene_, settings_of(choice), reference_, watch_.stopped),
             .meets_steps = reference_.looks.meet_steps(choice.rate)});
        return rows_.back();
    }
    [[nodiscard]] bool good(const TradeoffRow& row) const {
        return meets(row.judgement, wish_, spared);
    }
    [[nodiscard]] double cost_of(const TradeoffRow& row) const {
        for (const Candidate& candidate : candidates_)
            if (candidate.at(row.choice.rate) == row.choice) return candidate.cost(row.choice.rate);
        return INFINITY;
    }
    /// Of those whose next run is not ruled out, that of the cheapest run.
    Candidate* cheapest_next() {
        Candidate* cheapest = nullptr;
        for (Candidate& candidate : candidates_)
            if (!candidate.over && (!cheapest || next_cost(candidate) < next_cost(*cheapest)))
                cheapest = &candidate;
        return cheapest;
    }
    [[nodiscard]] double next_cost(const Candidate& candidate) const {
        return candidate.cost(rungs_[candidate.next]);
    }

    /// To the first rung that may do, were the error to fall by one order more than it should.
    void go_on(Candidate& candidate, const TradeoffRow& row, double excess) {
        const std::int64_t rate = row.choice.rate;
        const Judgement& judgement = row.judgement;
        std::int64_t least = rate + 1;
        if (judgement.stable && row.meets_steps) {
            candidate.vain =
                judgement.position_error < 0.9 * candidate.best ? 0 : candidate.vain + 1;
            candidate.best = std::min(candidate.best, judgement.position_error);
            const bool exact = candidate.method->order == exact_order;
            if (candidate.vain == most_vain_runs || exact) candidate.over = true;
            if (judgement.position_error < wild * reference_.extent && excess > 1 && !exact) {
                const double order = candidate.method->order + 1;
                least = std::max(least, static_cast<std::int64_t>(static_cast<double>(rate) *
                                                                  std::pow(excess, 1 / order)));
            }
        }
        while (candidate.next < rungs_.size() && rungs_[candidate.next] < least) ++candidate.next;
        const auto affordable = [&] {
            const int evaluations = std::max(1, candidate.method->evaluations);
            return work_per_step_ * evaluations * static_cast<double>(rungs_[candidate.next]) <=
                   wish_.most_work;
        };
        if (candidate.next == rungs_.size() || !affordable()) candidate.over = true;
    }

    // ---- searching

    void find_cheapest() {
        double first = INFINITY;
        const Method* first_method = nullptr;
        bool second = false;
        for (Candidate* next = cheapest_next(); next && !watch_.stopped(); next = cheapest_next()) {
            const double cost = next_cost(*next);
            if (cost > first * (second ? rival : far_off)) break;
            const TradeoffRow row = try_choice(next->at(rungs_[next->next]));
            if (good(row)) {
                next->over = true;
                first = std::min(first, cost);
                if (!first_method) first_method = row.choice.method;
                second = second || row.choice.method != first_method;
            } else {
                go_on(*next, row, excess(row.judgement, wish_));
            }
        }
    }
    void find_most_accurate() {
        double least = INFINITY;
        for (Candidate* next = cheapest_next(); next && !watch_.stopped(); next = cheapest_next()) {
            if (next_cost(*next) > *wish_.ns_per_second) break;
            const TradeoffRow row = try_choice(next->at(rungs_[next->next]));
            const Judgement& judgement = row.judgement;
            if (judgement.below_floor()) least = reference_.floor().position;
            if (judgement.stable) least = std::min(least, judgement.position_error);
            if (judgement.below_floor())
                next->over = true;
            else
                go_on(*next, row, least > 0 ? judgement.position_error / least : 1);
        }
    }

    /// Between the rung that does and the one below, which does not.
    void refine() {
        if (!wish_.has_tolerance()) return;
        std::vector<TradeoffRow> found = good_rows();
        found.resize(std::min(found.size(), most_refined));
        const std::int64_t unit = reference_.looks.per_second;
        for (const TradeoffRow& row : found) {
            std::int64_t high = row.choice.rate / unit;
            const auto rung = std::find(rungs_.begin(), rungs_.end(), row.choice.rate);
            if (!row.meets_steps || rung == rungs_.begin()) continue;
            std::int64_t low = std::max(*std::prev(rung), wish_.min_rate - 1) / unit;
            SceneChoice choice = row.choice;
            // An eighth of the way is worth no more runs.
            while (high - low > std::max<std::int64_t>(1, high / 32) && !watch_.stopped()) {
                const std::int64_t middle = (low + high) / 2;
                choice.rate = middle * unit;
                (good(try_choice(choice)) ? high : low) = middle;
            }
        }
    }

    // ---- concluding

    [[nodiscard]] std::vector<TradeoffRow> good_rows() const {
        std::vector<TradeoffRow> found;
        for (const TradeoffRow& row : rows_)
            if (good(row)) found.push_back(row);
        std::stable_sort(found.begin(), found.end(),
                         [&](const auto& a, const auto& b) { return cost_of(a) < cost_of(b); });
        return found;
    }
    /// Without a tolerance the most accurate; else the one that is off by the least.
    [[nodiscard]] std::vector<TradeoffRow> nearest_rows() const {
        const auto off = [&](const TradeoffRow& row) {
            if (!row.judgement.stable) return double{INFINITY};
            if (wish_.has_tolerance()) return excess(row.judgement, wish_);
            return row.judgement.below_floor() ? 0 : row.judgement.position_error;
        };
        std::vector<TradeoffRow> found;
        for (const TradeoffRow& row : rows_)
            if (std::isfinite(off(row))) found.push_back(row);
        std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
            return std::pair(off(a), cost_of(a)) < std::pair(off(b), cost_of(b));
        });
        return found;
    }

    /// The contenders, each method's cheapest first.
    [[nodiscard]] std::vector<TradeoffRow> contenders() const {
        std::vector<TradeoffRow> found = wish_.has_tolerance() ? good_rows() : nearest_rows();
        if (found.empty()) found = nearest_rows();
        std::vector<TradeoffRow> kept;
        for (const TradeoffRow& row : found) {
            const auto same = std::count_if(kept.begin(), kept.end(), [&](const TradeoffRow& one) {
                return one.choice.method == row.choice.method &&
                       one.choice.precision == row.choice.precision;
            });
            if (same == 0) kept.push_back(row);
        }
        kept.resize(std::min<std::size_t>(kept.size(), 8));
        return kept;
    }

    Advice conclude() {
        std::vector<TradeoffRow> front = contenders();
        Advice advice{.runs = runs_};
        if (why_not(scene_, settings_of(today())).empty()) advice.today = try_choice(today());
        const double cost = front.empty() ? 0 : cost_of(front.front());
        for (const char* name : obvious)
            if (const auto alternative = consider(find_method(name), cost, front))
                advice.alternatives.push_back(*alternative);
        time(front, advice);
        if (wish_.has_tolerance() && !good_rows().empty())
            std::stable_sort(front.begin(), front.end(), [](const auto& a, const auto& b) {
                return a.ns_per_second < b.ns_per_second;
            });
        choose(front, advice);
        return advice;
    }
    [[nodiscard]] SceneChoice today() const {
        return {scene_.method, scene_.rate, scene_.precision};
    }
    void time(std::vector<TradeoffRow>& front, Advice& advice) const {
        std::vector<TradeoffRow*> rows;
        for (TradeoffRow& row : front) rows.push_back(&row);
        if (advice.today) rows.push_back(&*advice.today);
        for (Alternative& alternative : advice.alternatives)
            if (alternative.row) rows.push_back(&*alternative.row);
        time_rows(scene_, rows, timing_rounds, {.stopped = watch_.stopped});
    }
    void choose(const std::vector<TradeoffRow>& front, Advice& advice) const {
        if (front.empty()) {
            advice.obstacles.push_back("no method is stable at any rate that was asked for");
            return;
        }
        advice.best = front.front();
        for (const TradeoffRow& row : front)
            if (row.choice.method != advice.best->choice.method && !advice.runner_up)
                advice.runner_up = row;
        const bool in_time =
            !wish_.ns_per_second || advice.best->ns_per_second <= *wish_.ns_per_second;
        advice.meets = meets(advice.best->judgement, wish_) && in_time;
        if (!advice.meets) add_obstacles(advice, in_time);
    }
    void add_obstacles(Advice& advice, bool in_time) const {
        if (!in_time)
            advice.obstacles.push_back(fmt::format(
                "the time: nothing that is as accurate takes less than {:.3g} µs per frame",
                advice.best->ns_per_second / 60'000));
        if (meets(advice.best->judgement, wish_)) return;
        for (const Precision precision : {Precision::single, Precision::double_}) {
            double least = INFINITY;
            for (const TradeoffRow& row : rows_)
                if (row.choice.precision == precision && row.judgement.stable)
                    least = std::min(least, row.judgement.position_error);
            if (std::isfinite(least))
                advice.obstacles.push_back(fmt::format(
                    "{} comes no nearer than {:.3g} m at the rates up to {} Hz that were worth "
                    "trying",
                    name_of(precision), least, rungs_.back()));
        }
    }

    /// At the highest rate that costs no more than the best.
    std::optional<Alternative> consider(const Method& method, double cost,
                                        const std::vector<TradeoffRow>& front) {
        if (std::find(wish_.methods.begin(), wish_.methods.end(), &method) == wish_.methods.end())
            return std::nullopt;
        for (std::size_t i = 0; i < std::min<std::size_t>(2, front.size()); ++i)
            if (front[i].choice.method == &method) return std::nullopt;
        Alternative alternative{.method = &method};
        SceneChoice choice{&method, rungs_.front(), Precision::double_};
        alternative.why = why_not(scene_, settings_of(choice));
        if (!alternative.why.empty()) return alternative;
        const Candidate candidate = make_candidate(scene_, method, Precision::double_);
        for (const std::int64_t rate : rungs_)
            if (candidate.cost(rate) <= cost) choice.rate = rate;
        alternative.row = try_choice(choice);
        alternative.why = why_worse(*alternative.row);
        return alternative;
    }
    [[nodiscard]] std::string why_worse(const TradeoffRow& row) const {
        const Judgement& judgement = row.judgement;
        if (!judgement.stable)
            return fmt::format("for the same time it could run at {} Hz, where it is unstable",
                               row.choice.rate);
        if (!wish_.has_tolerance() || good(row)) return "it costs more for no less error";
        const double off = excess(judgement, wish_);
        std::string text =
            fmt::format("for the same time it could run at {} Hz, and is {:.3g} times too far off",
                        row.choice.rate, off);
        if (row.meets_steps && row.choice.method->order != exact_order &&
            judgement.position_error < wild * reference_.extent)
            text += fmt::format("; it would need some {:.2g} Hz",
                                static_cast<double>(row.choice.rate) *
                                    std::pow(off, 1.0 / row.choice.method->order));
        return text;
    }

    const Scene& scene_;
    const Reference& reference_;
    const Wish& wish_;
    const SweepWatch& watch_;
    std::vector<std::int64_t> rungs_;
    std::vector<Candidate> candidates_;
    std::vector<TradeoffRow> rows_;
    double work_per_step_ = 0;
    std::int64_t runs_ = 0;
};

void require_judgeable(const Scene& scene, const Reference& reference, const Wish& wish) {
    if (reference.meaningful < reference.looks.count)
        fail(Exit::usage,
             "errors on this scene mean nothing after {:.4g} s of {:.4g}: {}; give --duration "
             "{:.4g}",
             reference.meaningful_until(), scene.duration, reference.why_no_longer,
             reference.meaningful_until());
    const Doubt floor = reference.floor();
    const auto require = [](const std::optional<double>& wanted, double least, const char* what,
                            const char* unit) {
        if (wanted && *wanted < least)
            fail(Exit::usage,
                 "a {} of {:g}{} cannot be judged: errors below {:.2g}{} cannot be told, a hundred "
                 "times the reference's own",
                 what, *wanted, unit, least, unit);
    };
    require(wish.position_error, floor.position, "position error", " m");
    require(wish.energy_drift, floor.energy, "energy drift", "");
}

}  // namespace

bool meets(const Judgement& judgement, const Wish& wish, double slack) {
    return judgement.stable && excess(judgement, wish) <= 1 - slack;
}

double wanted_of(const Wish& wish) {
    // Energies go with positions; a sharper one is refused where it cannot be judged.
    return wish.position_error ? *wish.position_error / 100 : 0;
}

Advice advise(const Scene& scene, const Reference& reference, const Wish& wish,
              const SweepWatch& watch) {
    require_judgeable(scene, reference, wish);
    return Search(scene, reference, wish, watch).run();
}

}  // namespace oiler
