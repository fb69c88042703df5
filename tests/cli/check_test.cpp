// SPDX-License-Identifier: MIT
// Runs `oiler check`, and `oiler play` with budgets, as users do.
#include <fmt/format.h>

#include <limits>

#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

// ---- check

/// Whether the text is one XML element whose tags are all closed in order.
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
                !rest.starts_with("&quot;") && !rest.starts_with("&gt;") && !rest.starts_with("&#"))
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

TEST(IsWellFormed, RefusesMalformedText) {
    EXPECT_TRUE(is_well_formed("<?xml version=\"1.0\"?>\n<a x=\"1\"><b/>&amp;</a>\n"));
    for (const char* bad : {"<a/>", "<?xml ?><a>", "<?xml ?><a></b>", "<?xml ?><a/><b/>",
                            "<?xml ?><a x=\"&\"/>", "<?xml ?><a x=\"/>", "<?xml ?><a x=\"<\"/>"})
        EXPECT_FALSE(is_well_formed(bad)) << bad;
}

TEST(Check, ExitsWith0IfBudgetsAreKept) {
    const Desk desk(spring_scene("[budget]\nposition_error = 25.0\n"));
    const Outcome run = desk.run("oiler check scene.toml", 0);
    EXPECT_EQ(run.out, "scene.toml: position_error 19.8 m of 25 m: kept\n");
    EXPECT_EQ(run.err, "");
}

TEST(Check, ReportsEachSceneToACi) {
    const Desk desk(spring_scene("[budget]\nposition_error = 25.0\nenergy_drift = 1e-4\n"));
    desk.put("a <b> & \"c\".toml", spring_scene("[budget]\nposition_error = 19.0\n"));
    desk.put("none.toml", spring_scene(""));
    const Outcome run =
        desk.run("oiler check scene.toml a*.toml none.toml --junit a.xml --json a.json", 1);
    EXPECT_EQ(lines(run.out), 4) << run.out;
    EXPECT_TRUE(holds(run.out, "none.toml: no [budget]\n"));
    EXPECT_TRUE(holds(run.out, "19.8 m of 19 m: exceeded\n"));
    const std::string xml = desk.text("a.xml");
    EXPECT_TRUE(is_well_formed(xml)) << xml;
    EXPECT_TRUE(holds(xml, "tests=\"4\" failures=\"2\" errors=\"0\" skipped=\"1\""));
    EXPECT_EQ(count_of(xml, "<testcase "), 4U);
    EXPECT_EQ(count_of(xml, "<failure "), 2U);
    EXPECT_EQ(count_of(xml, "<skipped "), 1U);
    EXPECT_TRUE(holds(xml, "<failure message=\"position_error 19.8 m of 19 m: exceeded\"/>"));
    EXPECT_TRUE(holds(xml, "classname=\"a &lt;b&gt; &amp; &quot;c&quot;.toml\""));
    const Json json = desk.json("a.json");
    ASSERT_EQ(json.size(), 3U);
    EXPECT_EQ(json.at(0).at("kept"), false);
    EXPECT_EQ(json.at(0).at("position_error").at("kept"), true);
    EXPECT_NEAR(json.at(0).at("position_error").at("measured").get<double>(), 19.8, 0.05);
    EXPECT_EQ(json.at(0).at("position_error").at("budget"), 25);
    EXPECT_EQ(json.at(0).at("energy_drift").at("kept"), false);
    EXPECT_EQ(json.at(1).at("kept"), false);
    EXPECT_EQ(json.at(2).at("kept"), nullptr);
}

