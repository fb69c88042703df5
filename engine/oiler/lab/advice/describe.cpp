// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <cmath>

#include "oiler/lab/advice/advise.hpp"

namespace oiler::lab {
namespace {

std::string error_words(const Judgement& judgement, const Reference& reference) {
    if (!judgement.stable) return "unstable";
    if (judgement.below_floor())
        return fmt::format("off by less than {:.2g} m", reference.floor().position);
    return fmt::format("off by up to {:.3g} m", judgement.position_error);
}

std::string cost_words(const TradeoffRow& row) {
    return fmt::format("{:.3g} µs of computing for a second of the scene", row.ns_per_second / 1e3);
}

/// How much of what was asked for it uses.
std::string margin_words(const Judgement& judgement, const Wish& wish) {
    std::string text;
    const auto add = [&](const std::optional<double>& most, double error, const char* of) {
        if (!most) return;
        text += text.empty() ? "" : ", ";
        text += std::isnan(error)
                    ? fmt::format("too little to be told of the {:g}{} allowed", *most, of)
                    : fmt::format("{:.3g} % of the {:g}{} allowed", 100 * error / *most, *most, of);
    };
    add(wish.position_error, judgement.position_error, " m");
    add(wish.energy_drift, judgement.energy_drift, " of energy drift");
    return text;
}

std::string wish_words(const Wish& wish) {
    std::string text;
    if (wish.position_error) text += fmt::format("{:g} m", *wish.position_error);
    if (wish.energy_drift)
        text += fmt::format("{}an energy drift of {:g}", text.empty() ? "" : " and ",
                            *wish.energy_drift);
    if (wish.ns_per_second)
        text += fmt::format("{}{:.4g} µs per frame", text.empty() ? "" : " and ",
                            *wish.ns_per_second / 60'000);
    return text;
}

std::string conclusion(const Advice& advice, const Reference& reference, const Wish& wish) {
    if (!advice.best) return fmt::format("Nothing keeps within {}.", wish_words(wish));
    const std::string what =
        fmt::format("{}: {}, {}{}", words_of(advice.best->stepping),
                    error_words(advice.best->judgement, reference), cost_words(*advice.best),
                    wish.ns_per_second
                        ? fmt::format(", {:.3g} µs per frame", advice.best->ns_per_second / 60'000)
                        : "");
    if (!advice.meets)
        return fmt::format("Nothing keeps within {}. Nearest comes {}.", wish_words(wish), what);
    const std::string margin = margin_words(advice.best->judgement, wish);
    return margin.empty() ? fmt::format("{}: the most accurate within {}.", what, wish_words(wish))
                          : fmt::format("{}; that is {}.", what, margin);
}

std::string beside(const char* role, const TradeoffRow& row, const Advice& advice,
                   const Reference& reference) {
    if (!row.judgement.stable) return fmt::format("{}: {}, unstable.", role, words_of(row.stepping));
    const double times = row.ns_per_second / advice.best->ns_per_second;
    return fmt::format("{}: {}, {}, {}{}.", role, words_of(row.stepping),
                       error_words(row.judgement, reference), cost_words(row),
                       std::isfinite(times) ? fmt::format(", {:.3g} times the cost", times) : "");
}

}  // namespace

std::string words_of(const Stepping& choice) {
    return fmt::format("{} at {} Hz in {}", choice.method->name, choice.rate.steps,
                       name_of(choice.precision));
}

std::vector<std::string> words_of(const Advice& advice, const Scene& scene,
                                  const Reference& reference, const Wish& wish) {
    std::vector<std::string> words{conclusion(advice, reference, wish)};
    for (const std::string& obstacle : advice.obstacles)
        words.push_back("In the way: " + obstacle + ".");
    if (!advice.best) return words;
    if (advice.runner_up)
        words.push_back(beside("Runner-up", *advice.runner_up, advice, reference));
    if (advice.today) words.push_back(beside("Today", *advice.today, advice, reference));
    for (const Alternative& alternative : advice.alternatives)
        words.push_back(fmt::format("Not {}: {}.", alternative.method->name, alternative.why));
    words.push_back(fmt::format(
        "Errors are the largest distance of any body in {:.4g} s from {}, looked at {} times a "
        "second; between steps a run is on the straight line that is drawn.",
        std::min(scene.duration, reference.meaningful_until()), reference.words,
        reference.looks.per_second));
    return words;
}

}  // namespace oiler::lab
