// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <cmath>

#include "oiler/core/length_text.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
namespace oiler::lab {
namespace {

std::string describe_error(const Judgement& judgement, const Reference& reference) {
    if (!judgement.stable) return "unstable";
    const double floor = reference.floor().position;
    const auto error = [&](double metres) {
        return std::isnan(metres) ? "below " + length_text(floor) : length_text(metres);
    };
    return fmt::format("error {} as drawn, {} at the steps", error(judgement.position_error),
                       error(judgement.step_error));
}

constexpr double frames_per_second = 60;

/// Names the worst frame if it costs much more than the mean of the frames that have a step, and
/// more than 1 % of the time of a frame.
std::string describe_cost(const TradeoffRow& row) {
    constexpr double much = 3;
    const double frames = std::min(static_cast<double>(row.stepping.rate.steps), frames_per_second);
    const double least = std::max(much * row.ns_per_second / frames, 1e7 / frames_per_second);
    return fmt::format("{} per simulated second, {:.2g} % of a frame{}",
                       describe_time(row.ns_per_second), row.ns_per_second / 1e7,
                       row.ns_worst_frame > least
                           ? fmt::format(" and {} in the worst", describe_time(row.ns_worst_frame))
                           : "");
}

/// The share of each tolerance that is used.
std::string describe_margin(const Judgement& judgement, const Requirements& requirements) {
    std::string text;
    const auto add = [&](const std::optional<double>& most, double error, const char* of) {
        if (!most) return;
        text += text.empty() ? "" : ", ";
        text += std::isnan(error)
                    ? fmt::format("within the {:g}{} allowed", *most, of)
                    : fmt::format("{:.3g} % of the {:g}{} allowed", 100 * error / *most, *most, of);
    };
    add(requirements.position_error, requirements.error_of(judgement),
        requirements.at_steps ? " m at the steps" : " m");
    add(requirements.energy_drift, judgement.energy_drift, " of energy drift");
    return text;
}

std::string describe_requirements(const Requirements& requirements) {
    std::string text;
    if (requirements.position_error) text += fmt::format("{:g} m", *requirements.position_error);
    if (requirements.energy_drift)
        text += fmt::format("{}an energy drift of {:g}", text.empty() ? "" : " and ",
                            *requirements.energy_drift);
    if (requirements.ns_per_second)
        text += fmt::format("{}{} per frame", text.empty() ? "" : " and ",
                            describe_time(*requirements.ns_per_second / 60));
    return text;
}

std::string conclusion(const Advice& advice, const Reference& reference,
                       const Requirements& requirements) {
    if (!advice.best)
        return fmt::format("No setting meets {}.", describe_requirements(requirements));
    const std::string what =
        fmt::format("{}: {}, {}{}", describe(advice.best->stepping),
                    describe_error(advice.best->judgement, reference), describe_cost(*advice.best),
                    requirements.ns_per_second
                        ? fmt::format(" ({})", describe_time(advice.best->ns_per_second / 60))
                        : "");
    if (!advice.meets)
        return fmt::format("No setting {}meets {}. Closest: {}.",
                           advice.ended_early ? "that was tried " : "",
                           describe_requirements(requirements), what);
    const std::string margin = describe_margin(advice.best->judgement, requirements);
    return margin.empty() ? fmt::format("{}: the most accurate within {}.", what,
                                        describe_requirements(requirements))
                          : fmt::format("{}; that is {}.", what, margin);
}

std::string describe_ratio(const TradeoffRow& row, const TradeoffRow& best) {
    const double times = row.ns_per_second / best.ns_per_second;
    if (!std::isfinite(times)) return "";
    return fmt::format(", {:.3g} times the cost{}", times,
                       is_tie(row, best) ? ", within its spread" : "");
}

std::string beside(const char* role, const TradeoffRow& row, const Advice& advice,
                   const Reference& reference) {
    if (!row.judgement.stable)
        return fmt::format("{}: {}, unstable.", role, describe(row.stepping));
    return fmt::format("{}: {}, {}, {}{}.", role, describe(row.stepping),
                       describe_error(row.judgement, reference), describe_cost(row),
                       describe_ratio(row, *advice.best));
}

/// The latency and how long the setting holds.
std::string describe_hold(const Advice& advice, const Scene& scene,
                          const Requirements& requirements) {
    std::string text = fmt::format("Input shows up to {:.3g} ms late, one step.",
                                   1e3 / static_cast<double>(advice.best->stepping.rate.steps));
    if (!advice.meets || !requirements.position_error || advice.growth.law == Growth::Law::unfit)
        return text;
    const double until = advice.growth.holds_until(*requirements.position_error);
    text += fmt::format(" It holds for the {:.4g} s measured", scene.duration);
    if (const std::size_t starts = advice.perturbed_starts; starts > 0)
        text +=
            fmt::format(", also from {} start{} perturbed by 0.1 %", starts, starts > 1 ? "s" : "");
    text += "; the error ";
    if (until == advice.growth.passed && std::isfinite(until))
        return text + fmt::format("passes {:g} m at about {:.2g} s, in a run of that length.",
                                  *requirements.position_error, until);
    if (advice.growth.law == Growth::Law::bounded) return text + "does not grow.";
    if (std::isinf(until)) return text + "hardly grows.";
    return text + fmt::format("{} and passes {:g} m at about {:.2g} s.",
                              describe(advice.growth.law), *requirements.position_error, until);
}

std::string describe_ties(const Advice& advice) {
    std::string text;
    for (const TradeoffRow& row : advice.ties)
        text += (text.empty() ? "" : "; ") + describe(row.stepping);
    return text;
}

/// The conditions of the costs, and the advice's cost without them.
std::string describe_costs(const Advice& advice) {
    const std::string text =
        "Costs are means over the frames of a game of 60 frames per second, with warm caches and "
        "one step per call";
    if (!std::isfinite(advice.best->ns_together)) return text;
    return fmt::format(
        "{}; at many steps per call, as with --steps, the advice takes {} per "
        "simulated second",
        text, describe_time(advice.best->ns_together));
}

/// The times at which errors are compared.
std::string describe_times(const Requirements& requirements) {
    if (requirements.display > 0)
        return fmt::format("at the times of {} frames per second", requirements.display);
    return "at any time";
}

Json with_frame(const TradeoffRow& row) {
    Json json = to_json(row);
    json["us_per_frame"] = row.ns_per_second / 60'000;
    json["us_worst_frame"] = row.ns_worst_frame / 1000;
    json["share_of_frame"] = row.ns_per_second / 1e9;
    json["latency_ms"] = 1e3 / static_cast<double>(row.stepping.rate.steps);
    return json;
}

Json with_frame(const std::optional<TradeoffRow>& row) {
    return row ? with_frame(*row) : Json(nullptr);
}

Json growth_of(const Advice& advice, const Requirements& requirements) {
    if (!advice.best || !requirements.position_error) return nullptr;
    return {{"law", describe(advice.growth.law)},
            {"holds_until", advice.growth.holds_until(*requirements.position_error)}};
}

Json to_json(const Alternative& alternative) {
    Json json =
        alternative.row ? with_frame(*alternative.row) : Json{{"method", alternative.method->name}};
    json["why"] = alternative.why;
    return json;
}

}  // namespace

std::string describe_time(double ns) {
    const auto [unit, name] = ns < 1e6   ? std::pair(1e3, "µs")
                              : ns < 1e9 ? std::pair(1e6, "ms")
                                         : std::pair(1e9, "s");
    return fmt::format("{:.3g} {}", ns / unit, name);
}

std::vector<std::string> describe(const Advice& advice, const Scene& scene,
                                  const Reference& reference, const Requirements& requirements) {
    std::vector<std::string> words{conclusion(advice, reference, requirements)};
    for (const std::string& obstacle : advice.obstacles)
        words.push_back("Obstacle: " + obstacle + ".");
    if (!advice.best) return words;
    if (rests(reference))
        words.push_back(
            "The scene is at rest: its error says little. Move a body, or give it a velocity.");
    words.push_back(describe_hold(advice, scene, requirements));
    if (advice.threads > 1)
        words.push_back(fmt::format("With --threads {}: {} per simulated second.", advice.threads,
                                    describe_time(advice.ns_on_threads)));
    if (!advice.ties.empty())
        words.push_back(
            fmt::format("Ties, within the spread of the cost: {}.", describe_ties(advice)));
    if (advice.meets && advice.ended_early)
        words.push_back(
            "The search ended before it had tried all settings, because that is too much work: a "
            "cheaper one may exist.");
    if (advice.cheapest) words.push_back(beside("Cheapest", *advice.cheapest, advice, reference));
    const bool is_cheapest = advice.runner_up && advice.cheapest &&
                             advice.runner_up->stepping == advice.cheapest->stepping;
    if (advice.runner_up && !is_cheapest)
        words.push_back(beside("Runner-up", *advice.runner_up, advice, reference));
    if (advice.current)
        words.push_back(beside("Current setting", *advice.current, advice, reference));
    for (const Alternative& alternative : advice.alternatives)
        words.push_back(fmt::format("Not {}: {}.", alternative.method->name, alternative.why));
    words.push_back(fmt::format(
        "Errors are the largest distance of any body from the reference in {:.4g} s: as drawn, on "
        "straight lines between steps {}. {}. Reference: {}.",
        std::min(scene.duration, reference.meaningful_until), describe_times(requirements),
        describe_costs(advice), reference.words));
    return words;
}

Json to_json(const Advice& advice, const Scene& scene, const Reference& reference,
             const Requirements& requirements) {
    const Uncertainty floor = reference.floor();
    return {
        {"meets", advice.meets},
        {"advice", with_frame(advice.best)},
        {"perturbed_starts", advice.perturbed_starts},
        {"growth", growth_of(advice, requirements)},
        {"ties", Json::list(advice.ties, [](const TradeoffRow& row) { return with_frame(row); })},
        {"threads", {{"count", advice.threads}, {"ns_per_second", advice.ns_on_threads}}},
        {"cheapest", with_frame(advice.cheapest)},
        {"runner_up", with_frame(advice.runner_up)},
        {"current", with_frame(advice.current)},
        {"alternatives",
         Json::list(advice.alternatives, [](const Alternative& one) { return to_json(one); })},
        {"obstacles", advice.obstacles},
        {"requirements",
         {{"position_error", requirements.position_error},
          {"at_steps", requirements.at_steps},
          {"display", requirements.display > 0 ? Json(requirements.display) : Json("any")},
          {"energy_drift", requirements.energy_drift},
          {"us_per_frame",
           requirements.ns_per_second ? Json(*requirements.ns_per_second / 60'000) : Json()}}},
        {"reference",
         {{"words", reference.words},
          {"closed_form", reference.closed_form},
          {"position_floor", floor.position},
          {"energy_floor", floor.energy},
          {"meaningful_until", reference.meaningful_until}}},
        {"ended_early", advice.ended_early},
        {"runs", advice.runs},
        {"words", describe(advice, scene, reference, requirements)}};
}

}  // namespace oiler::lab