// The closed form of a thrown body is exact, also for rk4: the error is below any limit but that of
// the reference. With semi-implicit Euler it is g·t·dt/2 = 20·1/120 m.
TEST(Check, SaysWhichNumbersAreLimits) {
    const auto thrown = [](const char* method) {
        return fmt::format(
            "[scene]\naxes = 1\nrate = 60\nduration = 1.0\nmethod = \"{}\"\n[gravity]\n"
            "acceleration = [-20.0]\n[[body]]\nvelocity = [10.0]\n[budget]\nposition_error = 1.0\n"
            "energy_drift = 1.0\n",
            method);
    };
    const Desk desk(thrown("rk4"));
    desk.put("coarse.toml", thrown("semi_implicit_euler"));
    desk.run("oiler check scene.toml coarse.toml --json a.json", 0);
    const Json json = desk.json("a.json");
    EXPECT_EQ(json.at(0).at("energy_drift").at("is_limit"), true);
    EXPECT_LE(json.at(0).at("energy_drift").at("measured").get<double>(), 1e-12);
    EXPECT_FALSE(json.at(1).at("position_error").contains("is_limit"));
    EXPECT_NEAR(json.at(1).at("position_error").at("measured").get<double>(), 1 / 6.0, 0.01);
    const Outcome run = desk.run("oiler play scene.toml --steps 60 --quiet --json -", 0);
    EXPECT_EQ(Json::parse(run.out).at("budget").at("energy_drift").at("is_limit"), true);
    EXPECT_FALSE(Json::parse(run.out).at("budget").at("position_error").contains("is_limit"));
}

/// 10^15 steps, some months.
const std::string endless =
    "[scene]\naxes = 1\nrate = 1000000\nduration = 1e9\n[gravity]\nacceleration = [-1.0]\n"
    "[[body]]\n";

TEST(Check, SaysBeforehandThatItTakesLong) {
    const Desk desk(endless);
    const Outcome run = desk.run("oiler check scene.toml --time-limit 1", 4);
    EXPECT_TRUE(holds(run.err, "scene.toml: 1e+15 steps take about ")) << run.err;
    EXPECT_TRUE(holds(run.err, " days; --time-limit S ends earlier\n")) << run.err;
}

// A run that polls ends, and its files are written.
TEST(Check, ReportsTheScenesThatTheTimeLimitLeaves) {
    const Desk desk(endless);
    desk.put("other.toml", spring_scene(""));
    for (const char* limit : {"0", "0.02"}) {
        const Outcome run = desk.run(
            fmt::format("oiler check scene.toml other.toml --time-limit {} --quiet --junit a.xml "
                        "--json a.json",
                        limit),
            4);
        for (const std::string file : {"scene.toml", "other.toml"})
            EXPECT_TRUE(holds(run.err, "oiler: " + file +
                                           ": not checked to its end: the time limit is reached\n"))
                << run.err;
        EXPECT_TRUE(run.err.ends_with("oiler: the time limit is reached\n")) << run.err;
        EXPECT_TRUE(holds(desk.text("a.xml"), "tests=\"2\" failures=\"0\" errors=\"2\""));
        EXPECT_TRUE(holds(desk.json("a.json").at(1).at("error").get<std::string>(), "not checked"));
    }
}

/// A folder with a scene within its budget, one that exceeds it, and an invalid scene.
class CheckOfThree : public testing::Test {
protected:
    CheckOfThree() {
        desk_.put("exceeded.toml", spring_scene("[budget]\nposition_error = 19.0\n"));
        desk_.put("bad.toml", "[scene]\naxes = 7\n");
    }

    Desk desk_{spring_scene("[budget]\nposition_error = 25.0\n")};
};

// The exit code of an invalid file wins; both faults are reported, in any order of the files.
TEST_F(CheckOfThree, AnInvalidSceneDecidesTheExitCode) {
    for (const char* files : {"bad.toml exceeded.toml", "exceeded.toml bad.toml",
                              "scene.toml bad.toml exceeded.toml scene.toml"}) {
        const Outcome run = desk_.run(std::string("oiler check ") + files, 2);
        EXPECT_TRUE(holds(run.out, "exceeded.toml: position_error 19.8 m of 19 m: exceeded\n"));
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_TRUE(holds(run.err, "bad.toml"));
    }
    desk_.run("oiler check scene.toml bad.toml", 2);
    desk_.run("oiler check bad.toml scene.toml", 2);
    desk_.run("oiler check scene.toml exceeded.toml", 1);
    desk_.run("oiler check exceeded.toml scene.toml", 1);
}

