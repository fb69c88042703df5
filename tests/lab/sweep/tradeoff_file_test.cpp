// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_file.hpp"

#include <nlohmann/json.hpp>

#include "lab/tradeoffs.hpp"
#include "oiler/core/version.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

// ---- files

/// A trade-off with numbers that are hard to write in every field.
Tradeoff hard_numbers() {
    Tradeoff tradeoff = started(spring(), small_plan());
    tradeoff.duration = 0.7 + 0.1;
    tradeoff.title = "\"Quoted\", <b>µ</b>";
    tradeoff.reference.position_error = 5e-324;
    tradeoff.reference.velocity_error = 1.0 / 3;
    tradeoff.reference.floor = {1e-300, 2.0 / 3, 1.7976931348623157e308};
    tradeoff.reference.extent = std::nextafter(1.0, 2.0);
    tradeoff.reference.meaningful_until = 0.1 + 0.2;
    tradeoff.reference.why_no_longer = "\"µ\\\n";
    tradeoff.reference.period = std::acos(-1.0);
    tradeoff.machines.push_back({"other", 128, "cc 1.0"});
    for (std::size_t i = 0; i < 3; ++i) {
        RateSeries& series = tradeoff.all_series[i];
        series.done = i != 1;
        series.end = series.done ? "so" : "";
        for (int rate = 1; rate < 20 && series.done; ++rate) {
            TradeoffRow row{.stepping = {series.method, {rate}, series.precision},
                            .ns_per_second = std::exp(rate),
                            .ns_spread = rate % 3 == 0 ? unknown : 1.0 / rate,
                            .ns_worst_frame = rate % 5 == 0 ? unknown : 2.0 / rate,
                            .ns_together = rate % 7 == 0 ? unknown : std::exp(-rate)};
            row.judgement = {
                .stable = rate % 5 != 0,
                .position_error = rate % 4 == 0 ? unknown : std::abs(std::sin(rate)) * 1e-310,
                .step_error = rate % 3 == 0 ? unknown : std::abs(std::cos(rate)) * 1e-300,
                .velocity_error = std::pow(7, -rate),
                .phase_error = -0.0,
                .energy_drift = std::nextafter(rate, 0.0),
                .evaluations = std::sqrt(rate)};
            series.rows.push_back(row);
        }
    }
    return tradeoff;
}

// The text has the shortest digits of each number. Each of its fields is read, see below.
TEST(TradeoffFile, ReadsBackToTheSameBits) {
    const Tradeoff written = hard_numbers();
    const Tradeoff read = parse_tradeoff(file_text(written), "tradeoff.json");
    expect_same_errors(read, written);
    EXPECT_EQ(file_text(read), file_text(written));
}

/// A trade-off whose one row is of this setting.
Tradeoff with_row(const Stepping& choice) {
    Tradeoff tradeoff = started(spring(), small_plan());
    tradeoff.all_series.resize(1);
    tradeoff.all_series[0] = {.method = choice.method,
                              .precision = choice.precision,
                              .rows = {{.stepping = choice}},
                              .end = "so",
                              .done = true};
    return tradeoff;
}

