// SPDX-License-Identifier: MIT
// Runs `oiler tradeoff` and `oiler merge` as users do.
#include "cli/desk.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;

const std::string few = "--methods semi_implicit_euler,velocity_verlet,rk4,exact --max-rate 400 ";

/// The JSON without timings and the Pareto front.
Json accuracy_of(Json tradeoff) {
    for (Json& row : tradeoff.at("rows"))
        for (const char* name : {"ns_per_second", "ns_spread", "ns_together", "pareto"})
            row.erase(name);
    tradeoff.erase("machines");
    return tradeoff;
}

TEST(TradeoffCommand, WritesATableAndItsPictures) {
    const Desk desk;
    const Outcome run =
        desk.run("oiler tradeoff scene.toml " + few + "--out t --size 64x36 --quiet");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(desk.names("t"),
              (std::vector<std::string>{"energy_over_time.png", "error_over_evaluations.png",
                                        "error_over_time.png", "tradeoff.csv", "tradeoff.json"}));
    const Json json = desk.json("t/tradeoff.json");
    EXPECT_EQ(json.at("scene"), "scene");
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_EQ(json.at("ladders").size(), 8U);
    EXPECT_EQ(lines(desk.text("t/tradeoff.csv")),
              static_cast<std::ptrdiff_t>(1 + json.at("rows").size()));
    for (const Json& row : json.at("rows"))
        EXPECT_EQ(row.at("ns_per_second").is_number(), row.at("stable").get<bool>());
    EXPECT_TRUE(holds(run.out, "\n> semi_implicit_euler "));
    const Outcome all = desk.run("oiler tradeoff scene.toml " + few +
                                 "--out t --size 64x36 --quiet --all --json copy.json");
    EXPECT_GE(lines(all.out), static_cast<std::ptrdiff_t>(json.at("rows").size()));
    EXPECT_EQ(desk.text("copy.json"), desk.text("t/tradeoff.json"));
}

// The file appears after the first method; the rest of the sweep takes a second or more.
TEST(TradeoffCommand, InterruptedIsResumed) {
    const Desk desk;
    const std::string command =
        "oiler tradeoff scene.toml --methods "
        "semi_implicit_euler,velocity_verlet,pefrl,forest_ruth4 "
        "--max-rate 6400 --size 64x36 --quiet --out ";
    const Outcome run =
        desk.run(command +
                     "a & program=$!; while ! test -e a/tradeoff.json; do sleep 0.01; "
                     "done; kill -TERM $program; wait $program",
                 130);
    const Json part = desk.json("a/tradeoff.json");
    EXPECT_EQ(desk.names("a"), std::vector<std::string>{"tradeoff.json"});
    EXPECT_GE(part.at("rows").size(), 1U);
    // Rows in the file are not measured again: a changed number stays.
    Json marked = part;
    marked.at("rows").at(0).at("velocity_error") = 4242;
    desk.put("a/tradeoff.json", marked.dump());
    const Outcome rest = desk.run(command + "a");
    if (rest.exit == 3) GTEST_SKIP() << rest.err;
    EXPECT_EQ(rest.exit, 0) << rest.err;
    desk.run(command + "b", 0);
    Json resumed = accuracy_of(desk.json("a/tradeoff.json"));
    const Json whole = accuracy_of(desk.json("b/tradeoff.json"));
    std::size_t marks = 0;
    for (std::size_t i = 0; i < resumed.at("rows").size(); ++i) {
        Json& row = resumed.at("rows").at(i);
        if (row.at("velocity_error") != 4242) continue;
        row.at("velocity_error") = whole.at("rows").at(i).at("velocity_error");
        ++marks;
    }
    EXPECT_EQ(marks, 1U);
    EXPECT_EQ(resumed, whole);
    EXPECT_EQ(desk.names("a").size(), 5U);
}

/// The velocity errors of a file's rows, and whether one has the changed number.
bool has_mark(const Json& part) {
    for (const Json& row : part.at("rows"))
        if (row.at("velocity_error") == 4242) return true;
    return false;
}