// In JUnit, an exceeded budget is a failure and an unreadable scene an error.
TEST_F(CheckOfThree, JUnitHasAnErrorAndAFailure) {
    desk_.run("oiler check bad.toml exceeded.toml scene.toml --junit a.xml --json a.json", 2);
    const std::string xml = desk_.text("a.xml");
    EXPECT_TRUE(is_well_formed(xml)) << xml;
    EXPECT_TRUE(holds(xml, "tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\""));
    EXPECT_TRUE(holds(xml, "classname=\"bad.toml\" name=\"budget\"><error message=\""));
    EXPECT_EQ(count_of(xml, "<error "), 1U);
    EXPECT_EQ(count_of(xml, "<failure "), 1U);
    EXPECT_EQ(count_of(xml, "<skipped "), 0U);
    const Json json = desk_.json("a.json");
    ASSERT_EQ(json.size(), 3U);
    EXPECT_TRUE(holds(json.at(0).at("error"), "axes")) << json;
    EXPECT_FALSE(json.at(0).contains("kept")) << json;
    EXPECT_EQ(json.at(1).at("kept"), false);
    EXPECT_EQ(json.at(2).at("kept"), true);
}

TEST_F(CheckOfThree, WithJsonOnStandardOutputPrintsNothingElse) {
    const Outcome run = desk_.run("oiler check scene.toml exceeded.toml --json -", 1);
    EXPECT_EQ(Json::parse(run.out).size(), 2U);
}

TEST_F(CheckOfThree, WithJUnitOnStandardOutputPrintsNothingElse) {
    const Outcome run = desk_.run("oiler check scene.toml --junit -", 0);
    EXPECT_TRUE(is_well_formed(run.out)) << run.out;
}

TEST(Check, AcceptsAllShippedScenes) {
    const Outcome run = shell("cd '" OILER_SOURCE
                              "/assets/scenes'; oiler check article_spring.toml jump.toml "
                              "article_spring_undamped.toml orbit.toml",
                              0);
    EXPECT_EQ(count_of(run.out, ": kept\n"), 4U) << run.out;
}

// File names with special characters are escaped in JSON and XML.
TEST(Check, EscapesFileNames) {
    const Desk desk;
    desk.run(
        "name=$(printf 'b\\377\\001.toml'); cp scene.toml \"$name\"; "
        "oiler check \"$name\" --json a.json --junit a.xml",
        0);
    EXPECT_EQ(desk.json("a.json").size(), 1U);
    EXPECT_FALSE(holds(desk.text("a.xml"), "\377"));
    EXPECT_FALSE(holds(desk.text("a.xml"), "\001"));
}

/// Ten seconds of a spring of ω·dt = 2.4, which diverges after 9.4 s.
std::string diverging_scene(const std::string& budget) {
    return "[scene]\naxes = 1\nrate = 60\nmethod = \"semi_implicit_euler\"\nduration = 10.0\n"
           "[[body]]\nname = \"mass\"\nposition = [1.0]\n"
           "[[spring]]\nbody = \"mass\"\nanchor = [0.0]\nstiffness = 20736.0\n" +
           budget;
}

const std::string warning_of_the_scene =
    "spring of body 'mass': ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 73 Hz, or "
    "implicit_midpoint";

// The spring turns, so that a trial finds its rate: one from the state of a run that has diverged
// would find another rate, or none, depending on how far the state has grown.
TEST(Check, PlayAndLedgerNameOneRemedyOfADivergence) {
    const Desk desk(
        "[scene]\naxes = 2\nrate = 60\nmethod = \"semi_implicit_euler\"\nduration = 20.0\n"
        "[gravity]\nacceleration = [0.0, -9.81]\n"
        "[[body]]\nname = \"mass\"\nposition = [1.0, 0.3]\nlinear_drag = 0.2\n"
        "[[spring]]\nbody = \"mass\"\nanchor = [0.0, 0.0]\nstiffness = 1e6\nrest_length = 1.0\n");
    const std::string play = desk.run("oiler play scene.toml --steps 1200", 5).err;
    const std::string warning = play.substr(0, play.find('\n'));
    EXPECT_TRUE(holds(warning, "spring of body 'mass': ω·dt up to 16.67")) << play;
    EXPECT_TRUE(holds(warning, "rate ≥ ")) << play;
    const std::string cause = "is no longer finite; " + warning;
    EXPECT_TRUE(holds(play, cause)) << play;
    const std::string check = desk.run("oiler check scene.toml", 5).out;
    EXPECT_TRUE(holds(check, cause)) << check;
    const std::string ledger = desk.run("oiler ledger scene.toml", 5).err;
    EXPECT_TRUE(holds(ledger, cause)) << ledger;
}

