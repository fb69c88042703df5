// SPDX-License-Identifier: MIT
// The lab's commands as their users run them: tradeoff, merge, advise, rates, check, report, and
// the budgets that play keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

const std::string article = "'" OILER_SOURCE "/assets/scenes/article_spring.toml'";

/// Ten seconds of the article's spring, with remarks to keep and a budget.
std::string spring_scene(const std::string& budget) {
    return "# A remark at the top.\n[scene]\ntitle = \"A <spring> & \\\"damper\\\"\"\naxes = 1\n"
           "rate   = 100      # how often\n"
           "method = \"semi_implicit_euler\"  # how\n"
           "duration = 10.0\n\n"
           "[[body]]          # only one\nname = \"mass\"\nposition = [1000.0]\n\n"
           "[[spring]]\nbody = \"mass\"\nanchor = [0.0]\nstiffness = 15.0\ndamping = 0.1\n"
           "# The end.\n" +
           budget;
}

/// A folder with scene.toml, in which commands are run.
class Desk {
public:
    explicit Desk(const std::string& scene = spring_scene("")) { put("scene.toml", scene); }

    void put(const std::string& name, const std::string& text) const {
        test::put(folder_ / name, text);
    }
    [[nodiscard]] Outcome run(const std::string& line) const {
        return shell("cd '" + folder_.path().string() + "'; " + line);
    }
    [[nodiscard]] std::string text(const std::string& name) const {
        return text_of(folder_.path() / name);
    }
    [[nodiscard]] Json json(const std::string& name) const { return Json::parse(text(name)); }
    [[nodiscard]] std::vector<std::string> names(const std::string& name = ".") const {
        return names_in(folder_.path() / name);
    }

private:
    Folder folder_;
};

// ---- advise

TEST(Advise, SaysWhatTheContractPromises) {
    const Outcome run =
        shell("oiler advise " + article + " --duration 10 --position-error 1e-3 --json - --quiet");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const Json json = Json::parse(run.out);
    const Json& advice = json.at("advice");
    EXPECT_EQ(advice.at("method"), "exact");
    EXPECT_EQ(advice.at("rate"), 50);
    EXPECT_EQ(advice.at("precision"), "double");
    for (const char* number : {"position_error", "velocity_error", "energy_drift", "evaluations",
                               "ns_per_second", "ns_spread", "us_per_frame"})
        EXPECT_TRUE(advice.at(number).is_number() || advice.at(number).is_null()) << number;
    EXPECT_LT(advice.at("position_error").get<double>(), 1e-9);
    EXPECT_GT(advice.at("ns_per_second").get<double>(), 0);
    EXPECT_NEAR(advice.at("us_per_frame").get<double>(),
                advice.at("ns_per_second").get<double>() / 60e3, 1e-9);
    EXPECT_EQ(json.at("meets"), true);
    EXPECT_EQ(json.at("obstacles"), Json::array());
    EXPECT_EQ(json.at("wish").at("position_error"), 1e-3);
    EXPECT_EQ(json.at("wish").at("energy_drift"), nullptr);
    EXPECT_EQ(json.at("today").at("method"), "semi_implicit_euler");
    EXPECT_EQ(json.at("today").at("rate"), 100);
    EXPECT_NEAR(json.at("today").at("position_error").get<double>(), 19.8, 0.05);
    EXPECT_GT(json.at("runs").get<int>(), 0);
    EXPECT_TRUE(holds(json.at("words").at(0), "exact at 50 Hz in double"));
}

TEST(Advise, ForPeopleSaysTheConclusionFirst) {
    const Outcome run =
        shell("oiler advise " + article + " --duration 10 --position-error 1e-3 --quiet");
    EXPECT_EQ(run.exit, 0);
    EXPECT_TRUE(run.out.starts_with("exact at 50 Hz in double")) << run.out;
}

