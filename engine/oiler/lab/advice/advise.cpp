// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/advise.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "oiler/core/error.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/lab/advice/passing_time.hpp"
#include "oiler/lab/advice/search.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler::lab {
namespace {

constexpr std::size_t most_contenders = 8;
constexpr int timing_rounds = 9;

/// Rounds down to two digits.
double rounded_down(double number) {
    const double digit = std::pow(10, std::floor(std::log10(std::abs(number))) - 1);
    return std::floor(number / digit) * digit;
}

/// The first row of each method in each precision and with each treatment of damping.
std::vector<TradeoffRow> contenders_among(const std::vector<TradeoffRow>& rows) {
    std::vector<TradeoffRow> kept;
    const auto kind = [](const TradeoffRow& row) {
        return std::tuple(row.stepping.method, row.stepping.precision, row.stepping.damping);
    };
    for (const TradeoffRow& row : rows) {
        const bool is_new = std::ranges::find(kept, kind(row), kind) == kept.end();
        if (is_new && kept.size() < most_contenders) kept.push_back(row);
    }
    return kept;
}

/// Turns the result of a search into an advice.
class Conclusion {
public:
    Conclusion(const Scene& scene, const Reference& reference, const Requirements& requirements,
               Search& search)
        : scene_(scene), reference_(reference), requirements_(requirements), search_(search) {}