// Only splittings can put damping elsewhere. Their own choice is named in the file and is not part
// of the setting.
TEST(TradeoffFile, KeepsTheTreatmentOfDamping) {
    const Method* const euler = &find_method("semi_implicit_euler");
    ASSERT_EQ(euler->damping, Damping::in_kick);
    const auto damping_in_file = [](const Stepping& choice) {
        const std::string text = file_text(with_row(choice));
        EXPECT_EQ(parse_tradeoff(text, "a.json").all_series[0].rows[0].stepping, choice);
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
        EXPECT_TRUE(same(number("ns_worst_frame"), row.ns_worst_frame)) << line;
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
    const std::string good = file_text(hard_numbers());
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

using Parsed = nlohmann::json;

/// A way to damage a valid file, and the place that the message names.
struct Damage {
    const char* pointer;  ///< JSON pointer to a value
    Parsed value;         ///< in its place; discarded: the value is removed
    const char* named;
};

std::vector<Damage> damages() {
    const Parsed gone(Parsed::value_t::discarded);
    return {
        {"/oiler", "0.0.1", "got one of 0.0.1"},
        {"/oiler", 1, "oiler: expected a text"},
        {"/oiler", gone, "oiler is missing"},
        {"/scene", gone, "scene is missing"},
        {"/scene", 3, "scene: expected a text"},
        {"/title", nullptr, "title: expected a text"},
        {"/fingerprint", "", "fingerprint: expected 16"},
        {"/fingerprint", "0123456789ABCDEF", "fingerprint: expected 16"},
        {"/fingerprint", 0, "fingerprint: expected a text"},
        {"/complete", 0, "complete: expected true or false"},
        {"/complete", true, "complete: expected what the ladders say"},
        {"/duration", 0, "duration: expected a number above 0"},
        {"/duration", -1.5, "duration: expected a number above 0"},
        {"/duration", nullptr, "duration: expected a number above 0"},
        {"/duration", gone, "duration is missing"},
        {"/current", Parsed::array(), "current: expected an object"},
        {"/current/rate", 0, "current.rate: expected a whole number from 1 to 1000000"},
        {"/current/method", "rk5", "current.method: expected a name of `oiler methods`"},
        {"/current/precision", "half", "current.precision: expected float or double"},
        {"/current/damping", "none", "current.damping: expected kick or drift"},
        {"/reference/words", 1, "reference.words"},
        {"/reference/closed_form", "yes", "reference.closed_form"},
        {"/reference/position_error", -1e-9, "reference.position_error: expected a number of 0"},
        {"/reference/velocity_error", "0", "reference.velocity_error"},
        {"/reference/position_floor", nullptr, "reference.position_floor"},
        {"/reference/velocity_floor", -5e-324, "reference.velocity_floor"},
        {"/reference/energy_floor", -1, "reference.energy_floor"},
        {"/reference/extent", -1, "reference.extent"},
        {"/reference/meaningful_until", 0, "reference.meaningful_until"},
        {"/reference/meaningful_until", 1, "reference.meaningful_until: expected at most"},
        {"/reference/why_no_longer", gone, "reference.why_no_longer is missing"},
        {"/reference/period", 0, "reference.period"},
        {"/machines", Parsed::array(), "machines: expected a machine"},
        {"/machines/0/cpu", nullptr, "machines[0].cpu"},
        {"/machines/1/cores", 0, "machines[1].cores"},
        {"/machines/0/cores", 1e300, "machines[0].cores"},
        {"/machines/0/compiler", gone, "machines[0].compiler is missing"},
        {"/ladders", Parsed::array(), "ladders: expected each method in each precision"},
        {"/ladders/3", gone, "ladders: expected each method in each precision"},
        {"/ladders/1/precision", "float", "ladders[1]: expected each method once"},
        {"/ladders/0/method", 7, "ladders[0].method"},
        {"/ladders/0/done", 1, "ladders[0].done"},
        {"/ladders/0/done", false, "ladders[0].end"},
        {"/ladders/0/end", "", "ladders[0].end"},
        {"/ladders/1/done", true, "ladders[1].end"},
        {"/rows", Parsed::object(), "rows: expected an array"},
        {"/rows/2", nullptr, "rows[2]: expected an object"},
        {"/rows/0/method", "rk4", "rows[0]: expected a row of a ladder that is done"},
        {"/rows/0/rate", 0, "rows[0].rate"},
        {"/rows/0/rate", -1, "rows[0].rate"},
        {"/rows/0/rate", 1e300, "rows[0].rate"},
        {"/rows/0/rate", 1.0, "rows[0].rate"},
        {"/rows/0/rate", 1000001, "rows[0].rate"},
        {"/rows/0/rate", 18446744073709551615U, "rows[0].rate"},
        {"/rows/1/rate", 1, "rows[1].rate: expected a higher rate"},
        {"/rows/0/precision", "long double", "rows[0].precision"},
        {"/rows/0/damping", "kick", "rows[0].damping: expected null for a method"},
        {"/rows/19/damping", nullptr, "rows[19].damping: expected a text"},
        {"/rows/0/stable", 1, "rows[0].stable"},
        {"/rows/0/below_floor", true, "rows[0].below_floor"},
        {"/rows/0/pareto", "no", "rows[0].pareto"},
        {"/rows/0/position_error", -1e-9, "rows[0].position_error: expected a number of 0"},
        {"/rows/0/step_error", -1, "rows[0].step_error"},
        {"/rows/0/velocity_error", "1", "rows[0].velocity_error"},
        {"/rows/0/phase_error", true, "rows[0].phase_error"},
        {"/rows/0/energy_drift", -0.5, "rows[0].energy_drift"},
        {"/rows/0/evaluations", -1, "rows[0].evaluations"},
        {"/rows/0/ns_per_second", -1, "rows[0].ns_per_second"},
        {"/rows/0/ns_spread", -1, "rows[0].ns_spread"},
        {"/rows/0/ns_worst_frame", -1, "rows[0].ns_worst_frame"},
        {"/rows/0/ns_together", -1, "rows[0].ns_together"},
        {"/rows/0/ns_together", gone, "rows[0].ns_together is missing"},
    };
}

Parsed damaged(Parsed whole, const Damage& damage) {
    const Parsed::json_pointer at(damage.pointer);
    if (!damage.value.is_discarded()) {
        whole.at(at) = damage.value;
        return whole;
    }
    Parsed& parent = whole.at(at.parent_pointer());
    if (parent.is_array())
        parent.erase(static_cast<std::size_t>(std::stoul(at.back())));
    else
        parent.erase(at.back());
    return whole;
}

TEST(TradeoffFile, DamagedAnywhereIsRefusedWithFileFieldAndRemedy) {
    const Parsed good = Parsed::parse(file_text(hard_numbers()));
    EXPECT_GE(damages().size(), 50U);
    for (const Damage& damage : damages()) {
        const std::string text = damaged(good, damage).dump();
        const std::string line =
            line_of_error(Exit::usage, [&] { (void)parse_tradeoff(text, "dir/a.json"); });
        EXPECT_EQ(line.rfind("dir/a.json: ", 0), 0U) << line;
        EXPECT_TRUE(holds(line, damage.named)) << damage.pointer << ": " << line;
        EXPECT_TRUE(holds(line, "; measure again"));
        EXPECT_FALSE(holds(line, "\n"));
    }
}

// The front is that of all rows: a row at which it is wrong is named.
TEST(TradeoffFile, WithAWrongParetoFrontIsRefused) {
    Parsed json = Parsed::parse(file_text(hard_numbers()));
    for (std::size_t i = 0; i < json.at("rows").size(); i += 5) {
        Parsed wrong = json;
        wrong["rows"][i]["pareto"] = !wrong["rows"][i]["pareto"].get<bool>();
        expect_usage([&] { (void)parse_tradeoff(wrong.dump(), "a.json"); },
                     "rows[" + std::to_string(i) + "].pareto");
    }
}

// A field that the reader does not read would be a field without a check.
TEST(TradeoffFile, WithoutAnyOneOfItsFieldsIsRefused) {
    const Parsed good = Parsed::parse(file_text(hard_numbers()));
    std::size_t fields = 0;
    const auto try_all = [&](const Parsed::json_pointer& at) {
        for (const auto& [name, value] : good.at(at).items()) {
            Parsed without = good;
            without.at(at).erase(name);
            expect_usage([&] { (void)parse_tradeoff(without.dump(), "a.json"); },
                         name + " is missing");
            ++fields;
        }
    };
    for (const char* at : {"", "/current", "/reference", "/machines/1", "/ladders/2", "/rows/4"})
        try_all(Parsed::json_pointer(at));
    EXPECT_EQ(fields, 12U + 4 + 11 + 3 + 4 + 17);
}

/// The text without this member of each object.
Parsed without(const Parsed& whole, const char* name) {
    Parsed rest = whole;
    rest.erase(name);
    return rest;
}

/// The places of all texts, flags and numbers.
void list_values(const Parsed& at, const Parsed::json_pointer& place,
                 std::vector<Parsed::json_pointer>& places) {
    if (!at.is_structured()) return places.push_back(place);
    for (const auto& [name, value] : at.items())
        list_values(value, at.is_array() ? place / std::stoul(name) : place / name, places);
}

/// Another value that the field may have: flags, texts and numbers that are valid or absurd.
Parsed other_value(const Parsed& value) {
    if (value.is_boolean()) return !value.get<bool>();
    if (value.is_string()) return value.get<std::string>() + " ";
    if (value.is_number_unsigned()) return value.get<std::uint64_t>() + 1;
    return value.is_number() && value != 0 ? Parsed(0) : Parsed(1e300);
}

// Each value is sealed: none can be changed, however plausible, not even by a digit.
TEST(TradeoffFile, WithAnyChangedValueIsRefused) {
    const Parsed good = Parsed::parse(file_text(hard_numbers()));
    (void)parse_tradeoff(good.dump(), "a.json");  // other spaces and another order do not matter
    std::vector<Parsed::json_pointer> places;
    list_values(good, Parsed::json_pointer(), places);
    EXPECT_GT(places.size(), 500U);
    for (const Parsed::json_pointer& place : places) {
        Parsed changed = good;
        changed[place] = other_value(good[place]);
        expect_usage([&] { (void)parse_tradeoff(changed.dump(), "a.json"); }, "measure again");
    }
}

TEST(TradeoffFile, OfAnotherSealIsRefusedWithThatReason) {
    Parsed json = Parsed::parse(file_text(hard_numbers()));
    json["rows"][0]["evaluations"] = 1e300;
    expect_usage([&] { (void)parse_tradeoff(json.dump(), "a.json"); },
                 "a.json: values were changed after they were measured: their seal is ");
    expect_usage([&] { (void)parse_tradeoff(without(json, "seal").dump(), "a.json"); },
                 "a.json: seal is missing");
}

TEST(TradeoffFile, OfAnotherVersionIsRefused) {
    const std::string version_now(version());
    expect_usage(
        [&] {
            (void)parse_tradeoff(
                replaced(file_text(hard_numbers()), "\"" + version_now + "\"", "\"0.0.1\""),
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