// Among velocity Verlet's the advice is the lowest rate that will do, in double: the error decides,
// and no time. It is a multiple of 60 Hz, so that both are looked at 60 times a second.
TEST(Advise, AppliedChangesTheChoiceAndNothingElse) {
    std::string scene = spring_scene("");
    scene.replace(scene.find("100 "), 4, "60   ");
    scene.replace(scene.find("duration"), 0, "precision = \"float\"\n");
    const Desk desk(scene);
    const std::string words =
        "oiler advise scene.toml --position-error 1e-3 --methods velocity_verlet --quiet --json ";
    EXPECT_EQ(desk.run(words + "before.json").exit, 0);
    EXPECT_EQ(desk.text("scene.toml"), scene);
    const Outcome run = desk.run(words + "advice.json --apply");
    EXPECT_EQ(run.exit, 0) << run.err;
    const Json advice = desk.json("advice.json").at("advice");
    EXPECT_EQ(advice.at("precision"), "double");
    const auto replace = [&](const std::string& what, const std::string& with) {
        scene.replace(scene.find(what), what.size(), with);
    };
    replace("float", "double");
    replace("60 ", std::to_string(advice.at("rate").get<int>()) + " ");
    replace("semi_implicit_euler", "velocity_verlet");
    // The columns of remarks may move with the words before them.
    const auto squeezed = [](const std::string& text) {
        std::string tight;
        for (const char c : text)
            if (c != ' ') tight += c;
        return tight;
    };
    EXPECT_EQ(squeezed(desk.text("scene.toml")), squeezed(scene));
    EXPECT_EQ(desk.run(words + "again.json").exit, 0);
    const Json again = desk.json("again.json");
    for (const char* part : {"method", "rate", "precision"}) {
        EXPECT_EQ(again.at("advice").at(part), advice.at(part)) << part;
        EXPECT_EQ(again.at("today").at(part), advice.at(part)) << part;
    }
    EXPECT_EQ(again.at("today").at("position_error"), advice.at("position_error"));
}

TEST(Advise, ThatNothingMeetsIsNotApplied) {
    const Desk desk;
    const Outcome run = desk.run(
        "oiler advise scene.toml --position-error 1e-9 --methods explicit_euler --apply --quiet "
        "--json advice.json");
    EXPECT_EQ(run.exit, 1) << run.err;
    EXPECT_EQ(desk.text("scene.toml"), spring_scene(""));
    const Json json = desk.json("advice.json");
    EXPECT_EQ(json.at("meets"), false);
    EXPECT_FALSE(json.at("obstacles").empty());
    EXPECT_EQ(json.at("advice").at("method"), "explicit_euler");
    EXPECT_TRUE(run.out.starts_with("Nothing keeps within 1e-09 m")) << run.out;
}

// ---- tradeoff and merge

const std::string few = "--methods semi_implicit_euler,velocity_verlet,rk4,exact --max-rate 400 ";

/// All but times and what is best by them.
Json accuracy_of(Json tradeoff) {
    for (Json& row : tradeoff.at("rows"))
        for (const char* name : {"ns_per_second", "ns_spread", "pareto"}) row.erase(name);
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
    EXPECT_TRUE(holds(run.out, "\n> semi_implicit_euler ")) << run.out;
    const Outcome all = desk.run("oiler tradeoff scene.toml " + few +
                                 "--out t --size 64x36 --quiet --all --json copy.json");
    EXPECT_GE(lines(all.out), static_cast<std::ptrdiff_t>(json.at("rows").size()));
    EXPECT_EQ(desk.text("copy.json"), desk.text("t/tradeoff.json"));
}

