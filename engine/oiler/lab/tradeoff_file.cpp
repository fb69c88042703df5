// SPDX-License-Identifier: MIT
#include "oiler/lab/tradeoff_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/core/version.hpp"

namespace oiler {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double to_number(const Json& json) { return json.is_null() ? unknown : json.get<double>(); }

Precision to_precision(const std::string& name) {
    for (const Precision precision : {Precision::single, Precision::double_})
        if (name == name_of(precision)) return precision;
    fail(Exit::usage, "no precision is called {}: float or double", name);
}

Json to_json(const SceneChoice& choice) {
    return {{"method", choice.method->name},
            {"rate", choice.rate},
            {"precision", name_of(choice.precision)}};
}

SceneChoice to_choice(const Json& json) {
    return {&find_method(json.at("method").get<std::string>()), json.at("rate"),
            to_precision(json.at("precision"))};
}

/// A row's measured numbers by their names in files.
struct Field {
    const char* name;
    double& (*of)(TradeoffRow& row);
};
constexpr Field fields[]{
    {"position_error", [](TradeoffRow& row) -> double& { return row.judgement.position_error; }},
    {"velocity_error", [](TradeoffRow& row) -> double& { return row.judgement.velocity_error; }},
    {"phase_error", [](TradeoffRow& row) -> double& { return row.judgement.phase_error; }},
    {"energy_drift", [](TradeoffRow& row) -> double& { return row.judgement.energy_drift; }},
    {"evaluations", [](TradeoffRow& row) -> double& { return row.judgement.evaluations; }},
    {"ns_per_second", [](TradeoffRow& row) -> double& { return row.ns_per_second; }},
    {"ns_spread", [](TradeoffRow& row) -> double& { return row.ns_spread; }},
};

Json to_json(TradeoffRow row) {
    Json json = to_json(row.choice);
    json["stable"] = row.judgement.stable;
    json["meets_steps"] = row.meets_steps;
    json["below_floor"] = row.judgement.below_floor();
    for (const Field& field : fields) json[field.name] = number(field.of(row));
    return json;
}

TradeoffRow to_row(const Json& json) {
    TradeoffRow row{.choice = to_choice(json), .meets_steps = json.at("meets_steps")};
    row.judgement.stable = json.at("stable");
    for (const Field& field : fields) field.of(row) = to_number(json.at(field.name));
    return row;
}

Json to_json(const ReferenceSummary& reference) {
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

ReferenceSummary to_reference(const Json& json) {
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

Json to_json(const Machine& machine) {
    return {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}};
}

Tradeoff from_json(const Json& json) {
    Tradeoff tradeoff{.scene = json.at("scene"),
                      .title = json.at("title"),
                      .fingerprint = json.at("fingerprint"),
                      .duration = json.at("duration"),
                      .today = to_choice(json.at("today")),
                      .looks = {json.at("looks_per_second"), json.at("looks")},
                      .reference = to_reference(json.at("reference"))};
    for (const Json& machine : json.at("machines"))
        tradeoff.machines.push_back(
            {machine.at("cpu"), machine.at("cores"), machine.at("compiler")});
    for (const Json& ladder : json.at("ladders"))
        tradeoff.ladders.push_back({.method = &find_method(ladder.at("method").get<std::string>()),
                                    .precision = to_precision(ladder.at("precision")),
                                    .end = ladder.at("end"),
                                    .done = ladder.at("done")});
    for (const Json& json_row : json.at("rows")) {
        const TradeoffRow row = to_row(json_row);
        for (Ladder& ladder : tradeoff.ladders)
            if (ladder.method == row.choice.method && ladder.precision == row.choice.precision)
                ladder.rows.push_back(row);
    }
    return tradeoff;
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string to_json(const Tradeoff& tradeoff) {
    Json json{{"oiler", version()},
              {"scene", tradeoff.scene},
              {"title", tradeoff.title},
              {"fingerprint", tradeoff.fingerprint},
              {"complete", tradeoff.complete()},
              {"duration", tradeoff.duration},
              {"looks_per_second", tradeoff.looks.per_second},
              {"looks", tradeoff.looks.count},
              {"today", to_json(tradeoff.today)},
              {"reference", to_json(tradeoff.reference)},
              {"machines", Json::array()},
              {"ladders", Json::array()},
              {"rows", Json::array()}};
    for (const Machine& machine : tradeoff.machines) json["machines"].push_back(to_json(machine));
    for (const Ladder& ladder : tradeoff.ladders)
        json["ladders"].push_back({{"method", ladder.method->name},
                                   {"precision", name_of(ladder.precision)},
                                   {"done", ladder.done},
                                   {"end", ladder.end}});
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* row : tradeoff.rows()) {
        Json one = to_json(*row);
        one["pareto"] = std::find(front.begin(), front.end(), row) != front.end();
        json["rows"].push_back(std::move(one));
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Tradeoff parse_tradeoff(std::string_view text, std::string_view file) try {
    const Json json = Json::parse(text);
    if (json.at("oiler") != version())
        fail(Exit::usage, "it is of version {} of oiler, this is {}: measure again",
             json.at("oiler").get<std::string>(), version());
    return from_json(json);
} catch (const Error& error) {
    throw Error(error.exit(), fmt::format("{}: {}", file, error.what()));
} catch (const Json::exception& error) {
    fail(Exit::usage, "{}: it is not what oiler tradeoff writes ({})", file, error.what());
}

std::string to_csv(const Tradeoff& tradeoff) {
    std::string text = "method,rate,precision,stable,meets_steps,below_floor,pareto";
    for (const Field& field : fields) text += fmt::format(",{}", field.name);
    text += "\n";
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* found : tradeoff.rows()) {
        TradeoffRow row = *found;
        const bool best = std::find(front.begin(), front.end(), found) != front.end();
        text += fmt::format("{},{},{},{:d},{:d},{:d},{:d}", row.choice.method->name,
                            row.choice.rate, name_of(row.choice.precision), row.judgement.stable,
                            row.meets_steps, row.judgement.below_floor(), best);
        for (const Field& field : fields) text += fmt::format(",{}", cell(field.of(row)));
        text += "\n";
    }
    return text;
}

std::string fingerprint(std::string_view scene_text, const Scene& scene, const Looks& looks,
                        const SweepPlan& plan) {
    std::string all = fmt::format("{}|{}|{}|{}|{}|{}|", version(), scene.duration, looks.per_second,
                                  looks.count, plan.max_rate, plan.most_work);
    for (const Precision precision : plan.precisions) all += fmt::format("{},", name_of(precision));
    for (const Method* method : plan.methods) all += fmt::format("{},", method->name);
    all += scene_text;
    StateHash hash;
    hash.add(std::as_bytes(std::span(all)));
    return hash_text(hash.value());
}

}  // namespace oiler
