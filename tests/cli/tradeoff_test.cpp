// SPDX-License-Identifier: MIT
// Runs `oiler tradeoff`, `merge`, `rates` and `report` as users do.

#include "cli/desk.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;

const std::string few = "--methods semi_implicit_euler,velocity_verlet,rk4,exact --max-rate 400 ";

/// The JSON without timings, the Pareto front and the seal.
Json accuracy_of(Json tradeoff) {
    for (Json& row : tradeoff.at("rows"))
        for (const char* name :
             {"ns_per_second", "ns_spread", "ns_worst_frame", "ns_together", "pareto"})
            row.erase(name);
    tradeoff.erase("machines");
    tradeoff.erase("seal");
    return tradeoff;
}

/// The file of a sweep whose first row has another velocity error.
std::string with_mark(const std::string& text) {
    Tradeoff tradeoff = parse_tradeoff(text, "a.json");
    const auto first = std::ranges::find_if(
        tradeoff.all_series, [](const RateSeries& series) { return !series.rows.empty(); });
    first->rows.front().judgement.velocity_error = 4242;
    return file_text(tradeoff);
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
    desk.put("a/tradeoff.json", with_mark(desk.text("a/tradeoff.json")));
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
        measure();
        desk_.put("a/part-1-of-2.json", with_mark(desk_.text("a/part-1-of-2.json")));
    }
    /// Returns the rows of the finished file.
    Json measure(const std::string& options = "--max-rate 60 --duration 1",
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
    // A picture of the older sweep, which merge does not draw.
    desk.run("oiler merge parts/part-*.json --out whole --size 64x36 --quiet", 0);
    EXPECT_EQ(desk.names("whole"), desk.names("merged"));
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
    EXPECT_TRUE(Json::accept(desk.run("oiler merge part.json --out t --quiet --json -").out));
}

// One bad byte would cost the whole sweep, and any other text would be lost.
TEST(TradeoffCommand, KeepsAFileThatItCannotRead) {
    const std::string good = file_text(made_up());
    std::string flipped = good;
    flipped[good.find("4800")] = '5';
    for (const std::string& text : {std::string("my notes\n"), good.substr(0, good.size() - 2),
                                    flipped, std::string("{\"a\": 1}\n")}) {
        const Desk desk;
        std::filesystem::create_directory(desk.folder() / "t");
        desk.put("part.json", good);
        desk.put("t/tradeoff.json", text);
        desk.put("copy.json", text);
        for (const std::string line :
             {"tradeoff scene.toml --methods rk4 --max-rate 60 --out t", "merge part.json --out t",
              "merge part.json --out u --json copy.json",
              "tradeoff scene.toml --methods rk4 --max-rate 60 --out u --json copy.json"}) {
            const Outcome run = desk.run("oiler " + line + " --quiet", 2);
            EXPECT_EQ(lines(run.err), 1) << run.err;
            EXPECT_TRUE(holds(run.err, "remove it or choose another p"));
        }
        EXPECT_EQ(desk.text("t/tradeoff.json"), text);
        EXPECT_EQ(desk.text("copy.json"), text);
        EXPECT_EQ(desk.names("t"), std::vector<std::string>{"tradeoff.json"});
    }
}

// An earlier sweep of any scene is replaced, also by a copy. So is an empty file, as mktemp makes
// it.
TEST(TradeoffCommand, ReplacesAnEarlierSweep) {
    const Desk desk;
    desk.put("part.json", file_text(made_up()));
    std::filesystem::create_directory(desk.folder() / "t");
    desk.put("t/tradeoff.json", with_mark(file_text(made_up())));
    desk.put("copy.json", "");
    const Outcome run = desk.run("oiler merge part.json --out t --json copy.json --quiet");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(desk.text("t/tradeoff.json"), file_text(made_up()));
    EXPECT_EQ(desk.text("copy.json"), file_text(made_up()));
}