    Advice run(const SweepWatch& watch) {
        const bool found = requirements_.has_tolerance() && !search_.meeting_rows().empty();
        front_ = contenders_among(found ? search_.meeting_rows() : search_.closest_rows());
        for (TradeoffRow& row : front_) row = search_.measure(row.stepping);
        if (const Stepping& own = scene_.stepping;
            why_not(scene_, Settings{own}).empty() && search_.can_measure(own))
            advice_.current = search_.measure(own);
        const bool has_current = advice_.current && advice_.current->judgement.stable &&
                                 is_asked(*advice_.current->stepping.method);
        if (front_.empty() && search_.ended_early() && has_current)
            front_.push_back(*advice_.current);
        for (const Method* method : obvious_methods()) consider(*method);
        if (found) add_prompt_rows();
        time(watch);
        if (found) {
            add_measured_rows();
            rank();
        }
        choose();
        if (advice_.best) explain();
        if (advice_.best) try_threads(watch);
        advice_.perturbed_starts = search_.perturbed_starts();
        advice_.ended_early = search_.ended_early();
        advice_.runs = search_.runs();
        return std::move(advice_);
    }

private:
    [[nodiscard]] bool is_asked(const Method& method) const {
        return std::ranges::find(requirements_.methods, &method) != requirements_.methods.end();
    }
    /// Adds a method at a rate at which the search found that it meets the tolerance, else at the
    /// highest rate that costs no more than the best.
    void consider(const Method& method) {
        if (!is_asked(method)) return;
        Alternative alternative{.method = &method};
        alternative.why =
            why_not(scene_, Settings{{&method, {search_.rates().back()}, Precision::double_}});
        const auto is_of = [&](const TradeoffRow& row) { return row.stepping.method == &method; };
        if (alternative.why.empty()) {
            const std::vector<TradeoffRow> meeting =
                requirements_.has_tolerance() ? search_.meeting_rows() : std::vector<TradeoffRow>{};
            const auto found = std::ranges::find_if(meeting, is_of);
            const double cost = front_.empty() ? 0 : search_.cost_of(front_.front().stepping);
            const Stepping choice =
                found != meeting.end() ? found->stepping : search_.within_cost(method, cost);
            if (search_.can_measure(choice))
                alternative.row = search_.measure(choice);
            else
                alternative.why = "to compare it is too much work";
        }
        advice_.alternatives.push_back(std::move(alternative));
    }
    /// At this rate, input shows as soon as the display and the scene's author expect, 1/s.
    [[nodiscard]] std::int64_t prompt_rate() const {
        constexpr std::int64_t display = 60;
        return std::min(requirements_.max_rate, std::max(display, scene_.stepping.rate.steps));
    }
    [[nodiscard]] bool is_negligible(const TradeoffRow& row) const {
        return row.ns_per_second <= requirements_.negligible_ns_per_second;
    }
    /// Adds the settings of lower rates at the prompt rate, if they cost little there.
    void add_prompt_rows() {
        const std::vector<TradeoffRow> rows = front_;
        for (TradeoffRow row : rows) {
            if (row.stepping.rate.steps >= prompt_rate()) continue;
            row.stepping.rate.steps = prompt_rate();
            if (search_.cost_of(row.stepping) > requirements_.negligible_ns_per_second) continue;
            if (const auto tried = search_.try_affordable(row.stepping))
                add_meeting(search_.measure(tried->stepping));
        }
    }
    /// Adds the current setting and the obvious ones.
    void add_measured_rows() {
        if (advice_.current) add_meeting(*advice_.current);
        for (const Alternative& alternative : advice_.alternatives)
            if (alternative.row) add_meeting(*alternative.row);
    }
    void add_meeting(const TradeoffRow& row) {
        const std::int64_t rate = row.stepping.rate.steps;
        const bool is_known =
            std::ranges::find(front_, row.stepping, &TradeoffRow::stepping) != front_.end();
        const bool has_step = static_cast<double>(rate) * reference_.meaningful_until >= 1;
        const bool is_allowed = rate >= requirements_.min_rate && rate <= requirements_.max_rate &&
                                is_asked(*row.stepping.method);
        if (!is_known && has_step && is_allowed && search_.meets_tolerance(row))
            front_.push_back(row);
    }
    /// Puts the settings that tie with the cheapest before the others: the most accurate first,
    /// then those of the highest rate, then explicit methods. If their cost is negligible, those of
    /// a prompt rate come first.
    void rank() {
        std::ranges::stable_sort(front_, {}, &TradeoffRow::ns_per_second);
        const TradeoffRow cheapest = front_.front();
        const auto others =
            std::stable_partition(front_.begin(), front_.end(), [&](const TradeoffRow& row) {
                return in_time(row) && (is_negligible(row) || is_tie(row, cheapest));
            });
        // Errors that differ by less than a hundredth of the tolerance are equal.
        const auto merit = [&](const TradeoffRow& row) {
            const std::int64_t rate = row.stepping.rate.steps;
            return std::tuple(is_negligible(row) ? -std::min(rate, prompt_rate()) : 0,
                              std::round(100 * excess(row.judgement, requirements_)), -rate,
                              is_implicit(*row.stepping.method),
                              row.stepping.precision == Precision::single, row.stepping.method);
        };
        std::ranges::stable_sort(front_.begin(), others, {}, merit);
        const TradeoffRow best = front_.front();
        for (auto row = front_.begin() + 1; row != front_.end(); ++row)
            if (in_time(*row) && is_tie(*row, best)) advice_.ties.push_back(*row);
        if (best.ns_per_second > cheapest.ns_per_second && !is_tie(best, cheapest))
            advice_.cheapest = cheapest;
    }
    [[nodiscard]] std::string why_worse(const TradeoffRow& row) const {
        const Judgement& judgement = row.judgement;
        const double times = row.ns_per_second / advice_.best->ns_per_second;
        const std::int64_t rate = row.stepping.rate.steps;
        const bool is_dearer = times > 1 && !is_tie(row, *advice_.best);
        const std::string text =
            is_dearer ? fmt::format("at {} Hz, it costs {:.3g} times as much", rate, times)
                      : fmt::format("at {} Hz, where it costs no more,", rate);
        const auto add = [&](const std::string& result) {
            return text + (is_dearer ? " and " : " it ") + result;
        };
        if (!judgement.stable) return add("is unstable");
        if (!requirements_.has_tolerance())
            return add("has an error of " + length_text(judgement.position_error));
        const double off = excess(judgement, requirements_);
        if (off > 1) return add(fmt::format("has {:.3g} times the error allowed", off));
        const std::string objection = search_.objection(row);
        if (!objection.empty()) return text + (is_dearer ? "; " : " ") + objection;
        if (!search_.meets_tolerance(row))
            return add(fmt::format("has {:.3g} times the error allowed, too close to it", off));
        return add(is_dearer ? "meets the tolerance" : "is less accurate, or shows input later");
    }
    /// Says why each alternative loses. Removes the advice itself and the runner-up.
    void explain() {
        const auto named = [&](const Alternative& alternative) {
            const auto is_of = [&](const TradeoffRow& row) {
                return row.stepping.method == alternative.method;
            };
            return is_of(*advice_.best) || (advice_.runner_up && is_of(*advice_.runner_up)) ||
                   std::ranges::any_of(advice_.ties, is_of);
        };
        std::erase_if(advice_.alternatives, named);
        for (Alternative& alternative : advice_.alternatives)
            if (alternative.row) alternative.why = why_worse(*alternative.row);
    }

