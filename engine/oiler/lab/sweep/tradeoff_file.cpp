// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/core/version.hpp"
#include "oiler/lab/sweep/json.hpp"

namespace oiler::lab {
namespace {

using Parsed = nlohmann::json;

double to_number(const Parsed& json) { return json.is_null() ? unknown : json.get<double>(); }

Precision to_precision(const std::string& name) {
    for (const Precision precision : {Precision::single, Precision::double_})
        if (name == name_of(precision)) return precision;
    fail(Exit::usage, "precision: expected float or double, got {}", name);
}

Stepping to_stepping(const Parsed& json) {
    Stepping stepping{&find_method(json.at("method").get<std::string>()),
                      {json.at("rate").get<std::int64_t>()},
                      to_precision(json.at("precision"))};
    const Parsed& damping = json.at("damping");
    if (!damping.is_null() && damping != name_of(stepping.method->damping))
        stepping.damping = damping == "kick" ? Damping::in_kick : Damping::in_drift;
    return stepping;
}

TradeoffRow to_row(const Parsed& json) {
    TradeoffRow row{.stepping = to_stepping(json)};
    row.judgement.stable = json.at("stable");
    for (const RowNumber& number : row_numbers) number.of(row) = to_number(json.at(number.name));
    return row;
}

ReferenceSummary to_reference(const Parsed& json) {
    return {
        .words = json.at("words"),
        .closed_form = json.at("closed_form"),
        .position_error = json.at("position_error"),
        .velocity_error = json.at("velocity_error"),
        .floor = {json.at("position_floor"), json.at("velocity_floor"), json.at("energy_floor")},
        .extent = json.at("extent"),
        .meaningful_until = json.at("meaningful_until"),
        .why_no_longer = json.at("why_no_longer"),
        .period = to_number(json.at("period"))};
}

Tradeoff from_json(const Parsed& json) {
    Tradeoff tradeoff{.scene = json.at("scene"),
                      .title = json.at("title"),
                      .fingerprint = json.at("fingerprint"),
                      .duration = json.at("duration"),
                      .current = to_stepping(json.at("current")),
                      .reference = to_reference(json.at("reference"))};
    for (const Parsed& machine : json.at("machines"))
        tradeoff.machines.push_back(
            {machine.at("cpu"), machine.at("cores"), machine.at("compiler")});
    for (const Parsed& ladder : json.at("ladders"))
        tradeoff.ladders.push_back({.method = &find_method(ladder.at("method").get<std::string>()),
                                    .precision = to_precision(ladder.at("precision")),
                                    .end = ladder.at("end"),
                                    .done = ladder.at("done")});
    for (const Parsed& json_row : json.at("rows")) {
        const TradeoffRow row = to_row(json_row);
        for (Ladder& ladder : tradeoff.ladders)
            if (ladder.method == row.stepping.method && ladder.precision == row.stepping.precision)
                ladder.rows.push_back(row);
    }
    return tradeoff;
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string to_json(const Tradeoff& tradeoff) { return json_of(tradeoff).dump(1) + "\n"; }

Tradeoff parse_tradeoff(std::string_view text, std::string_view file) try {
    const Parsed json = Parsed::parse(text);
    if (json.at("oiler") != version())
        fail(Exit::usage, "expected a file of oiler {1}, got one of {0}; measure again",
             json.at("oiler").get<std::string>(), version());
    return from_json(json);
} catch (const Error& error) {
    throw Error(error.exit(), fmt::format("{}: {}", file, error.what()));
} catch (const Parsed::exception& error) {
    fail(Exit::usage, "{}: not a valid file of oiler tradeoff ({})", file, error.what());
}

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
