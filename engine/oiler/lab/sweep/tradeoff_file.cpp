// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_file.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

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

/// All of its numbers, as a text in which unknown ones are equal.
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

/// Adds the measurements of `part` to `whole`. `files` are the files of the measured series of
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

using Parsed = nlohmann::json;

/// A value of the file and its place in it, for messages: "rows[3].rate".
class Field {
public:
    Field(const Parsed& json, std::string place) : json_(json), place_(std::move(place)) {}

    [[nodiscard]] Field operator[](const char* name) const {
        const std::string place = place_.empty() ? name : fmt::format("{}.{}", place_, name);
        if (!json_.is_object()) refuse("an object");
        const auto found = json_.find(name);
        if (found == json_.end()) fail(Exit::usage, "{} is missing", place);
        return {*found, place};
    }
    [[nodiscard]] std::vector<Field> items() const {
        if (!json_.is_array()) refuse("an array");
        std::vector<Field> all;
        for (const Parsed& item : json_)
            all.emplace_back(item, fmt::format("{}[{}]", place_, all.size()));
        return all;
    }
    [[nodiscard]] bool is_null() const { return json_.is_null(); }
    [[nodiscard]] std::string text() const {
        if (!json_.is_string()) refuse("a text");
        return json_.get<std::string>();
    }
    [[nodiscard]] bool flag() const {
        if (!json_.is_boolean()) refuse("true or false");
        return json_.get<bool>();
    }
    [[nodiscard]] std::int64_t whole(std::uint64_t low, std::uint64_t high) const {
        // Negative numbers are not unsigned.
        if (!json_.is_number_unsigned() || json_.get<std::uint64_t>() < low ||
            json_.get<std::uint64_t>() > high)
            refuse(fmt::format("a whole number from {} to {}", low, high));
        return json_.get<std::int64_t>();
    }
    [[nodiscard]] double number() const {
        if (!json_.is_number()) refuse("a number");
        return json_.get<double>();
    }
    [[nodiscard]] double positive() const {
        if (!json_.is_number() || !(json_.get<double>() > 0)) refuse("a number above 0");
        return number();
    }
    [[nodiscard]] double size() const {
        if (!json_.is_number() || !(json_.get<double>() >= 0)) refuse("a number of 0 or more");
        return number();
    }
    [[noreturn]] void refuse(const std::string& expected) const {
        constexpr std::size_t most = 40;
        std::string got = json_.dump();
        if (got.size() > most) got = got.substr(0, most) + "…";
        fail(Exit::usage, "{}: expected {}, got {}", place_, expected, got);
    }

private:
    const Parsed& json_;
    std::string place_;
};

const Method& to_method(const Field& field) {
    const std::string name = field.text();
    for (const Method& method : methods())
        if (method.name == name) return method;
    field.refuse("a name of `oiler methods`");
}

Precision to_precision(const Field& field) {
    if (const auto precision = find_precision(field.text())) return *precision;
    field.refuse("float or double");
}

Rate to_rate(const Field& field) {
    constexpr std::uint64_t highest = 1'000'000;
    return {field.whole(1, highest)};
}

/// Only splitting methods have a choice.
std::optional<Damping> to_damping(const Field& field, const Method& method) {
    if (!std::holds_alternative<Splitting>(method.rule)) {
        if (!field.is_null()) field.refuse("null for a method that does not split");
        return std::nullopt;
    }
    const auto damping = find_damping(field.text());
    if (!damping) field.refuse("kick or drift");
    return damping == method.damping ? std::nullopt : damping;
}

Stepping to_stepping(const Field& field) {
    const Method& method = to_method(field["method"]);
    return {&method, to_rate(field["rate"]), to_precision(field["precision"]),
            to_damping(field["damping"], method)};
}

/// A phase may be negative; all other numbers are sizes. Null is an unknown number.
double to_measured(const Field& field, std::string_view name) {
    if (field.is_null()) return unknown;
    return name == "phase_error" ? field.number() : field.size();
}

TradeoffRow to_row(const Field& field) {
    TradeoffRow row{.stepping = to_stepping(field)};
    row.judgement.stable = field["stable"].flag();
    for (const RowNumber& number : row_numbers)
        number.of(row) = to_measured(field[number.name], number.name);
    const Field below_floor = field["below_floor"];
    if (below_floor.flag() != row.judgement.below_floor())
        below_floor.refuse("what position_error says");
    return row;
}

ReferenceSummary to_reference(const Field& field) {
    const Field period = field["period"];
    return {.words = field["words"].text(),
            .closed_form = field["closed_form"].flag(),
            .position_error = field["position_error"].size(),
            .velocity_error = field["velocity_error"].size(),
            .floor = {field["position_floor"].size(), field["velocity_floor"].size(),
                      field["energy_floor"].size()},
            .extent = field["extent"].size(),
            .meaningful_until = field["meaningful_until"].positive(),
            .why_no_longer = field["why_no_longer"].text(),
            .period = period.is_null() ? unknown : period.positive()};
}

