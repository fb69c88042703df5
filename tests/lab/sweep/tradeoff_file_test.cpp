// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "lab/tradeoffs.hpp"
#include "oiler/core/version.hpp"
#include "support/text.hpp"

namespace oiler::test {
using namespace oiler::lab;
namespace {

bool same_times(const TradeoffRow& a, const TradeoffRow& b) {
    return same(a.ns_per_second, b.ns_per_second) && same(a.ns_spread, b.ns_spread) &&
           same(a.ns_together, b.ns_together);
}

// ---- files

/// A trade-off with numbers that are hard to write in every field.
Tradeoff hard_numbers() {
    Tradeoff tradeoff = started(spring(), small_plan());
    tradeoff.duration = 0.1 + 0.2;
    tradeoff.title = "\"Quoted\", <b>µ</b>";
    tradeoff.reference.position_error = 5e-324;
    tradeoff.reference.velocity_error = 1.0 / 3;
    tradeoff.reference.floor = {1e-300, 2.0 / 3, 1.7976931348623157e308};
    tradeoff.reference.extent = std::nextafter(1.0, 2.0);
    tradeoff.reference.meaningful_until = 0.7 + 0.1;
    tradeoff.reference.why_no_longer = "\"µ\\\n";
    tradeoff.reference.period = std::acos(-1.0);
    tradeoff.machines.push_back({"other", 128, "cc 1.0"});
    for (std::size_t i = 0; i < 3; ++i) {
        Ladder& ladder = tradeoff.ladders[i];
        ladder.done = i != 1;
        ladder.end = ladder.done ? "so" : "";
        for (int rate = 1; rate < 20 && ladder.done; ++rate) {
            TradeoffRow row{.stepping = {ladder.method, {rate}, ladder.precision},
                            .ns_per_second = std::exp(rate),
                            .ns_spread = rate % 3 == 0 ? unknown : 1.0 / rate,
                            .ns_together = rate % 7 == 0 ? unknown : std::exp(-rate)};
            row.judgement = {.stable = rate % 5 != 0,
                             .position_error = rate % 4 == 0 ? unknown : std::sin(rate) * 1e-310,
                             .step_error = rate % 3 == 0 ? unknown : std::cos(rate) * 1e-300,
                             .velocity_error = std::pow(7, -rate),
                             .phase_error = -0.0,
                             .energy_drift = std::nextafter(rate, 0.0),
                             .evaluations = std::sqrt(rate)};
            ladder.rows.push_back(row);
        }
    }
    return tradeoff;
}

TEST(TradeoffFile, ReadsBackToTheSameBits) {
    const Tradeoff written = hard_numbers();
    const Tradeoff read = parse_tradeoff(to_json(written), "tradeoff.json");
    expect_same_errors(read, written);
    EXPECT_EQ(read.scene, written.scene);
    EXPECT_EQ(read.title, written.title);
    EXPECT_EQ(read.fingerprint, written.fingerprint);
    EXPECT_EQ(read.duration, written.duration);
    EXPECT_EQ(read.current, written.current);
    EXPECT_EQ(read.machines, written.machines);
    EXPECT_EQ(read.reference.words, written.reference.words);
    EXPECT_EQ(read.reference.closed_form, written.reference.closed_form);
    EXPECT_TRUE(same(read.reference.position_error, written.reference.position_error));
    EXPECT_TRUE(same(read.reference.velocity_error, written.reference.velocity_error));
    EXPECT_TRUE(same(read.reference.floor.position, written.reference.floor.position));
    EXPECT_TRUE(same(read.reference.floor.velocity, written.reference.floor.velocity));
    EXPECT_TRUE(same(read.reference.floor.energy, written.reference.floor.energy));
    EXPECT_TRUE(same(read.reference.extent, written.reference.extent));
    EXPECT_TRUE(same(read.reference.meaningful_until, written.reference.meaningful_until));
    EXPECT_EQ(read.reference.why_no_longer, written.reference.why_no_longer);
    EXPECT_TRUE(same(read.reference.period, written.reference.period));
    for (std::size_t i = 0; i < written.rows().size(); ++i)
        EXPECT_TRUE(same_times(*read.rows()[i], *written.rows()[i])) << i;
    EXPECT_EQ(to_json(read), to_json(written));
}

/// A trade-off whose one row is of this setting.
Tradeoff with_row(const Stepping& choice) {
    Tradeoff tradeoff = started(spring(), small_plan());
    tradeoff.ladders.resize(1);
    tradeoff.ladders[0] = {
        .method = choice.method, .precision = choice.precision, .rows = {{.stepping = choice}}};
    return tradeoff;
}

// Only splittings can put damping elsewhere. Their own choice is named in the file and is not part
// of the setting.
TEST(TradeoffFile, KeepsTheTreatmentOfDamping) {
    const Method* const euler = &find_method("semi_implicit_euler");
    ASSERT_EQ(euler->damping, Damping::in_kick);
    const auto damping_in_file = [](const Stepping& choice) {
        const std::string text = to_json(with_row(choice));
        EXPECT_EQ(parse_tradeoff(text, "a.json").ladders[0].rows[0].stepping, choice);
        return nlohmann::json::parse(text).at("rows").at(0).at("damping");
    };
    EXPECT_EQ(damping_in_file({euler, {60}, Precision::double_}), "kick");
    EXPECT_EQ(damping_in_file({euler, {60}, Precision::double_, Damping::in_drift}), "drift");
    EXPECT_EQ(damping_in_file({&find_method("rk4"), {60}, Precision::double_}), nullptr);
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells{""};
    for (const char c : line) {
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

TEST(TradeoffFile, IsATableToo) {
    const Tradeoff tradeoff = hard_numbers();
    std::istringstream csv(to_csv(tradeoff));
    std::string line;
    std::getline(csv, line);
    const std::vector<std::string> names = cells_of(line);
    const auto front = pareto(tradeoff, time_of);
    ASSERT_FALSE(front.empty());
    std::size_t count = 0;
    for (; std::getline(csv, line); ++count) {
        ASSERT_LT(count, tradeoff.rows().size());
        const TradeoffRow& row = *tradeoff.rows()[count];
        const std::vector<std::string> cells = cells_of(line);
        ASSERT_EQ(cells.size(), names.size());
        const auto cell = [&](const std::string& name) {
            const auto at = std::find(names.begin(), names.end(), name);
            return at == names.end() ? "no column"
                                     : cells[static_cast<std::size_t>(at - names.begin())];
        };
        const auto number = [&](const std::string& name) {
            return cell(name).empty() ? unknown : std::strtod(cell(name).c_str(), nullptr);
        };
        EXPECT_EQ(cell("method"), row.stepping.method->name);
        EXPECT_EQ(cell("rate"), std::to_string(row.stepping.rate.steps));
        EXPECT_EQ(cell("precision"), name_of(row.stepping.precision));
        EXPECT_EQ(cell("stable"), row.judgement.stable ? "1" : "0");
        EXPECT_EQ(cell("below_floor"), row.judgement.below_floor() ? "1" : "0");
        EXPECT_EQ(cell("pareto"),
                  std::find(front.begin(), front.end(), &row) != front.end() ? "1" : "0");
        EXPECT_TRUE(same(number("position_error"), row.judgement.position_error)) << line;
        EXPECT_TRUE(same(number("step_error"), row.judgement.step_error)) << line;
        EXPECT_TRUE(same(number("velocity_error"), row.judgement.velocity_error)) << line;
        EXPECT_TRUE(same(number("phase_error"), row.judgement.phase_error)) << line;
        EXPECT_TRUE(same(number("energy_drift"), row.judgement.energy_drift)) << line;
        EXPECT_TRUE(same(number("evaluations"), row.judgement.evaluations)) << line;
        EXPECT_TRUE(same(number("ns_per_second"), row.ns_per_second)) << line;
        EXPECT_TRUE(same(number("ns_spread"), row.ns_spread)) << line;
        EXPECT_TRUE(same(number("ns_together"), row.ns_together)) << line;
    }
    EXPECT_EQ(count, tradeoff.rows().size());
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

TEST(TradeoffFile, IfInvalidIsRefusedInOneLineThatNamesTheFile) {
    const std::string good = to_json(hard_numbers());
    (void)parse_tradeoff(good, "a.json");
    const std::vector<std::string> bad{
        "",
        "{",
        "[]",
        "null",
        "\n\n\xff\xfe",
        "{\"oiler\": 3}",
        good.substr(0, good.size() / 2),
        replaced(good, "\"rows\"", "\"rowz\""),
        replaced(good, "\"ladders\"", "\"ladder\""),
        replaced(good, "\"duration\": ", "\"duration\": \"x\", \"d\": "),
        replaced(good, "\"explicit_euler\"", "\"explicit_eulr\""),
        replaced(good, "\"float\"", "\"flaot\""),
        replaced(good, "\"stable\": true", "\"stable\": 1"),
        replaced(good, "\"rate\": 1,", "\"rate\": \"1\","),
    };
    for (const std::string& text : bad)
        expect_usage([&] { (void)parse_tradeoff(text, "a.json"); },
                     holds(text, "explicit_eulr") ? "explicit_eulr" : "a.json");
}

TEST(TradeoffFile, OfAnotherVersionIsRefused) {
    const std::string version_now(version());
    expect_usage(
        [&] {
            (void)parse_tradeoff(
                replaced(to_json(hard_numbers()), "\"" + version_now + "\"", "\"0.0.1\""),
                "a.json");
        },
        "0.0.1");
}

// ---- the fingerprint

TEST(Fingerprint, DependsOnEverythingThatDeterminesErrors) {
    const auto print = [](const std::string& text, const SweepPlan& plan, double duration) {
        Scene scene = parse_scene(text, "test.toml");
        if (duration > 0) scene.duration = duration;
        return fingerprint(text, scene, plan);
    };
    const SweepPlan plan = small_plan();
    std::set<std::string> prints{print(article_spring, plan, 0)};
    EXPECT_EQ(print(article_spring, plan, 0), *prints.begin());
    EXPECT_EQ(print(article_spring, plan, 10), *prints.begin());
    prints.insert(print(article_spring + "# another\n", plan, 0));
    prints.insert(print(article_spring, plan, 9));
    prints.insert(print(article_spring, plan, 10.00000001));
    SweepPlan other = plan;
    other.methods.pop_back();
    prints.insert(print(article_spring, other, 0));
    std::swap(other.methods[0], other.methods[1]);
    prints.insert(print(article_spring, other, 0));
    other = plan;
    other.max_rate = 801;
    prints.insert(print(article_spring, other, 0));
    other = plan;
    other.most_work = 1e8;
    prints.insert(print(article_spring, other, 0));
    EXPECT_EQ(prints.size(), 8U);
    // All shards of a sweep have equal fingerprints.
    other = plan;
    other.shard = 2;
    other.shards = 4;
    EXPECT_EQ(prints.count(print(article_spring, other, 0)), 1U);
}

TEST(Fingerprint, DependsOnThePrecisions) {
    const Scene scene = parse_scene(article_spring, "test.toml");
    SweepPlan plan = small_plan();
    plan.precisions = {Precision::single};
    const std::string single = fingerprint(article_spring, scene, plan);
    plan.precisions = {Precision::double_};
    EXPECT_NE(fingerprint(article_spring, scene, plan), single);
}

}  // namespace
}  // namespace oiler::test
