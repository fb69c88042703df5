// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/json.hpp"

#include "oiler/lab/sweep/json.hpp"

namespace oiler::lab {
namespace {

Json optional_number(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json with_frame(const TradeoffRow& row) {
    Json json = lab::json_of(row);
    json["us_per_frame"] = number_or_null(row.ns_per_second / 60'000);
    json["share_of_frame"] = number_or_null(row.ns_per_second / 1e9);
    json["latency_ms"] = 1e3 / static_cast<double>(row.stepping.rate.steps);
    return json;
}

Json with_frame(const std::optional<TradeoffRow>& row) {
    return row ? with_frame(*row) : Json(nullptr);
}

Json ties_of(const Advice& advice) {
    Json list = Json::array();
    for (const TradeoffRow& row : advice.ties) list.push_back(with_frame(row));
    return list;
}

Json growth_of(const Advice& advice, const Requirements& requirements) {
    if (!advice.best || !requirements.position_error) return nullptr;
    return {
        {"law", describe(advice.growth.law)},
        {"holds_until", number_or_null(advice.growth.holds_until(*requirements.position_error))}};
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

}  // namespace

Json json_of(const Advice& advice, const Scene& scene, const Reference& reference,
             const Requirements& requirements) {
    const Uncertainty floor = reference.floor();
    return {{"meets", advice.meets},
            {"advice", with_frame(advice.best)},
            {"perturbed_starts", advice.perturbed_starts},
            {"growth", growth_of(advice, requirements)},
            {"ties", ties_of(advice)},
            {"threads",
             {{"count", advice.threads}, {"ns_per_second", number_or_null(advice.ns_on_threads)}}},
            {"runner_up", with_frame(advice.runner_up)},
            {"current", with_frame(advice.current)},
            {"alternatives", alternatives_of(advice)},
            {"obstacles", advice.obstacles},
            {"requirements",
             {{"position_error", optional_number(requirements.position_error)},
              {"at_steps", requirements.at_steps},
              {"display", requirements.display > 0 ? Json(requirements.display) : Json("any")},
              {"energy_drift", optional_number(requirements.energy_drift)},
              {"us_per_frame",
               requirements.ns_per_second ? Json(*requirements.ns_per_second / 60'000) : Json()}}},
            {"reference",
             {{"words", reference.words},
              {"closed_form", reference.closed_form},
              {"position_floor", floor.position},
              {"energy_floor", floor.energy},
              {"meaningful_until", reference.meaningful_until}}},
            {"runs", advice.runs},
            {"words", describe(advice, scene, reference, requirements)}};
}

}  // namespace oiler::lab