TEST(Check, RunsASceneWithoutABudgetAndReportsItsDivergence) {
    const Desk desk(diverging_scene(""));
    const Outcome run = desk.run("oiler check scene.toml --junit a.xml --json a.json", 5);
    EXPECT_TRUE(holds(run.out, "scene.toml: warning: " + warning_of_the_scene + "\n"));
    EXPECT_TRUE(holds(run.out, "scene.toml: diverged at step 563 (t = 9.38"));
    EXPECT_TRUE(holds(run.out, " x of body 'mass' is no longer finite; "));
    EXPECT_TRUE(holds(run.out, "scene.toml: no [budget]\n"));
    const std::string xml = desk.text("a.xml");
    EXPECT_TRUE(is_well_formed(xml)) << xml;
    EXPECT_TRUE(holds(xml, "tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\""));
    EXPECT_TRUE(holds(xml, "name=\"preflight\"><system-out>spring of body 'mass': "));
    EXPECT_TRUE(holds(xml, "name=\"run\"><failure message=\"diverged at step 563 "));
    const Json json = desk.json("a.json");
    EXPECT_EQ(json.at(0).at("kept"), false);
    EXPECT_EQ(json.at(0).at("warnings"), Json::array({warning_of_the_scene}));
    EXPECT_TRUE(json.at(0).at("diverged").get<std::string>().starts_with("diverged at step 563 "));
}

TEST(Check, HasNoWarningsOfAStableScene) {
    const Desk desk;
    desk.run("oiler check scene.toml --json a.json", 0);
    EXPECT_EQ(desk.json("a.json").at(0).at("warnings"), Json::array());
    EXPECT_FALSE(desk.json("a.json").at(0).contains("diverged"));
}

/// The first tick at which the energy of that spring overflows, by the recurrence of the method.
int tick_of_overflow() {
    constexpr double dt = 1.0 / 60;
    constexpr double stiffness = 20736;
    double x = 1;
    double v = 0;
    for (int tick = 0;; ++tick) {
        const long double energy = 0.5L * v * v + 0.5L * stiffness * x * x;
        if (energy > std::numeric_limits<double>::max()) return tick;
        v -= stiffness * x * dt;
        x += v * dt;
    }
}

TEST(Check, NamesTheTickAtWhichTheEnergyOverflowsAsPlayDoes) {
    const Desk desk(diverging_scene(""));
    const std::string line = "the energy is no longer finite at tick " +
                             std::to_string(tick_of_overflow()) + ": body 'mass' moves at ";
    const Outcome run = desk.run(
        "sed -i 's/duration = 10.0/duration = 5.0/' scene.toml; oiler check scene.toml", 5);
    EXPECT_TRUE(holds(run.out, "scene.toml: " + line)) << run.out;
    for (const char* options : {"--steps 300", "--steps 290", "--steps 300 --energy e.csv",
                                "--steps 300 --trace t.csv"}) {
        const Outcome played =
            desk.run("oiler play scene.toml --quiet --json a.json " + std::string(options), 5);
        EXPECT_TRUE(holds(played.err, line)) << options << played.err;
        EXPECT_EQ(desk.json("a.json").at("steps"), tick_of_overflow()) << options;
        EXPECT_EQ(desk.json("a.json").at("energy").at("last"), nullptr);
    }
}

// One place names the cause, whether the state or the energy overflows first.
TEST(Check, NamesTheCauseOfAnEnergyThatOverflows) {
    const Desk desk(diverging_scene(""));
    desk.run("sed -i 's/duration = 10.0/duration = 5.0/' scene.toml", 0);
    const std::string cause = " m/s; " + warning_of_the_scene + "\n";
    EXPECT_TRUE(holds(desk.run("oiler check scene.toml", 5).out, cause));
    for (const char* options : {"--steps 300 --json a.json", "--steps 300 --energy e.csv",
                                "--headless --png none --out f --frames 300 --size 16x16"}) {
        const Outcome played = desk.run("oiler play scene.toml --quiet " + std::string(options), 5);
        EXPECT_TRUE(holds(played.err, cause)) << options << played.err;
    }
}

