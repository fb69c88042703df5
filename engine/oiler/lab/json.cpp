// SPDX-License-Identifier: MIT
#include "oiler/lab/json.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/version.hpp"

namespace oiler {
namespace {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json optional_number(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const ReferenceSummary& reference) {
    return {{"words", reference.words},
            {"closed_form", reference.closed_form},
            {"position_error", reference.position_error},
            {"velocity_error", reference.velocity_error},
            {"position_floor", reference.floor.position},
            {"velocity_floor", reference.floor.velocity},
            {"energy_floor", reference.floor.energy},
            {"extent", reference.extent},
            {"meaningful_until", reference.meaningful_until},
            {"why_no_longer", reference.why_no_longer},
            {"period", number(reference.period)}};
}

Json json_of(const Machine& machine) {
    return {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}};
}

Json with_frame(const TradeoffRow& row) {
    Json json = oiler::json_of(row);
    json["us_per_frame"] = number(row.ns_per_second / 60'000);
    return json;
}

Json with_frame(const std::optional<TradeoffRow>& row) {
    return row ? with_frame(*row) : Json(nullptr);
}

Json alternatives_of(const Advice& advice) {
    Json list = Json::array();
    for (const Alternative& alternative : advice.alternatives) {
        Json one = alternative.row ? with_frame(*alternative.row)
                                   : Json{{"method", alternative.method->name}};
        one["why"] = alternative.why;
        list.push_back(std::move(one));
    }
    return list;
}

Json list_of(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number(value));
    return list;
}

}  // namespace

Json json_of(const SceneChoice& choice) {
    return {{"method", choice.method->name},
            {"rate", choice.rate},
            {"precision", name_of(choice.precision)}};
}

Json json_of(const TradeoffRow& row) {
    Json json = json_of(row.choice);
    json["stable"] = row.judgement.stable;
    json["meets_steps"] = row.meets_steps;
    json["below_floor"] = row.judgement.below_floor();
    TradeoffRow copy = row;
    for (const RowNumber& one : row_numbers) json[one.name] = number(one.of(copy));
    return json;
}

Json json_of(const Tradeoff& tradeoff) {
    Json json{{"oiler", version()},
              {"scene", tradeoff.scene},
              {"title", tradeoff.title},
              {"fingerprint", tradeoff.fingerprint},
              {"complete", tradeoff.complete()},
              {"duration", tradeoff.duration},
              {"looks_per_second", tradeoff.looks.per_second},
              {"looks", tradeoff.looks.count},
              {"today", json_of(tradeoff.today)},
              {"reference", json_of(tradeoff.reference)},
              {"machines", Json::array()},
              {"ladders", Json::array()},
              {"rows", Json::array()}};
    for (const Machine& machine : tradeoff.machines) json["machines"].push_back(json_of(machine));
    for (const Ladder& ladder : tradeoff.ladders)
        json["ladders"].push_back({{"method", ladder.method->name},
                                   {"precision", name_of(ladder.precision)},
                                   {"done", ladder.done},
                                   {"end", ladder.end}});
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* row : tradeoff.rows()) {
        Json one = json_of(*row);
        one["pareto"] = std::find(front.begin(), front.end(), row) != front.end();
        json["rows"].push_back(std::move(one));
    }
    return json;
}

Json json_of(const Advice& advice, const Scene& scene, const Reference& reference,
             const Wish& wish) {
    const Doubt floor = reference.floor();
    return {{"meets", advice.meets},
            {"advice", with_frame(advice.best)},
            {"runner_up", with_frame(advice.runner_up)},
            {"today", with_frame(advice.today)},
            {"alternatives", alternatives_of(advice)},
            {"obstacles", advice.obstacles},
            {"wish",
             {{"position_error", optional_number(wish.position_error)},
              {"energy_drift", optional_number(wish.energy_drift)},
              {"us_per_frame", wish.ns_per_second ? Json(*wish.ns_per_second / 60'000) : Json()}}},
            {"reference",
             {{"words", reference.words},
              {"closed_form", reference.closed_form},
              {"position_floor", floor.position},
              {"energy_floor", floor.energy},
              {"meaningful_until", reference.meaningful_until()}}},
            {"runs", advice.runs},
            {"words", words_of(advice, scene, reference, wish)}};
}

Json json_of(const Rates& rates) {
    Json quantities = Json::array();
    for (const RatesQuantity& quantity : rates.quantities) {
        Json lines = Json::array();
        for (const RatesLine& line : quantity.lines)
            lines.push_back({{"method", line.method->name},
                             {"values", list_of(line.values)},
                             {"spread_percent", number(line.spread_percent)}});
        quantities.push_back({{"name", quantity.name},
                              {"unit", quantity.unit},
                              {"body", rates.body},
                              {"truth", number(quantity.truth)},
                              {"methods", std::move(lines)}});
    }
    return {{"rates", rates.rates}, {"quantities", std::move(quantities)}};
}

}  // namespace oiler
