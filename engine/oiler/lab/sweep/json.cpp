// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/json.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/core/version.hpp"

namespace oiler::lab {
namespace {

Json json_of(const Machine& machine) {
    return {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}};
}

}  // namespace

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

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
            {"period", number_or_null(reference.period)}};
}

Json json_of(const TradeoffRow& row) {
    Json json = to_json(row.stepping);
    json["stable"] = row.judgement.stable;
    json["below_floor"] = row.judgement.below_floor();
    TradeoffRow copy = row;
    for (const RowNumber& one : row_numbers) json[one.name] = number_or_null(one.of(copy));
    return json;
}

Json json_of(const Tradeoff& tradeoff) {
    Json json{{"oiler", version()},
              {"scene", tradeoff.scene},
              {"title", tradeoff.title},
              {"fingerprint", tradeoff.fingerprint},
              {"complete", tradeoff.complete()},
              {"duration", tradeoff.duration},
              {"current", to_json(tradeoff.current)},
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

}  // namespace oiler::lab