Machine to_machine(const Field& field) {
    constexpr std::uint64_t most_cores = 1'000'000;
    return {field["cpu"].text(), static_cast<int>(field["cores"].whole(1, most_cores)),
            field["compiler"].text()};
}

std::string to_fingerprint(const Field& field) {
    std::string text = field.text();
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    if (text.size() != 16 || !std::ranges::all_of(text, is_digit))
        field.refuse("16 hexadecimal digits");
    return text;
}

RateSeries to_series(const Field& field) {
    RateSeries series{.method = &to_method(field["method"]),
                      .precision = to_precision(field["precision"]),
                      .end = field["end"].text(),
                      .done = field["done"].flag()};
    if (series.done == series.end.empty())
        field["end"].refuse(series.done ? "the reason of the end of a ladder that is done"
                                        : "no text for a ladder that is not done");
    return series;
}

/// Each method once in each precision.
std::vector<RateSeries> to_all_series(const Field& field) {
    std::vector<RateSeries> all_series;
    std::set<std::pair<const Method*, Precision>> all;
    std::set<const Method*> methods;
    std::set<Precision> precisions;
    for (const Field& item : field.items()) {
        const RateSeries& series = all_series.emplace_back(to_series(item));
        methods.insert(series.method);
        precisions.insert(series.precision);
        if (!all.emplace(series.method, series.precision).second)
            item.refuse("each method once in each precision");
    }
    if (all_series.empty() || all.size() != methods.size() * precisions.size())
        field.refuse("each method in each precision");
    return all_series;
}

void add_row(std::vector<RateSeries>& all_series, const Field& field) {
    TradeoffRow row = to_row(field);
    const auto series = std::ranges::find_if(all_series, [&](const RateSeries& one) {
        return one.method == row.stepping.method && one.precision == row.stepping.precision;
    });
    if (series == all_series.end() || !series->done) field.refuse("a row of a ladder that is done");
    if (!series->rows.empty() && row.stepping.rate.steps <= series->rows.back().stepping.rate.steps)
        field["rate"].refuse("a higher rate than in the row before");
    series->rows.push_back(std::move(row));
}

std::string hash_of(std::string_view text) {
    StateHash hash;
    hash.add(std::as_bytes(std::span(text)));
    return hash_text(hash.value());
}

/// Changes with each value, but not with spaces between them.
std::string seal_of(const Json& tradeoff) { return hash_of(tradeoff.dump(1)); }

/// Fields that follow from the others must agree with them.
void check_derived(const Field& field, const Tradeoff& tradeoff) {
    if (field["complete"].flag() != tradeoff.complete())
        field["complete"].refuse("what the ladders say");
    std::set<std::string> front;
    for (const TradeoffRow* row : pareto(tradeoff, time_of)) front.insert(describe(row->stepping));
    for (const Field& row : field["rows"].items())
        if (row["pareto"].flag() != front.contains(describe(to_stepping(row))))
            row["pareto"].refuse("what errors and times say");
}

Tradeoff to_tradeoff(const Field& field) {
    Tradeoff tradeoff{.scene = field["scene"].text(),
                      .title = field["title"].text(),
                      .fingerprint = to_fingerprint(field["fingerprint"]),
                      .duration = field["duration"].positive(),
                      .current = to_stepping(field["current"]),
                      .reference = to_reference(field["reference"]),
                      .all_series = to_all_series(field["ladders"])};
    if (tradeoff.reference.meaningful_until > tradeoff.duration)
        field["reference"]["meaningful_until"].refuse("at most the duration");
    for (const Field& machine : field["machines"].items())
        tradeoff.machines.push_back(to_machine(machine));
    if (tradeoff.machines.empty()) field["machines"].refuse("a machine");
    for (const Field& row : field["rows"].items()) add_row(tradeoff.all_series, row);
    check_derived(field, tradeoff);
    if (const std::string seal = seal_of(lab::to_json(tradeoff)); field["seal"].text() != seal)
        fail(Exit::usage, "values were changed after they were measured: their seal is {}, not {}",
             seal, field["seal"].text());
    return tradeoff;
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

std::string file_text(const Tradeoff& tradeoff) {
    Json json = to_json(tradeoff);
    json["seal"] = seal_of(json);
    return json.dump(1) + "\n";
}

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
    return hash_of(all);
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

Tradeoff parse_tradeoff(std::string_view text, std::string_view file, std::string_view remedy) try {
    const Parsed json = Parsed::parse(text);
    const Field whole(json, "");
    if (const std::string from = whole["oiler"].text(); from != version())
        fail(Exit::usage, "expected a file of oiler {}, got one of {}", version(), from);
    Tradeoff tradeoff = to_tradeoff(whole);
    tradeoff.file = file;
    return tradeoff;
} catch (const Error& error) {
    throw Error(error.exit(), fmt::format("{}: {}; {}", file, error.what(), remedy));
} catch (const Parsed::exception& error) {
    fail(Exit::usage, "{}: not a valid file of oiler tradeoff ({}); {}", file, error.what(),
         remedy);
}

}  // namespace oiler::lab