    void time(const SweepWatch& whole) {
        std::vector<TradeoffRow*> rows;
        for (TradeoffRow& row : front_) rows.push_back(&row);
        if (advice_.current) rows.push_back(&*advice_.current);
        for (Alternative& alternative : advice_.alternatives)
            if (alternative.row) rows.push_back(&*alternative.row);
        // Only the search reports progress.
        SweepWatch watch = whole;
        watch.progress = [](double) {};
        time_rows(scene_, rows, timing_rounds, watch);
    }

    /// Times the best setting on all cores, if its bodies are independent and many.
    void try_threads(const SweepWatch& watch) {
        constexpr std::size_t many = 2000;
        constexpr int rounds = 5;
        const int cores = this_machine().cores;
        const World world = make_world(scene_, Settings{advice_.best->stepping});
        if (cores < 2 || world.body_count() < many || world.bodies().link_count() > 0) return;
        TradeoffRow threaded = *advice_.best;
        SweepWatch on_threads = watch;
        on_threads.progress = [](double) {};
        on_threads.ns_of_frames = [&](const Scene& scene, Settings settings,
                                      const std::function<bool()>& stopped) {
            settings.threads = cores;
            return watch.ns_of_frames(scene, settings, stopped);
        };
        time_rows(scene_, {&threaded}, rounds, on_threads);
        if (is_tie(threaded, *advice_.best) ||
            !(threaded.ns_per_second < advice_.best->ns_per_second))
            return;
        advice_.threads = cores;
        advice_.ns_on_threads = threaded.ns_per_second;
    }

