// SPDX-License-Identifier: MIT
// Runs `oiler rates` and `oiler report` as users do.
#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

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