// The file is there as soon as a method is done; then there is a second and more to go.
TEST(TradeoffCommand, InterruptedGoesOnWhereItWas) {
    const Desk desk;
    const std::string command =
        "oiler tradeoff scene.toml --methods splitting --max-rate 6400 --size 64x36 --quiet --out ";
    const Outcome run = desk.run(command +
                                 "a & program=$!; while ! test -e a/tradeoff.json; do sleep 0.01; "
                                 "done; kill -INT $program; wait $program");
    EXPECT_EQ(run.exit, 130) << run.err;
    const Json part = desk.json("a/tradeoff.json");
    EXPECT_EQ(desk.names("a"), std::vector<std::string>{"tradeoff.json"});
    EXPECT_GE(part.at("rows").size(), 1U);
    // What it goes on with is not measured again: a mark in it stays.
    Json marked = part;
    marked.at("rows").at(0).at("velocity_error") = 4242;
    desk.put("a/tradeoff.json", marked.dump());
    const Outcome rest = desk.run(command + "a");
    if (rest.exit == 3) GTEST_SKIP() << rest.err;
    EXPECT_EQ(rest.exit, 0) << rest.err;
    EXPECT_EQ(desk.run(command + "b").exit, 0);
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

TEST(TradeoffCommand, InShardsAndMergedIsOneRun) {
    const Desk desk;
    const std::string command = "oiler tradeoff scene.toml " + few + "--size 64x36 --quiet --out ";
    for (const char* shard : {"1/4", "2/4", "3/4", "4/4"}) {
        const Outcome run = desk.run(command + "parts --shard " + shard);
        EXPECT_EQ(run.exit, 0) << run.err;
        EXPECT_EQ(run.out, "");
    }
    EXPECT_EQ(desk.names("parts"),
              (std::vector<std::string>{"part-1-of-4.json", "part-2-of-4.json", "part-3-of-4.json",
                                        "part-4-of-4.json"}));
    const Outcome missing = desk.run("oiler merge parts/part-[123]*.json --out merged");
    EXPECT_EQ(missing.exit, 2);
    EXPECT_EQ(lines(missing.err), 1) << missing.err;
    const Outcome merge =
        desk.run("oiler merge parts/part-*.json --out merged --size 64x36 --quiet");
    if (merge.exit == 3) GTEST_SKIP() << merge.err;
    EXPECT_EQ(merge.exit, 0) << merge.err;
    EXPECT_EQ(desk.run(command + "whole").exit, 0);
    EXPECT_EQ(accuracy_of(desk.json("merged/tradeoff.json")),
              accuracy_of(desk.json("whole/tradeoff.json")));
    EXPECT_EQ(desk.text("merged/tradeoff.csv").substr(0, 60),
              desk.text("whole/tradeoff.csv").substr(0, 60));
    // Parts of another duration are of another sweep.
    EXPECT_EQ(desk.run(command + "parts --shard 2/4 --duration 9").exit, 0);
    EXPECT_EQ(desk.run("oiler merge parts/part-*.json --out merged").exit, 2);
}

TEST(TradeoffCommand, MeasuresAMethodThatIsNamedTwiceOnce) {
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

// What else there is is done by threads; an error of writing is one line from any of them.
TEST(TradeoffCommand, ThatCannotWriteSaysSo) {
    const Desk desk;
    const Outcome run =
        desk.run("trap '' XFSZ; ulimit -f 4; oiler tradeoff scene.toml " + few + "--out t --quiet");
    EXPECT_EQ(run.exit, 4) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
}

// Where nothing moves there is no energy to tell drifts by; what is written is read again.
TEST(TradeoffCommand, OfASceneAtRestIsReadBack) {
    const Desk desk("[scene]\naxes = 1\nduration = 1.0\n[[body]]\nname = \"a\"\n");
    const Outcome run = desk.run(
        "oiler tradeoff scene.toml --methods rk4 --max-rate 100 --out t --shard 1/1 "
        "--size 64x36 --quiet");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    const Outcome merge = desk.run("oiler merge t/tradeoff.json --out u --size 64x36 --quiet");
    EXPECT_EQ(merge.exit, 0) << merge.err;
}

// ---- rates

TEST(RatesCommand, HasTheContractsJson) {
    const Outcome run =
        shell("oiler rates '" OILER_SOURCE
              "/assets/scenes/jump.toml' --rates 50,60 --methods semi_implicit_euler,exact "
              "--json - --quiet");
    EXPECT_EQ(run.exit, 0) << run.err;
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

// ---- check

/// Whether it is one element with what is in it, all of whose marks are closed and in order.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    std::size_t at = xml.find("?>");
    if (!xml.starts_with("<?xml ") || at == std::string::npos) return false;
    at += 2;
    std::size_t roots = 0;
    while ((at = xml.find_first_of("<&", at)) != std::string::npos) {
        if (xml[at] == '&') {
            const std::string rest = xml.substr(at, 6);
            if (!rest.starts_with("&amp;") && !rest.starts_with("&lt;") &&
                !rest.starts_with("&quot;") && !rest.starts_with("&gt;"))
                return false;
            ++at;
            continue;
        }
        bool quoted = false;
        std::size_t end = at;
        for (; end < xml.size() && (quoted || xml[end] != '>'); ++end) quoted ^= xml[end] == '"';
        if (end == xml.size()) return false;
        const std::string mark = xml.substr(at + 1, end - at - 1);
        if (holds(mark, "<")) return false;
        std::string name;
        std::istringstream(mark) >> name;
        if (mark.starts_with("/")) {
            if (open.empty() || "/" + open.back() != mark) return false;
            open.pop_back();
        } else {
            if (open.empty()) ++roots;
            if (!mark.ends_with("/")) open.push_back(name);
        }
        at = std::min(end, xml.find('&', at));
    }
    return open.empty() && roots == 1;
}

TEST(IsWellFormed, TellsWhatIsNot) {
    EXPECT_TRUE(is_well_formed("<?xml version=\"1.0\"?>\n<a x=\"1\"><b/>&amp;</a>\n"));
    for (const char* bad : {"<a/>", "<?xml ?><a>", "<?xml ?><a></b>", "<?xml ?><a/><b/>",
                            "<?xml ?><a x=\"&\"/>", "<?xml ?><a x=\"/>", "<?xml ?><a x=\"<\"/>"})
        EXPECT_FALSE(is_well_formed(bad)) << bad;
}

TEST(Check, IsDoneWhereBudgetsAreKept) {
    const Desk desk(spring_scene("[budget]\nposition_error = 25.0\n"));
    const Outcome run = desk.run("oiler check scene.toml");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(run.out, "scene.toml: position_error 19.8 m of 25 m: kept\n");
    EXPECT_EQ(run.err, "");
}

TEST(Check, OfSeveralScenesTellsEachForACi) {
    const Desk desk(spring_scene("[budget]\nposition_error = 25.0\nenergy_drift = 1e-4\n"));
    desk.put("a <b> & \"c\".toml", spring_scene("[budget]\nposition_error = 19.0\n"));
    desk.put("none.toml", spring_scene(""));
    const Outcome run =
        desk.run("oiler check scene.toml a*.toml none.toml --junit a.xml --json a.json");
    EXPECT_EQ(run.exit, 1) << run.err;
    EXPECT_EQ(lines(run.out), 4) << run.out;
    EXPECT_TRUE(holds(run.out, "none.toml: no [budget]\n"));
    EXPECT_TRUE(holds(run.out, "19.8 m of 19 m: exceeded\n")) << run.out;
    const std::string xml = desk.text("a.xml");
    EXPECT_TRUE(is_well_formed(xml)) << xml;
    EXPECT_TRUE(holds(xml, "tests=\"4\" failures=\"2\" errors=\"0\" skipped=\"1\"")) << xml;
    EXPECT_EQ(count_of(xml, "<testcase "), 4U);
    EXPECT_EQ(count_of(xml, "<failure "), 2U);
    EXPECT_EQ(count_of(xml, "<skipped "), 1U);
    EXPECT_TRUE(holds(xml, "<failure message=\"position_error 19.8 m of 19 m: exceeded\"/>"));
    EXPECT_TRUE(holds(xml, "classname=\"a &lt;b> &amp; &quot;c&quot;.toml\"")) << xml;
    const Json json = desk.json("a.json");
    ASSERT_EQ(json.size(), 3U);
    EXPECT_EQ(json.at(0).at("kept"), false);
    EXPECT_EQ(json.at(0).at("position_error").at("kept"), true);
    EXPECT_NEAR(json.at(0).at("position_error").at("measured").get<double>(), 19.8, 0.05);
    EXPECT_EQ(json.at(0).at("position_error").at("budget"), 25);
    EXPECT_EQ(json.at(0).at("energy_drift").at("kept"), false);
    EXPECT_EQ(json.at(1).at("kept"), false);
    EXPECT_EQ(json.at(2).at("kept"), true);
}

TEST(Check, OfTheHousesScenesIsDone) {
    const Outcome run = shell("cd '" OILER_SOURCE
                              "/assets/scenes'; oiler check article_spring.toml jump.toml "
                              "article_spring_undamped.toml orbit.toml");
    EXPECT_EQ(run.exit, 0) << run.out << run.err;
    EXPECT_EQ(count_of(run.out, ": kept\n"), 4U) << run.out;
}

// A file may be called anything; what is written of it is JSON and XML all the same.
TEST(Check, OfAFileWhoseNameIsNoText) {
    const Desk desk;
    const Outcome run = desk.run(
        "name=$(printf 'b\\377\\001.toml'); cp scene.toml \"$name\"; "
        "oiler check \"$name\" --json a.json --junit a.xml");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(desk.json("a.json").size(), 1U);
    EXPECT_FALSE(holds(desk.text("a.xml"), "\377"));
    EXPECT_FALSE(holds(desk.text("a.xml"), "\001"));
}

// ---- play

class BudgetOfPlay : public testing::TestWithParam<const char*> {};

TEST_P(BudgetOfPlay, ThatIsExceededFailsInOneLine) {
    const Desk desk(spring_scene("[budget]\nposition_error = 5.0\n"));
    const std::string command =
        std::string("oiler play scene.toml --quiet --json a.json ") + GetParam();
    const Outcome run = desk.run(command);
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 1) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_TRUE(run.err.starts_with("[budget] ")) << run.err;
    EXPECT_TRUE(holds(run.err, "position_error 19.8 m of 5 m: exceeded")) << run.err;
    const Json budget = desk.json("a.json").at("budget").at("position_error");
    EXPECT_EQ(budget.at("budget"), 5);
    EXPECT_EQ(budget.at("kept"), false);
    EXPECT_NEAR(budget.at("measured").get<double>(), 19.8, 0.05);

    const Outcome kept = desk.run(command + " --method rk4");
    EXPECT_EQ(kept.exit, 0) << kept.err;
    EXPECT_EQ(kept.err, "");
    EXPECT_EQ(desk.json("a.json").at("budget").at("position_error").at("kept"), true);
    // An error of first order: a tenth of the step is a tenth of 19.8 m, more or less.
    EXPECT_EQ(desk.run(command + " --rate 1000").exit, 0);
    EXPECT_NEAR(desk.json("a.json").at("budget").at("position_error").at("measured").get<double>(),
                1.98, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, BudgetOfPlay,
                         testing::Values("--headless --frames 2 --size 64x36 --out frames",
                                         "--steps 20"));

TEST(PlayBudget, ThatIsNoneIsNotReported) {
    const Desk desk;
    EXPECT_EQ(desk.run("oiler play scene.toml --quiet --steps 3 --json a.json").exit, 0);
    EXPECT_FALSE(desk.json("a.json").contains("budget"));
}

// ---- report

TEST(Report, IsOneFileThatNeedsNoOther) {
    std::string scene = spring_scene("[budget]\nposition_error = 25.0\n");
    scene.replace(scene.find("100 "), 4, "20 ");
    scene.replace(scene.find("10.0"), 4, "1.0");
    const Desk desk(scene);
    const Outcome run = desk.run("oiler report scene.toml --out page.html --quiet --json a.json");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(desk.names(), (std::vector<std::string>{"a.json", "page.html", "scene.toml"}));
    std::string page = desk.text("page.html");
    // The library that draws the charts begins with its licence and ends with its script.
    const std::string begin = "<script>/*!";
    const std::size_t library = page.find(begin);
    ASSERT_NE(library, std::string::npos);
    page.erase(library, page.find("</script>", library) - library);
    EXPECT_FALSE(holds(page, "http://"));
    EXPECT_FALSE(holds(page, "https://"));
    EXPECT_FALSE(holds(page, " src=\"") && !holds(page, " src=\"data:"));
    EXPECT_TRUE(holds(page, "data:image/png;base64,"));
    EXPECT_TRUE(holds(page, "A &lt;spring> &amp; \"damper\"")) << page.substr(0, 1000);
    EXPECT_FALSE(holds(page, "<spring>"));
    for (const char* left : {"@DATA@", "@TITLE@", "@FRAME@", "@CHART_LIBRARY@"})
        EXPECT_FALSE(holds(page, left)) << left;
    const Json data = desk.json("a.json");
    for (const char* part : {"advice", "tradeoff", "stability", "rates", "ledger", "today"})
        EXPECT_TRUE(data.contains(part)) << part;
}

TEST(Report, OfABadSceneLeavesNothing) {
    const Desk desk("[scene]\naxes = 7\n");
    const Outcome run = desk.run("oiler report scene.toml --out page.html --json a.json");
    EXPECT_EQ(run.exit, 2);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_EQ(desk.names(), std::vector<std::string>{"scene.toml"});
}

// ---- wrong use

class WrongUseOfTheLab : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(WrongUseOfTheLab, IsRefusedInOneLineThatNamesIt) {
    const auto [words, named] = GetParam();
    const Desk desk;
    desk.put("tight.toml", spring_scene("[budget]\nenergy_drift = 1e-15\n"));
    desk.put("tighter.toml", spring_scene("[budget]\nposition_error = 1e-15\n"));
    const auto before = desk.names();
    const Outcome run = desk.run(std::string("oiler ") + words);
    EXPECT_EQ(run.exit, 2);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_TRUE(holds(run.err, named)) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(desk.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongUseOfTheLab,
    testing::Values(std::pair{"advise scene.toml", "--position-error"},
                    std::pair{"advise", "SCENE"},
                    std::pair{"advise scene.toml --position-error 1 --methods rk5", "rk5"},
                    std::pair{"advise scene.toml --position-error 0", "--position-error"},
                    std::pair{"advise scene.toml --position-error -1", "--position-error"},
                    std::pair{"advise scene.toml --position-error nan", "--position-error"},
                    std::pair{"advise scene.toml --position-error 1e-15 --quiet", "1e-15"},
                    std::pair{"advise scene.toml --energy-drift 1e-15 --quiet", "1e-15"},
                    std::pair{"advise scene.toml --budget-us inf", "--budget-us"},
                    std::pair{"advise scene.toml --position-error 1 --duration 1e-4", "--duration"},
                    std::pair{"advise scene.toml --position-error 1 --min-rate 0", "--min-rate"},
                    std::pair{"tradeoff scene.toml --shard 5/4", "--shard 5/4"},
                    std::pair{"tradeoff scene.toml --shard 0/4", "--shard 0/4"},
                    std::pair{"tradeoff scene.toml --shard x", "--shard x"},
                    std::pair{"tradeoff scene.toml --shard 1/4x", "--shard 1/4x"},
                    std::pair{"tradeoff scene.toml --shard 1", "--shard 1"},
                    std::pair{"tradeoff scene.toml --max-rate 0", "--max-rate"},
                    std::pair{"tradeoff scene.toml --size 3", "--size"},
                    std::pair{"tradeoff scene.toml --methods rk5", "rk5"},
                    std::pair{"merge", "PART"}, std::pair{"merge scene.toml", "scene.toml"},
                    std::pair{"rates scene.toml --rates 0", "--rates 0"},
                    std::pair{"rates scene.toml --rates 60,x", "--rates 60,x"},
                    std::pair{"rates scene.toml --rates 60,1e3", "--rates 60,1e3"},
                    std::pair{"rates scene.toml --body nobody --quiet", "nobody"},
                    std::pair{"check", "SCENE"},
                    std::pair{"check tight.toml", "energy_drift = 1e-15"},
                    std::pair{"check tighter.toml", "tighter.toml"},
                    std::pair{"check scene.toml --rate 3", "--rate"},
                    std::pair{"report scene.toml --duration 0", "--duration"}));

TEST(Lab, CommandsHaveExamples) {
    for (const std::string command : {"tradeoff", "merge", "advise", "rates", "check", "report"}) {
        const Outcome run = shell("oiler " + command + " --help");
        EXPECT_EQ(run.exit, 0);
        EXPECT_TRUE(holds(run.out, "Example: oiler " + command + " ")) << command;
        EXPECT_LE(lines(run.out), 24) << command;
    }
}

}  // namespace
}  // namespace oiler::test