    [[nodiscard]] bool in_time(const TradeoffRow& row) const {
        return !requirements_.ns_per_second || row.ns_per_second <= *requirements_.ns_per_second;
    }
    void choose() {
        if (front_.empty()) {
            advice_.obstacles.push_back(requirements_.ns_per_second &&
                                                !requirements_.has_tolerance()
                                            ? "time: every stable setting takes longer"
                                            : "no method is stable at any of the rates");
            return;
        }
        std::stable_partition(front_.begin(), front_.end(),
                              [&](const TradeoffRow& row) { return in_time(row); });
        advice_.best = front_.front();
        const Judgement& best = advice_.best->judgement;
        // A few roundings of the largest coordinate.
        const double rounding = advice_.best->stepping.precision == Precision::single
                                    ? std::numeric_limits<float>::epsilon()
                                    : std::numeric_limits<double>::epsilon();
        advice_.growth =
            fit_growth(best.growth, requirements_.error_of(best), reference_.meaningful_until,
                       32 * rounding * reference_.coordinate);
        if (requirements_.position_error)
            advice_.growth.passed = passing_time(scene_, advice_.best->stepping, advice_.growth,
                                                 *requirements_.position_error);
        const auto is_named = [&](const TradeoffRow& row) {
            return row.stepping.method == advice_.best->stepping.method ||
                   std::ranges::find(advice_.ties, row.stepping, &TradeoffRow::stepping) !=
                       advice_.ties.end();
        };
        for (const TradeoffRow& row : front_)
            if (!is_named(row) && !advice_.runner_up) advice_.runner_up = row;
        const bool near = lab::meets(advice_.best->judgement, requirements_) &&
                          search_.objection(*advice_.best).empty();
        advice_.meets = near && in_time(*advice_.best);
        if (!in_time(*advice_.best))
            advice_.obstacles.push_back(
                fmt::format("time: the fastest setting as accurate takes {} per frame",
                            describe_time(advice_.best->ns_per_second / 60)));
        if (!near) add_rounding_and_rates();
        if (!near && search_.ended_early())
            advice_.obstacles.push_back("work: the search ended before it had tried all settings");
    }
    void add_rounding_and_rates() {
        const std::vector<TradeoffRow> nearest = search_.closest_rows();
        for (const Precision precision : {Precision::single, Precision::double_}) {
            const auto rounding = search_.too_coarse_float();
            if (precision == Precision::single && rounding) {
                advice_.obstacles.push_back("in float, round-off alone moves bodies by " +
                                            length_text(*rounding));
                continue;
            }
            const auto row = std::ranges::find(
                nearest, precision, [](const TradeoffRow& one) { return one.stepping.precision; });
            if (row == nearest.end()) continue;
            const double off = excess(row->judgement, requirements_);
            const std::string objection = off <= 1 ? search_.objection(*row) : "";
            const std::int64_t highest = search_.rates().back();
            advice_.obstacles.push_back(fmt::format(
                "in {}, the closest is {} with {:.3g} times the {} allowed{}{}", name_of(precision),
                describe(row->stepping), off,
                requirements_.position_error ? "error" : "energy drift",
                objection.empty() ? "" : ", but " + objection,
                row->stepping.rate.steps < highest
                    ? fmt::format(
                          "; higher rates, up to {} Hz, add round-off or take too much work",
                          highest)
                    : ""));
        }
    }

    const Scene& scene_;
    const Reference& reference_;
    const Requirements& requirements_;
    Search& search_;
    std::vector<TradeoffRow> front_;
    Advice advice_;
};

}  // namespace

void require_judgeable(const Scene& scene, const Reference& reference,
                       const Requirements& requirements) {
    if (!reference.why_no_longer.empty())
        fail(
            Exit::usage,
            "errors on this scene are meaningful only up to {:.4g} s of {:.4g} s: {}; ask for {:g} "
            "s, with --duration or --for",
            reference.meaningful_until, scene.duration, reference.why_no_longer,
            rounded_down(0.98 * reference.meaningful_until));
    const Uncertainty floor = reference.floor();
    const auto require = [](const std::optional<double>& wanted, double least, const char* what,
                            const char* unit) {
        if (wanted && *wanted < least)
            fail(Exit::usage,
                 "{}: expected at least {:g}{}, 100 × the reference's own error, got {:g}{}; "
                 "give a larger tolerance or a shorter --duration",
                 what, -rounded_down(-least), unit, *wanted, unit);
    };
    require(requirements.position_error, floor.position, "position error", " m");
    require(requirements.energy_drift, floor.energy, "energy drift", "");
}

bool is_tie(const TradeoffRow& a, const TradeoffRow& b) {
    // Medians of repeated times differ by this much from one measurement to the next.
    constexpr double repeatable = 0.08;
    const double spread = std::max(a.ns_spread + b.ns_spread,
                                   repeatable * std::min(a.ns_per_second, b.ns_per_second));
    return std::abs(a.ns_per_second - b.ns_per_second) <= spread;
}

bool meets(const Judgement& judgement, const Requirements& requirements, double slack) {
    return judgement.stable && excess(judgement, requirements) <= 1 - slack;
}

double required_reference_error(const Requirements& requirements) {
    // The error of energies falls with that of positions. require_judgeable refuses the rest.
    return requirements.position_error ? *requirements.position_error / 100 : 0;
}

Advice advise(const Scene& scene, const Reference& reference, const Requirements& requirements,
              const SweepWatch& watch) {
    require_judgeable(scene, reference, requirements);
    Search search(scene, reference, requirements, watch);
    search.run();
    if (watch.stopped()) return {};
    return Conclusion(scene, reference, requirements, search).run(watch);
}

}  // namespace oiler::lab