// Half of 20736 N/m times (1e160 m)², and half of (1e160 m/s)², are not finite.
TEST(Check, FailsABudgetOfASceneWhoseEnergyIsNotFiniteAtTheStart) {
    const std::string start = "the energy is not finite at the start: body 'mass' ";
    const std::string far = start +
                            "is 1e+160 m from the origin, too far for a finite energy: place it "
                            "nearer, or give it weaker forces";
    const std::string fast =
        start + "moves at 1e+160 m/s, too fast for a finite energy: give it a lower speed";
    for (const auto& [change, line] : {std::pair{"s/position = .*/position = [1e160]/", far},
                                       std::pair{"s/position = .*/velocity = [1e160]/", fast}}) {
        const Desk desk(diverging_scene("[budget]\nposition_error = 1.0\n"));
        desk.run("sed -i '" + std::string(change) + "; s/20736/10/' scene.toml", 0);
        const Outcome run = desk.run("oiler check scene.toml --junit a.xml", 5);
        EXPECT_EQ(run.out,
                  "scene.toml: " + line + "\nscene.toml: [budget] not checked: the run diverges\n");
        const std::string xml = desk.text("a.xml");
        EXPECT_TRUE(holds(xml, "tests=\"2\" failures=\"2\" errors=\"0\" skipped=\"0\""));
        EXPECT_TRUE(holds(xml, "name=\"budget\"><failure message=\"[budget] not checked"));
        EXPECT_TRUE(holds(desk.run("oiler play scene.toml --quiet --steps 1", 5).err, line));
    }
}

TEST(Check, NamesTheAttractorThatABodyStartsOn) {
    const Desk desk(
        "[scene]\naxes = 2\nrate = 60\nduration = 1.0\n[[body]]\nname = \"free\"\nposition = [5.0, "
        "0.0]\nvelocity = [9.0, 0.0]\n[[body]]\nname = \"mass\"\nposition = [1.0, 0.0]\n"
        "[[attractor]]\nposition = [1.0, 0.0]\ngm = 1.0\n");
    const std::string cause =
        "body 'mass' is on an attractor, where the force has no direction: move the body\n";
    const Outcome run = desk.run("oiler check scene.toml", 5);
    EXPECT_TRUE(holds(run.out, "is no longer finite; " + cause)) << run.out;
    for (const char* options : {"--steps 1", "--steps 1 --energy e.csv"}) {
        const Outcome played = desk.run("oiler play scene.toml --quiet " + std::string(options), 5);
        EXPECT_TRUE(played.err.ends_with(cause)) << played.err;
    }
}

TEST(Check, CountsTheStepsBeforeADivergenceHoweverTheyAreTaken) {
    const Desk desk(diverging_scene(""));
    for (const char* options : {"--steps 600", "--steps 563", "--steps 600 --trace t.csv",
                                "--headless --png none --out f --frames 600 --size 16x16"}) {
        desk.run("oiler play scene.toml --quiet --json a.json " + std::string(options), 5);
        EXPECT_EQ(desk.json("a.json").at("steps"), 562) << options;
    }
}

// Each step grows by the root of z² + 3.76·z + 1, 3.47: by 10^130 in 4 s, which has a finite
// square, and by less than 10 in 0.03 s.
TEST(Check, CallsARunUnstableThatGrowsButStaysFinite) {
    const Desk desk(diverging_scene(""));
    const Outcome run = desk.run(
        "sed -i 's/duration = 10.0/duration = 4.0/' scene.toml; "
        "oiler check scene.toml --junit a.xml --json a.json",
        5);
    EXPECT_TRUE(holds(run.out, warning_of_the_scene));
    const std::string line = "unstable: bodies move to more than 10 times the extent";
    EXPECT_TRUE(holds(run.out, "scene.toml: " + line));
    EXPECT_TRUE(holds(desk.text("a.xml"), "name=\"run\"><failure message=\"" + line));
    EXPECT_TRUE(holds(desk.json("a.json").at(0).at("diverged"), line));
    const Outcome brief = desk.run(
        "sed -i 's/duration = 4.0/duration = 0.03/' scene.toml; oiler check scene.toml", 0);
    EXPECT_TRUE(holds(brief.out, warning_of_the_scene));
}