// A foreign table or picture is found before the sweep.
TEST(TradeoffCommand, KeepsOtherFilesOfItsNames) {
    for (const std::string name : {"tradeoff.csv", "error_over_time.png"}) {
        const Desk desk;
        std::filesystem::create_directory(desk.folder() / "t");
        desk.put("t/" + name, "mine");
        const Outcome run = desk.run("oiler tradeoff scene.toml --out t", 2);
        EXPECT_TRUE(holds(run.err, "t/" + name + " is not a "));
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_EQ(desk.text("t/" + name), "mine");
        EXPECT_EQ(desk.names("t"), std::vector<std::string>{name});
    }
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

// ---- rates

TEST(RatesCommand, JsonHasTheKeysOfTheContract) {
    const Outcome run =
        shell("oiler rates '" OILER_SOURCE
              "/assets/scenes/jump.toml' --rates 50,60 --methods semi_implicit_euler,exact "
              "--json - --quiet",
              0);
    EXPECT_EQ(run.err, "");
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("scene"), "jump");
    EXPECT_EQ(json.at("rates"), (Json{50, 60}));
    const Json& apex = json.at("quantities").at(0);
    EXPECT_EQ(apex.at("body"), "player");
    EXPECT_EQ(apex.at("unit"), "m");
    // 9 m/s against 20 m/s²
    EXPECT_NEAR(apex.at("truth").get<double>(), 81.0 / 40, 1e-9);
    EXPECT_EQ(apex.at("methods").at(0).at("method"), "semi_implicit_euler");
    // v0·n·h − g·h²·n(n+1)/2 at n = 22 and 27
    EXPECT_NEAR(apex.at("methods").at(0).at("values").at(0).get<double>(), 1.936, 1e-9);
    EXPECT_NEAR(apex.at("methods").at(0).at("values").at(1).get<double>(), 1.95, 1e-9);
    EXPECT_EQ(apex.at("methods").at(1).at("method"), "exact");
}

// As above. The true apex is 2.025 m; 1.95 m − 1.936 m is 0.69 % of it.
TEST(RatesCommand, PrintsEachQuantityInItsUnit) {
    const Outcome run =
        shell("oiler rates '" OILER_SOURCE
              "/assets/scenes/jump.toml' --rates 50,60 --methods semi_implicit_euler --quiet",
              0);
    EXPECT_TRUE(holds(run.out, ", m: 2.025\n"));
    EXPECT_TRUE(holds(run.out, " 50       60  spread\n"));
    EXPECT_TRUE(holds(run.out, " 1.936     1.95   0.69%\n"));
}

/// A body at rest, one on a spring of ω = 2π rad/s, and a third with a smaller amplitude.
const std::string still_and_swinging =
    "[scene]\naxes = 1\nrate = 100\nduration = 7.0\nmethod = \"velocity_verlet\"\n"
    "[[body]]\nname = \"still\"\nposition = [7.0]\n"
    "[[body]]\nname = \"mass\"\nposition = [1.0]\n"
    "[[spring]]\nbody = \"mass\"\nanchor = [0.0]\nstiffness = 39.47841760435743\n"
    "[[body]]\nname = \"slow\"\nposition = [0.5]\n"
    "[[spring]]\nbody = \"slow\"\nanchor = [0.0]\nstiffness = 9.869604401089358\n";

/// The JSON of `oiler rates` for that scene with these options.
Json rates_with(const std::string& options) {
    const Desk desk(still_and_swinging);
    const Outcome run = desk.run(
        "oiler rates scene.toml --rates 50,100 --methods exact --json - --quiet " + options, 0);
    return Json::parse(run.out);
}

// The period of ω = 2π rad/s is 1 s, that of π rad/s 2 s; cubics between samples 50 times a second
// are right to (ωh)⁴/384 of a radian.
TEST(RatesCommand, MeasuresTheLargestAmplitudeOrTheGivenBody) {
    for (const char* options : {"", "--body mass", "--body 1"}) {
        const Json period = rates_with(options).at("quantities").at(0);
        EXPECT_EQ(period.at("name"), "period");
        EXPECT_EQ(period.at("unit"), "s");
        EXPECT_EQ(period.at("body"), "mass") << options;
        EXPECT_NEAR(period.at("truth").get<double>(), 1, 1e-5);
        EXPECT_NEAR(period.at("methods").at(0).at("values").at(1).get<double>(), 1, 1e-3);
    }
    for (const char* options : {"--body slow", "--body 2"}) {
        const Json period = rates_with(options).at("quantities").at(0);
        EXPECT_EQ(period.at("body"), "slow") << options;
        EXPECT_NEAR(period.at("truth").get<double>(), 2, 1e-5);
    }
    EXPECT_EQ(rates_with("--body still").at("quantities"), Json::array());
}

