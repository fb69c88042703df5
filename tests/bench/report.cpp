// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/bench.hpp"

namespace oiler::bench {
namespace {

double seconds_of(const Work& work, long times) {
    const auto start = std::chrono::steady_clock::now();
    work(times);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The number of times that make a repetition; also warms up.
long times_for(const Work& work, double seconds) {
    long times = 1;
    for (;;) {
        const double took = seconds_of(work, times);
        if (took >= seconds) return times;
        const double more = took > 0 ? 1.2 * seconds / took : 10.0;
        times =
            static_cast<long>(std::ceil(static_cast<double>(times) * std::clamp(more, 1.2, 10.0)));
    }
}

/// The subject of each group of targets.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> groups{
    {{"T1", "one step per call: the in-place sweep over the same bytes, or the hand-written loop"},
     {"T2", "256 steps per call: the hand-written loop in registers"},
     {"T3", "methods from memory, relative to semi_implicit_euler; threads"},
     {"T4", "peers on the same work, relative to Oiler"},
     {"T5", "nets of springs, ns per spring and step"},
     {"T6", "entities, ns each; bytes for a body and its handle"},
     {"T7", "sleeping springs, relative to moving ones"},
     {"T8", "prices: a force left out makes no step dearer; implicit steps of springs"},
     {"T9", "bounces, error of the tenth apex"}}};

std::size_t width(std::string_view words) {
    return static_cast<std::size_t>(
        std::count_if(words.begin(), words.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// A number with three significant digits.
std::string number(double value) {
    if (std::isnan(value)) return "–";
    const double size = std::abs(value);
    if (size == 0) return "0";
    if (size >= 1e6 || size < 1e-3) return fmt::format("{:.2e}", value);
    return fmt::format("{:.{}f}", value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

std::string table(const Section& section) {
    std::size_t names = 0;
    for (const Row& row : section.rows) names = std::max(names, width(row.name));
    std::string text;
    const Row* head = nullptr;
    const auto same_columns = [](const Row& a, const Row& b) {
        return std::ranges::equal(a.numbers, b.numbers, {}, &std::pair<std::string, double>::first,
                                  &std::pair<std::string, double>::first);
    };
    for (const Row& row : section.rows) {
        if (!head || !same_columns(row, *head)) {
            text += fmt::format("  {:<{}}", "", names);
            for (const auto& [column, value] : row.numbers) text += fmt::format("  {:<9}", column);
            text += '\n';
            head = &row;
        }
        text += fmt::format("  {:<{}}", row.name, names);
        for (const auto& [column, value] : row.numbers)
            text += fmt::format("  {:<{}}", number(value), std::max<std::size_t>(9, width(column)));
        text += '\n';
    }
    return text;
}

std::string line(const Target& target, std::size_t names) {
    const auto& [is_least, limit, unit] = target.bound;
    const std::string suffix = unit.empty() ? "" : " " + unit;
    return fmt::format("    {:<{}}  {:<12} {:<12} {}  {}\n", target.what, names,
                       number(target.measured) + suffix,
                       (is_least ? "≥ " : "≤ ") + number(limit) + suffix,
                       target.met() ? "met   " : "MISSED", target.remark);
}

}  // namespace

std::vector<double> race(const std::vector<Work>& work, const Effort& effort) {
    std::vector<long> times;
    for (const Work& one : work) times.push_back(times_for(one, effort.seconds));
    std::vector<double> least(work.size(), INFINITY);
    std::vector<double> spent(work.size());
    for (int repetition = 0; repetition < effort.repetitions; ++repetition)
        for (std::size_t i = 0; i < work.size(); ++i) {
            if (spent[i] > effort.patience) continue;
            if (effort.prepared) work[i](1);
            const double took = seconds_of(work[i], times[i]);
            spent[i] += took;
            least[i] = std::min(least[i], took / static_cast<double>(times[i]));
        }
    return least;
}

void Report::fact(const std::string& name, const std::string& value) {
    facts_.emplace_back(name, value);
}

void Report::missing(const std::string& words) { missing_.push_back(words); }

void Report::add(const std::string& section, Row row) {
    const auto found = std::ranges::find(sections_, section, &Section::title);
    if (found == sections_.end())
        sections_.push_back({section, {std::move(row)}});
    else
        found->rows.push_back(std::move(row));
}

void Report::target(Target target) { targets_.push_back(std::move(target)); }

std::string Report::text() const {
    std::string text;
    for (const auto& [name, value] : facts_) text += fmt::format("{}: {}\n", name, value);
    for (const Section& section : sections_)
        text += fmt::format("\n{}\n{}", section.title, table(section));
    if (!targets_.empty()) text += targets_text();
    for (const std::string& words : missing_) text += fmt::format("Not measured: {}\n", words);
    return text;
}

std::string Report::targets_text() const {
    std::string text = "\nTargets and measurements\n";
    std::size_t names = 0;
    for (const Target& target : targets_) names = std::max(names, width(target.what));
    for (const auto& [id, about] : groups) {
        if (std::ranges::find(targets_, id, &Target::id) == targets_.end()) continue;
        text += fmt::format("  {}  {}\n", id, about);
        for (const Target& target : targets_)
            if (target.id == id) text += line(target, names);
    }
    const auto met = std::ranges::count_if(targets_, &Target::met);
    return text + fmt::format("  {} of {} met\n", met, targets_.size());
}

std::string Report::json() const {
    nlohmann::ordered_json all;
    for (const auto& [name, value] : facts_) all["facts"][name] = value;
    for (const Section& section : sections_)
        for (const Row& row : section.rows) {
            nlohmann::ordered_json numbers{{"name", row.name}};
            for (const auto& [column, value] : row.numbers) numbers[column] = value;
            all["sections"][section.title].push_back(numbers);
        }
    for (const Target& t : targets_)
        all["targets"].push_back({{"id", t.id},
                                  {"what", t.what},
                                  {"measured", t.measured},
                                  {"unit", t.bound.unit},
                                  {"wanted", t.bound.is_least ? "at least" : "at most"},
                                  {"limit", t.bound.limit},
                                  {"met", t.met()},
                                  {"remark", t.remark}});
    for (const std::string& words : missing_) all["missing"].push_back(words);
    return all.dump(2) + '\n';
}

std::string in_powers(std::size_t count) {
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::size_t power = 0;
    std::size_t rest = count;
    while (rest >= 10 && rest % 10 == 0) rest /= 10, ++power;
    if (power < 3 || rest >= 10) return std::to_string(count);
    return (rest == 1 ? "10" : fmt::format("{}·10", rest)) + digits.at(power);
}

}  // namespace oiler::bench
