// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <future>
#include <span>
#include <thread>
#include <tuple>
#include <utility>

#include "oiler/capture/capture_folder.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/compare/runs/divergence.hpp"
#include "oiler/compare/runs/state_log.hpp"
#include "oiler/core/beside.hpp"
#include "oiler/core/floating_point.hpp"

namespace oiler::cli {
namespace {

/// Two runs and their differences.
struct DivergeResult {
    StateLog a;
    StateLog b;
    RunDivergence divergence;
    /// The first tick whose hashes differ, in two captures.
    std::optional<std::int64_t> first_hash{};

    [[nodiscard]] bool same() const { return divergence.same() && !first_hash; }
};

std::string ulps_text(std::uint64_t ulps) {
    return ulps == not_in_ulps ? "-" : fmt::format("{}", ulps);
}

/// A number, or "'bob'" if the run names its bodies.
std::string name_of(std::uint32_t body, const StateLog& log) {
    return body < log.names.size() ? fmt::format("'{}'", log.names[body]) : fmt::to_string(body);
}

std::string describe(const RunDivergence::Value& value, const StateLog& log) {
    const int axes = log.axes;
    std::string text = fmt::format("body {}, {}: {} and {}, ", name_of(value.body, log),
                                   field_name(axes, value.field), value.a, value.b);
    if (value.ulps == 0) return text + "which differ only in their signs";
    if (value.ulps == not_in_ulps) return text + "of which one is not a number";
    return text + fmt::format("{} ulp ({:.2g} {})", value.ulps, value.distance,
                              field_unit(axes, value.field));
}

/// For example "bodies 3, 4 are only in a.csv"; the text has the first ten bodies.
std::string describe(std::span<const std::uint32_t> bodies, const StateLog& log) {
    constexpr std::size_t most = 10;
    std::vector<std::string> first;
    for (const std::uint32_t body : bodies.first(std::min(most, bodies.size())))
        first.push_back(name_of(body, log));
    const std::string more =
        bodies.size() > most ? fmt::format(" and {} more", bodies.size() - most) : "";
    return fmt::format("{} {}{} {} only in {}", bodies.size() == 1 ? "body" : "bodies",
                       fmt::join(first, ", "), more, bodies.size() == 1 ? "is" : "are", log.name);
}

std::string describe(const RunDivergence::Presence& presence, const DivergeResult& result) {
    std::string text;
    if (!presence.only_a.empty()) text = describe(presence.only_a, result.a);
    if (!text.empty() && !presence.only_b.empty()) text += "; ";
    if (!presence.only_b.empty()) text += describe(presence.only_b, result.b);
    return text;
}

/// A difference and its tick.
struct Finding {
    std::int64_t tick = 0;
    double time = 0;
    std::string text;
};

/// The findings in the order of their ticks. At the same tick the likely cause comes first.
std::vector<Finding> findings_of(const DivergeResult& result) {
    const RunDivergence& found = result.divergence;
    std::vector<Finding> findings;
    if (found.times)
        findings.push_back(
            {found.times->tick, found.times->a,
             fmt::format("the time is {} s in {} and {} s in {}, because their "
                         "rates differ",
                         found.times->a, result.a.name, found.times->b, result.b.name)});
    if (found.presence)
        findings.push_back(
            {found.presence->tick, found.presence->time, describe(*found.presence, result)});
    if (found.value)
        findings.push_back(
            {found.value->tick, found.value->time, describe(*found.value, result.a)});
    std::ranges::stable_sort(findings, {}, &Finding::tick);
    return findings;
}

std::string explain_precision(const DivergeResult& result) {
    if (result.divergence.floats)
        return "1 ulp is that of float: all numbers of both files are shortest digits of floats.";
    if (result.a.floats == result.b.floats)
        return "1 ulp is that of double: both files have numbers with more digits than a float.";
    const auto& [single, other] = result.a.floats ? std::tie(result.a.name, result.b.name)
                                                  : std::tie(result.b.name, result.a.name);
    return fmt::format(
        "1 ulp is that of double: only {} has numbers with more digits than a float. The run of "
        "{} may be in float.",
        other, single);
}

std::string table_of(const std::vector<RunDivergence::Growth>& growth, const StateLog& log) {
    std::string text = fmt::format("\n{:>10} {:>12} {:>12} {:>20}  body\n", "tick", "time, s",
                                   "distance, m", "ulp");
    for (const RunDivergence::Growth& row : growth)
        text += fmt::format("{:>10} {:>12.6g} {:>12.3g} {:>20}  {}\n", row.tick, row.time,
                            row.distance, ulps_text(row.ulps), name_of(row.body, log));
    return text;
}

/// Tells which run is longer; empty if both have the same last tick.
std::string describe_rest(const DivergeResult& result) {
    const std::int64_t last = result.divergence.last_tick;
    const StateLog& longer = result.a.ticks.back().tick > last ? result.a : result.b;
    if (longer.ticks.back().tick == last) return {};
    return fmt::format("{} continues to tick {}; its ticks after {} are not compared.\n",
                       longer.name, longer.ticks.back().tick, last);
}

std::string count_bodies(std::size_t count) {
    return fmt::format("{} {}", count, count == 1 ? "body" : "bodies");
}

std::string describe_same(const RunDivergence& divergence) {
    return fmt::format("The runs are the same: ticks {} to {} ({:g} s), {}.\n",
                       divergence.first_tick, divergence.last_tick, divergence.last_time,
                       count_bodies(divergence.bodies));
}

std::string describe_differences(const DivergeResult& result) {
    std::string text;
    const std::string start =
        fmt::format("The {} first differ at", result.first_hash ? "frames" : "runs");
    for (const Finding& finding : findings_of(result))
        text += fmt::format("{} tick {} ({:g} s): {}.\n", text.empty() ? start : "At", finding.tick,
                            finding.time, finding.text);
    if (!result.divergence.value) return text;
    const RunDivergence::Value& value = *result.divergence.value;
    if (value.bodies > 1)
        text +=
            fmt::format("The numbers of {} bodies differ at tick {}.\n", value.bodies, value.tick);
    return text + explain_precision(result) + "\n";
}

std::string text_of(const DivergeResult& result) {
    const RunDivergence& divergence = result.divergence;
    std::string text;
    if (result.first_hash)
        text = fmt::format("The hashes first differ at tick {}. States are those of the frames.\n",
                           *result.first_hash);
    if (!divergence.same())
        text += describe_differences(result);
    else if (result.first_hash)
        text += "The frames have the same positions and velocities.\n";
    else
        text += describe_same(divergence);
    text += describe_rest(result);
    return divergence.growth.empty() ? text : text + table_of(divergence.growth, result.a);
}

Json ulps_json(std::uint64_t ulps) { return ulps == not_in_ulps ? Json(nullptr) : Json(ulps); }

Json to_json(const RunDivergence::Value& value, int axes) {
    return {{"tick", value.tick},
            {"time", value.time},
            {"body", value.body},
            {"field", field_name(axes, value.field)},
            {"a", number(value.a)},
            {"b", number(value.b)},
            {"ulps", ulps_json(value.ulps)},
            {"distance", number(value.distance)},
            {"unit", field_unit(axes, value.field)},
            {"bodies_that_differ", value.bodies}};
}

Json to_json(const RunDivergence::Presence& presence) {
    return {{"tick", presence.tick},
            {"time", presence.time},
            {"only_a", presence.only_a},
            {"only_b", presence.only_b}};
}

Json to_json(const RunDivergence::Growth& row) {
    return {{"tick", row.tick},
            {"time", row.time},
            {"distance", number(row.distance)},
            {"ulps", ulps_json(row.ulps)},
            {"body", row.body}};
}

Json to_json(const StateLog& log) {
    return {{"file", log.name},
            {"last_tick", log.ticks.back().tick},
            {"precision", log.floats ? "float" : "double"}};
}

Json to_json(const DivergeResult& result) {
    const RunDivergence& found = result.divergence;
    Json json{{"same", result.same()},
              {"a", to_json(result.a)},
              {"b", to_json(result.b)},
              {"first_tick", found.first_tick},
              {"last_tick", found.last_tick},
              {"last_time", found.last_time},
              {"bodies", found.bodies},
              {"precision", found.floats ? "float" : "double"},
              {"value", nullptr},
              {"presence", nullptr},
              {"times", nullptr},
              {"growth", Json::list(found.growth, [](const RunDivergence::Growth& row) {
                   return to_json(row);
               })}};
    if (result.first_hash) json["first_different_hash"] = *result.first_hash;
    if (found.value) json["value"] = to_json(*found.value, result.a.axes);
    if (found.presence) json["presence"] = to_json(*found.presence);
    if (found.times)
        json["times"] = {{"tick", found.times->tick}, {"a", found.times->a}, {"b", found.times->b}};
    return json;
}

/// Reads both files at once, if the machine gives another thread: a large trace takes seconds.
DivergeResult read_traces(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::jthread thread;
    std::future<StateLog> log_b = call_beside(thread, [&b] { return read_trace(b); });
    StateLog log_a = read_trace(a);
    return {std::move(log_a), log_b.get(), {}};
}

/// Returns whether the path is a capture, or its manifest.
bool is_capture(const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::is_directory(path, error) || path.filename() == manifest_name;
}

DivergeResult read(const std::filesystem::path& a, const std::filesystem::path& b) {
    if (is_capture(a) != is_capture(b))
        fail(Exit::usage, "{} and {}: give two traces or two captures", a.string(), b.string());
    if (!is_capture(a)) return read_traces(a, b);
    const Captured captured_a(a);
    const Captured captured_b(b);
    DivergeResult result{state_log_of(captured_a, {}), {}, {}};
    result.b = state_log_of(captured_b, result.a.names);
    result.a.names = result.b.names;
    keep_common_ticks(result.a, result.b);
    result.first_hash = first_different_tick(captured_a, captured_b);
    return result;
}

}  // namespace

struct DivergeCommand {
    static constexpr CommandTexts texts{
        .name = "diverge",
        .summary = "Find where two runs first differ, in traces or captures: exit 1 if they do",
        .example = "a.csv b.csv",
        .notes = "Runs of different lengths are compared up to the last tick of the shorter one."};

    std::filesystem::path a;
    std::filesystem::path b;
    std::filesystem::path json;

    void declare(Arguments& arguments) {
        arguments.add_required("A", a, "trace of a run, or folder of a capture", is_capture_file);
        arguments.add_required("B", b, "trace of another run, or folder of a capture",
                               is_capture_file);
        add_json(arguments, json);
    }

    [[nodiscard]] Exit run() const {
        DivergeResult result = read(a, b);
        result.divergence = find_divergence(result.a, result.b);
        if (!json.empty()) write_json(json, to_json(result));
        if (json != "-") print(text_of(result));
        return result.same() ? Exit::done : Exit::comparison_failed;
    }
};

template Command make_command<DivergeCommand>();

}  // namespace oiler::cli