// In two seconds x crosses 0 upwards twice, at 0.75 and 1.75 s. A period needs three crossings.
TEST(RatesCommand, MeasuresTheGivenDuration) {
    EXPECT_EQ(rates_with("--body mass --duration 1").at("quantities"), Json::array());
    EXPECT_EQ(rates_with("--body mass --duration 3").at("quantities").at(0).at("name"), "period");
}

// ---- report

TEST(Report, IsOneSelfContainedFile) {
    std::string scene = spring_scene("[budget]\nposition_error = 25.0\n");
    scene.replace(scene.find("100 "), 4, "20 ");
    scene.replace(scene.find("10.0"), 4, "1.5");
    // √144 = 12 rad/s: three upward crossings of the equilibrium in 1.5 s.
    scene.replace(scene.find("15.0"), 4, "144.0");
    scene.replace(scene.find("[[body]]"), 0, "[[body]]\nname = \"still\"\n\n");
    const Desk desk(scene);
    const Outcome run = desk.run("oiler report scene.toml --out page.html --quiet --json a.json");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(desk.names(), (std::vector<std::string>{"a.json", "page.html", "scene.toml"}));
    std::string page = desk.text("page.html");
    // The comments of Chart.js have URLs, which load no file.
    const std::string begin = "<script>/*!";
    const std::size_t library = page.find(begin);
    ASSERT_NE(library, std::string::npos);
    page.erase(library, page.find("</script>", library) - library);
    EXPECT_FALSE(holds(page, "http://"));
    EXPECT_FALSE(holds(page, "https://"));
    EXPECT_FALSE(holds(page, " src=\"") && !holds(page, " src=\"data:"));
    EXPECT_TRUE(holds(page, "data:image/png;base64,"));
    EXPECT_TRUE(holds(page, "A &lt;spring&gt; &amp; &quot;damper&quot;")) << page.substr(0, 1000);
    EXPECT_FALSE(holds(page, "<spring>"));
    for (const char* left : {"@DATA@", "@TITLE@", "@FRAME@", "@CHART_LIBRARY@"})
        EXPECT_FALSE(holds(page, left)) << left;
    const Json data = desk.json("a.json");
    for (const char* part :
         {"advice", "tradeoff", "stability", "rates", "ledger", "obvious_methods"})
        EXPECT_TRUE(data.contains(part)) << part;
    EXPECT_TRUE(data["tradeoff"].contains("current"));
    // The tolerance of the advice is the scene's budget.
    EXPECT_EQ(data["advice"]["requirements"]["position_error"], 25);
    EXPECT_EQ(data["advice"]["requirements"]["energy_drift"], nullptr);
    // Springs and rates are those of the second body.
    const Json& spring = data["stability"]["springs"][0];
    EXPECT_EQ(spring["name"], "springs of mass");
    EXPECT_DOUBLE_EQ(spring["omega"].get<double>(), 12);
    EXPECT_EQ(data["stability"]["rate"], 20);
    ASSERT_FALSE(data["rates"].is_null());
    EXPECT_EQ(data["rates"]["quantities"][0]["name"], "period");
    EXPECT_EQ(data["rates"]["quantities"][0]["body"], "mass");
}

TEST(Report, OfAnInvalidSceneWritesNothing) {
    const Desk desk("[scene]\naxes = 7\n");
    const Outcome run = desk.run("oiler report scene.toml --out page.html --json a.json", 2);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_EQ(desk.names(), std::vector<std::string>{"scene.toml"});
}

}  // namespace
}  // namespace oiler::test
