// SPDX-License-Identifier: MIT
// `oiler rates` and `oiler report` as their users run them.
#include <gtest/gtest.h>

#include "cli/desk.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

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
    EXPECT_TRUE(holds(page, "A &lt;spring> &amp; &quot;damper&quot;")) << page.substr(0, 1000);
    EXPECT_FALSE(holds(page, "<spring>"));
    for (const char* left : {"@DATA@", "@TITLE@", "@FRAME@", "@CHART_LIBRARY@"})
        EXPECT_FALSE(holds(page, left)) << left;
    const Json data = desk.json("a.json");
    for (const char* part :
         {"advice", "tradeoff", "stability", "rates", "ledger", "obvious_methods"})
        EXPECT_TRUE(data.contains(part)) << part;
    EXPECT_TRUE(data["tradeoff"].contains("today"));
}

TEST(Report, OfABadSceneLeavesNothing) {
    const Desk desk("[scene]\naxes = 7\n");
    const Outcome run = desk.run("oiler report scene.toml --out page.html --json a.json");
    EXPECT_EQ(run.exit, 2);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_EQ(desk.names(), std::vector<std::string>{"scene.toml"});
}

}  // namespace
}  // namespace oiler::test