/// A half-finished sweep in whose file one number is changed.
class UnfinishedSweep : public testing::Test {
protected:
    UnfinishedSweep() {
        Json part = measure();
        part.at("rows").at(0).at("velocity_error") = 4242;
        desk_.put("a/part-1-of-2.json", part.dump());
    }
    /// Returns the rows of the finished file.
    [[nodiscard]] Json measure(const std::string& options = "--max-rate 60 --duration 1",
                               const std::string& folder = "a") const {
        desk_.run("oiler tradeoff scene.toml --methods rk4,exact --shard 1/2 --quiet --out " +
                      folder + " " + options,
                  0);
        return desk_.json(folder + "/part-1-of-2.json");
    }
    static std::string changed(const std::string& what, const std::string& with) {
        std::string scene = spring_scene("");
        return scene.replace(scene.find(what), what.size(), with);
    }

    Desk desk_;
};

TEST_F(UnfinishedSweep, IsResumedWithItsRows) { EXPECT_TRUE(has_mark(measure())); }

// Rows measured with another stiffness are not resumed, although all else is equal.
TEST_F(UnfinishedSweep, OfAnotherSceneIsMeasuredAgain) {
    desk_.put("scene.toml", changed("15.0", "14.0"));
    const Json anew = measure();
    EXPECT_FALSE(has_mark(anew));
    EXPECT_EQ(accuracy_of(anew), accuracy_of(measure("--max-rate 60 --duration 1", "b")));
}

TEST_F(UnfinishedSweep, WithOtherOptionsIsMeasuredAgain) {
    const Json lower = measure("--max-rate 30 --duration 1");
    EXPECT_FALSE(has_mark(lower));
    // Up to 30 Hz, and the scene's own 100 Hz.
    for (const Json& row : lower.at("rows"))
        EXPECT_TRUE(row.at("rate") <= 30 || row.at("rate") == 100) << row;
    const Json shorter = measure("--max-rate 30 --duration 0.5");
    EXPECT_EQ(shorter.at("duration"), 0.5);
    EXPECT_EQ(shorter.at("reference").at("meaningful_until"), 0.5);
}

TEST(TradeoffCommand, MergedShardsEqualOneRun) {
    const Desk desk;
    const std::string command = "oiler tradeoff scene.toml " + few + "--size 64x36 --quiet --out ";
    for (const char* shard : {"1/4", "2/4", "3/4", "4/4"}) {
        const Outcome run = desk.run(command + "parts --shard " + shard, 0);
        EXPECT_EQ(run.out, "");
    }
    EXPECT_EQ(desk.names("parts"),
              (std::vector<std::string>{"part-1-of-4.json", "part-2-of-4.json", "part-3-of-4.json",
                                        "part-4-of-4.json"}));
    const Outcome missing = desk.run("oiler merge parts/part-[123]*.json --out merged", 2);
    EXPECT_EQ(lines(missing.err), 1) << missing.err;
    const Outcome merge =
        desk.run("oiler merge parts/part-*.json --out merged --size 64x36 --quiet");
    if (merge.exit == 3) GTEST_SKIP() << merge.err;
    EXPECT_EQ(merge.exit, 0) << merge.err;
    desk.run(command + "whole", 0);
    EXPECT_EQ(accuracy_of(desk.json("merged/tradeoff.json")),
              accuracy_of(desk.json("whole/tradeoff.json")));
    EXPECT_EQ(desk.text("merged/tradeoff.csv").substr(0, 60),
              desk.text("whole/tradeoff.csv").substr(0, 60));
    const Outcome twice = desk.run(
        "cp parts/part-2-of-4.json copy.json; oiler merge parts/part-*.json copy.json --out "
        "merged",
        2);
    EXPECT_TRUE(holds(twice.err, "oiler: copy.json: ") &&
                holds(twice.err, "parts/part-2-of-4.json"))
        << twice.err;
    // Parts with another duration cannot be merged.
    desk.run(command + "parts --shard 2/4 --duration 9", 0);
    desk.run("oiler merge parts/part-*.json --out merged", 2);
}

