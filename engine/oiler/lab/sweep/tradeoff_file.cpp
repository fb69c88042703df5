// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/core/version.hpp"

namespace oiler::lab {
namespace {

Json to_json(const Machine& machine) {
    return {{"cpu", machine.cpu}, {"cores", machine.cores}, {"compiler", machine.compiler}};
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
            {"period", reference.period}};
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string name_of(const RateSeries& series) {
    return fmt::format("{} in {}", series.method->name, oiler::name_of(series.precision));
}

bool is_same_series(const RateSeries& a, const RateSeries& b) {
    return a.method == b.method && a.precision == b.precision;
}

/// All of its numbers, of which unknown ones are equal here.
std::string text_of(const ReferenceSummary& reference) { return to_json(reference).dump(1); }

void require_same_sweep(const Tradeoff& part, const Tradeoff& first) {
    const bool same = part.fingerprint == first.fingerprint && part.scene == first.scene &&
                      part.title == first.title && part.duration == first.duration &&
                      part.current == first.current &&
                      text_of(part.reference) == text_of(first.reference) &&
                      std::ranges::equal(part.all_series, first.all_series, is_same_series);
    if (!same)
        fail(Exit::usage,
             "{}: not of one sweep with {}: the scene, the options or the version differ; give "
             "parts of one sweep",
             part.file, first.file);
}

/// Adds what `part` has measured to `whole`. `files` are those that measured the series of
/// `whole`.
void add(const Tradeoff& part, Tradeoff& whole, std::vector<std::string>& files) {
    for (const Machine& machine : part.machines)
        if (std::ranges::find(whole.machines, machine) == whole.machines.end())
            whole.machines.push_back(machine);
    for (std::size_t i = 0; i < part.all_series.size(); ++i) {
        if (!part.all_series[i].done) continue;
        if (whole.all_series[i].done)
            fail(Exit::usage, "{}: {} is in {}, too; give each part once", part.file,
                 name_of(part.all_series[i]), files[i]);
        whole.all_series[i] = part.all_series[i];
        files[i] = part.file;
    }
}

std::string list_files(const std::vector<Tradeoff>& parts) {
    constexpr std::size_t most = 8;
    std::string list;
    for (std::size_t i = 0; i < parts.size() && i < most; ++i)
        list += (i == 0 ? "" : ", ") + parts[i].file;
    return parts.size() > most ? list + ", …" : list;
}

}  // namespace

Json to_json(const TradeoffRow& row) {
    Json json = to_json(row.stepping);
    json["stable"] = row.judgement.stable;
    json["below_floor"] = row.judgement.below_floor();
    TradeoffRow copy = row;
    for (const RowNumber& one : row_numbers) json[one.name] = one.of(copy);
    return json;
}

Json to_json(const Tradeoff& tradeoff) {
    Json json{{"oiler", version()},
              {"scene", tradeoff.scene},
              {"title", tradeoff.title},
              {"fingerprint", tradeoff.fingerprint},
              {"complete", tradeoff.complete()},
              {"duration", tradeoff.duration},
              {"current", to_json(tradeoff.current)},
              {"reference", to_json(tradeoff.reference)},
              {"machines", Json::array()},
              {"ladders", Json::array()},
              {"rows", Json::array()}};
    for (const Machine& machine : tradeoff.machines) json["machines"].push_back(to_json(machine));
    for (const RateSeries& series : tradeoff.all_series)
        json["ladders"].push_back({{"method", series.method->name},
                                   {"precision", name_of(series.precision)},
                                   {"done", series.done},
                                   {"end", series.end}});
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* row : tradeoff.rows()) {
        Json one = to_json(*row);
        one["pareto"] = std::ranges::find(front, row) != front.end();
        json["rows"].push_back(std::move(one));
    }
    return json;
}

std::string file_text(const Tradeoff& tradeoff) { return to_json(tradeoff).dump(1) + "\n"; }

std::string to_csv(const Tradeoff& tradeoff) {
    std::string text = "method,rate,precision,stable,below_floor,pareto";
    for (const RowNumber& number : row_numbers) text += fmt::format(",{}", number.name);
    text += "\n";
    const auto front = pareto(tradeoff, time_of);
    for (const TradeoffRow* found : tradeoff.rows()) {
        TradeoffRow row = *found;
        const bool best = std::ranges::find(front, found) != front.end();
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

Tradeoff merge(const std::vector<Tradeoff>& parts) {
    Tradeoff whole = parts.front();
    whole.file.clear();
    for (RateSeries& series : whole.all_series)
        series = {.method = series.method, .precision = series.precision};
    std::vector<std::string> files(whole.all_series.size());
    for (const Tradeoff& part : parts) {
        require_same_sweep(part, parts.front());
        add(part, whole, files);
    }
    const auto is_missing = [](const RateSeries& series) { return !series.done; };
    const auto missing = std::ranges::count_if(whole.all_series, is_missing);
    if (missing > 0)
        fail(Exit::usage,
             "{}: {} of {} ladders (methods × precisions) are missing, first {}; give all parts, "
             "and run the command of an interrupted part again",
             list_files(parts), missing, whole.all_series.size(),
             name_of(*std::ranges::find_if(whole.all_series, is_missing)));
    return whole;
}

}  // namespace oiler::lab
