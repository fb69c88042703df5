// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <cmath>

#include "oiler/lab/advice/advise.hpp"

namespace oiler::lab {
namespace {

std::string describe_error(const Judgement& judgement, const Reference& reference) {
    if (!judgement.stable) return "unstable";
    if (judgement.below_floor())
        return fmt::format("error below {:.2g} m", reference.floor().position);
    return fmt::format("error up to {:.3g} m", judgement.position_error);
}

std::string describe_cost(const TradeoffRow& row) {
    return fmt::format("{:.3g} µs per simulated second", row.ns_per_second / 1e3);
}

/// The share of each tolerance that is used.
std::string describe_margin(const Judgement& judgement, const Requirements& requirements) {
    std::string text;
    const auto add = [&](const std::optional<double>& most, double error, const char* of) {
        if (!most) return;
        text += text.empty() ? "" : ", ";
        text +=
            std::isnan(error)
                ? fmt::format("less than the reference resolves of the {:g}{} allowed", *most, of)
                : fmt::format("{:.3g} % of the {:g}{} allowed", 100 * error / *most, *most, of);
    };
    add(requirements.position_error, judgement.position_error, " m");
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
        text += fmt::format("{}{:.4g} µs per frame", text.empty() ? "" : " and ",
                            *requirements.ns_per_second / 60'000);
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
                        ? fmt::format(", {:.3g} µs per frame", advice.best->ns_per_second / 60'000)
                        : "");
    if (!advice.meets)
        return fmt::format("No setting meets {}. Closest: {}.", describe_requirements(requirements),
                           what);
    const std::string margin = describe_margin(advice.best->judgement, requirements);
    return margin.empty() ? fmt::format("{}: the most accurate within {}.", what,
                                        describe_requirements(requirements))
                          : fmt::format("{}; that is {}.", what, margin);
}

std::string beside(const char* role, const TradeoffRow& row, const Advice& advice,
                   const Reference& reference) {
    if (!row.judgement.stable)
        return fmt::format("{}: {}, unstable.", role, describe(row.stepping));
    const double times = row.ns_per_second / advice.best->ns_per_second;
    return fmt::format("{}: {}, {}, {}{}.", role, describe(row.stepping),
                       describe_error(row.judgement, reference), describe_cost(row),
                       std::isfinite(times) ? fmt::format(", {:.3g} times the cost", times) : "");
}

}  // namespace

std::string describe(const Stepping& choice) {
    return fmt::format("{} at {} Hz in {}", choice.method->name, choice.rate.steps,
                       name_of(choice.precision));
}

std::vector<std::string> describe(const Advice& advice, const Scene& scene,
                                  const Reference& reference, const Requirements& requirements) {
    std::vector<std::string> words{conclusion(advice, reference, requirements)};
    for (const std::string& obstacle : advice.obstacles)
        words.push_back("Obstacle: " + obstacle + ".");
    if (!advice.best) return words;
    if (advice.runner_up)
        words.push_back(beside("Runner-up", *advice.runner_up, advice, reference));
    if (advice.current)
        words.push_back(beside("Current setting", *advice.current, advice, reference));
    for (const Alternative& alternative : advice.alternatives)
        words.push_back(fmt::format("Not {}: {}.", alternative.method->name, alternative.why));
    words.push_back(fmt::format(
        "Errors are the largest distance of any body from the reference in {:.4g} s, sampled {} "
        "times per second; between steps, runs follow the straight line that is drawn. Reference: "
        "{}.",
        std::min(scene.duration, reference.meaningful_until()), reference.samples.per_second,
        reference.words));
    return words;
}

}  // namespace oiler::lab
