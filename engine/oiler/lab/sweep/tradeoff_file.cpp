// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "oiler/core/state_hash.hpp"
#include "oiler/core/version.hpp"
#include "oiler/lab/sweep/json.hpp"

namespace oiler::lab {
namespace {

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string to_json(const Tradeoff& tradeoff) { return json_of(tradeoff).dump(1) + "\n"; }

std::string to_csv(const Tradeoff& tradeoff) {
    std::string text = "method,rate,precision,stable,below_floor,pareto";
    for (const RowNumber& number : row_numbers) text += fmt::format(",{}", number.name);
    text += "\n";
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* found : tradeoff.rows()) {
        TradeoffRow row = *found;
        const bool best = std::find(front.begin(), front.end(), found) != front.end();
        text += fmt::format("{},{},{},{:d},{:d},{:d}", row.stepping.method->name,
                            row.stepping.rate.steps, name_of(row.stepping.precision),
                            row.judgement.stable, row.judgement.below_floor(), best);
        for (const RowNumber& number : row_numbers)
            text += fmt::format(",{}", cell(number.of(row)));
        text += "\n";
    }
    return text;
}

std::string fingerprint(std::string_view scene_text, const Scene& scene, const SweepPlan& plan) {
    std::string all =
        fmt::format("{}|{}|{}|{}|", version(), scene.duration, plan.max_rate, plan.most_work);
    for (const Precision precision : plan.precisions) all += fmt::format("{},", name_of(precision));
    for (const Method* method : plan.methods) all += fmt::format("{},", method->name);
    all += scene_text;
    StateHash hash;
    hash.add(std::as_bytes(std::span(all)));
    return hash_text(hash.value());
}

}  // namespace oiler::lab