TEST(TradeoffCommand, MeasuresARepeatedMethodOnce) {
    const Desk desk;
    const std::string command =
        "oiler tradeoff scene.toml --max-rate 200 --shard 1/1 --quiet "
        "--size 64x36 --duration 2 --out ";
    const Outcome twice = desk.run(command + "twice --methods rk4,rk4");
    if (twice.exit == 2) return;  // refusing it will do, too
    EXPECT_EQ(desk.run(command + "once --methods rk4").exit, twice.exit);
    EXPECT_EQ(desk.json("twice/tradeoff.json").at("rows").size(),
              desk.json("once/tradeoff.json").at("rows").size());
}

/// The text with single spaces between words.
std::string squeezed(const std::string& line) {
    std::istringstream stream(line);
    std::string all;
    for (std::string word; stream >> word;) all += (all.empty() ? "" : " ") + word;
    return all;
}

/// The line that contains these words.
std::string line_with(const std::string& text, const std::string& words) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (holds(line, words)) return squeezed(line);
    return "";
}

/// A sweep of one method whose numbers are all different.
Tradeoff made_up() {
    const Method* const rk4 = &find_method("rk4");
    const Stepping current{rk4, {240}, Precision::double_};
    TradeoffRow told{
        .stepping = current, .ns_per_second = 36'000, .ns_spread = 1800, .ns_together = 12'000};
    told.judgement = {.position_error = 0.125,
                      .step_error = 0.0625,
                      .velocity_error = 2.5,
                      .phase_error = -3.5,
                      .energy_drift = 0.05,
                      .evaluations = 4800};
    TradeoffRow too_small{
        .stepping = {rk4, {250}, Precision::double_}, .ns_per_second = 45'000, .ns_spread = 11'250};
    too_small.judgement.evaluations = 5000;
    TradeoffRow unstable{.stepping = {rk4, {10}, Precision::double_}};
    unstable.judgement.stable = false;
    Tradeoff tradeoff{
        .scene = "made_up", .title = "", .fingerprint = "0123456789abcdef", .duration = 5};
    tradeoff.current = current;
    tradeoff.reference.floor.position = 1e-9;
    tradeoff.reference.extent = 1;
    tradeoff.reference.meaningful_until = 5;
    tradeoff.machines = {{"cpu", 1, "cc"}};
    tradeoff.all_series = {
        {.method = rk4, .rows = {unstable, told, too_small}, .end = "so", .done = true}};
    return tradeoff;
}

// 36,000 ns per second of the scene are 36 µs, or 0.0036 % of the time; half of the interquartile
// range, 1800 ns, is 5 % of it. 11,250 of 45,000 ns are 25 %. A line begins with its mark.
TEST(TradeoffTable, CellsHaveTheUnitsOfTheirHeadings) {
    const Desk desk;
    desk.put("part.json", file_text(made_up()));
    const Outcome run = desk.run("oiler merge part.json --all --out t --size 64x36 --quiet");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(line_with(run.out, "method "),
              "method Hz drawn m steps m phase ° energy forces µs per s ± frame in calls");
    EXPECT_EQ(line_with(run.out, " 240 "),
              "> rk4 240 double 0.125 0.0625 -3.5 0.05 4800 36 5% 0.0036% 12");
    EXPECT_EQ(line_with(run.out, " 250 "),
              "* rk4 250 double <1.0e-09 <1.0e-09 - - 5000 45 25% 0.0045% -");
    EXPECT_EQ(line_with(run.out, " 10 "), "rk4 10 double unstable unstable - - - - - - -");
}

// Worker threads write the file; a write error is one line from any of them.
TEST(TradeoffCommand, ReportsAWriteError) {
    const Desk desk;
    const Outcome run = desk.run(
        "trap '' XFSZ; ulimit -f 4; oiler tradeoff scene.toml " + few + "--out t --quiet", 4);
    EXPECT_EQ(lines(run.err), 1) << run.err;
}

// A scene at rest has no energy scale and no drifts; its file can be read again.
TEST(TradeoffCommand, FileOfASceneAtRestCanBeRead) {
    const Desk desk("[scene]\naxes = 1\nduration = 1.0\n[[body]]\nname = \"a\"\n");
    const Outcome run = desk.run(
        "oiler tradeoff scene.toml --methods rk4 --max-rate 100 --out t --shard 1/1 "
        "--size 64x36 --quiet");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    desk.run("oiler merge t/tradeoff.json --out u --size 64x36 --quiet", 0);
}

}  // namespace
}  // namespace oiler::test