// 2 outweighs 5, and 5 outweighs 1, in any order of the files.
TEST_F(CheckOfThree, ADivergenceOutweighsABudgetButNotAnInvalidScene) {
    desk_.put("diverging.toml", diverging_scene(""));
    for (const char* files : {"diverging.toml exceeded.toml", "exceeded.toml diverging.toml"})
        desk_.run(std::string("oiler check ") + files, 5);
    for (const char* files : {"diverging.toml bad.toml", "bad.toml diverging.toml"})
        desk_.run(std::string("oiler check ") + files, 2);
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
    EXPECT_TRUE(holds(run.err, "position_error 19.8 m of 5 m: exceeded"));
    const Json budget = desk.json("a.json").at("budget").at("position_error");
    EXPECT_EQ(budget.at("budget"), 5);
    EXPECT_EQ(budget.at("kept"), false);
    EXPECT_NEAR(budget.at("measured").get<double>(), 19.8, 0.05);

    const Outcome kept = desk.run(command + " --method rk4", 0);
    EXPECT_EQ(kept.err, "");
    EXPECT_EQ(desk.json("a.json").at("budget").at("position_error").at("kept"), true);
    // First order: a tenth of the step has about a tenth of the error of 19.8 m.
    desk.run(command + " --rate 1000", 0);
    EXPECT_NEAR(desk.json("a.json").at("budget").at("position_error").at("measured").get<double>(),
                1.98, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, BudgetOfPlay,
                         testing::Values("--headless --fps 1 --frames 11 --size 64x36 --out frames",
                                         "--steps 10000"));

TEST(PlayBudget, IsCheckedHeadlessButNotInAWindow) {
    const Desk desk(spring_scene("[budget]\nposition_error = 5.0\n"));
    const Outcome run =
        desk.run("oiler play scene.toml --headless --fps 1 --frames 11 --size 64x36 --out frames");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 1) << run.err;
    desk.run("oiler play scene.toml --quiet --steps 1000 --trace t.csv", 0);
}

TEST(CheckCommand, QuietPrintsOnlyWhatFails) {
    const Desk desk(spring_scene("[budget]\nposition_error = 5.0\n"));
    desk.put("kept.toml", spring_scene("[budget]\nposition_error = 50.0\n"));
    desk.put("none.toml", spring_scene(""));
    const Outcome run = desk.run("oiler check kept.toml none.toml scene.toml --quiet", 1);
    EXPECT_EQ(lines(run.out), 1) << run.out;
    EXPECT_TRUE(run.out.starts_with("scene.toml: position_error 19.8 m")) << run.out;
    EXPECT_EQ(desk.run("oiler check kept.toml none.toml --quiet").out, "");
}

// 20 steps at 100 Hz are 0.2 s.
TEST(PlayBudget, IsMeasuredOverTheTimePlayed) {
    const Desk desk(spring_scene("[budget]\nposition_error = 50.0\n"));
    const auto measured = [&](const std::string& scene, int steps) {
        desk.run("oiler play " + scene + " --quiet --json a.json --steps " + std::to_string(steps),
                 0);
        return desk.json("a.json").at("budget").at("position_error").at("measured").get<double>();
    };
    std::string text = desk.text("scene.toml");
    desk.put("short.toml", text.replace(text.find("10.0"), 4, "0.2"));
    const double whole = measured("short.toml", 1000);
    EXPECT_EQ(measured("short.toml", 20), whole);
    EXPECT_EQ(measured("scene.toml", 20), whole);
    EXPECT_LT(measured("scene.toml", 2), whole);
    EXPECT_GT(measured("scene.toml", 1000), whole);
    desk.run("oiler play scene.toml --quiet --json a.json --steps 0", 0);
    EXPECT_FALSE(desk.json("a.json").contains("budget"));
}

// The energies of the first 0.2 s are no scale for a drift.
TEST(PlayBudget, OfEnergyNeedsTheDuration) {
    const Desk desk(spring_scene("[budget]\nenergy_drift = 1e-3\n"));
    const std::string command = "oiler play scene.toml --json a.json --steps ";
    const Outcome run = desk.run(command + "20", 0);
    EXPECT_EQ(run.err, "[budget] energy_drift is compared over 10 s, not over 0.2 s\n");
    EXPECT_FALSE(desk.json("a.json").contains("budget"));
    for (const char* const steps : {"950", "1000"}) {
        desk.run(command + steps, 1);
        EXPECT_EQ(desk.json("a.json").at("budget").at("energy_drift").at("kept"), false);
    }
}

TEST(PlayBudget, AbsentIsNotReported) {
    const Desk desk;
    desk.run("oiler play scene.toml --quiet --steps 3 --json a.json", 0);
    EXPECT_FALSE(desk.json("a.json").contains("budget"));
}

}  // namespace
}  // namespace oiler::test
