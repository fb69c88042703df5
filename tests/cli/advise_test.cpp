// SPDX-License-Identifier: MIT
// Runs `oiler advise` as users do.
#include <gtest/gtest.h>

#include "cli/desk.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

const std::string article = "'" OILER_SOURCE "/assets/scenes/article_spring.toml'";

TEST(Advise, JsonHasTheKeysOfTheContract) {
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

// A second of computing for a frame is always enough.
TEST(Advise, UsesEveryOption) {
    const Desk desk;
    const Outcome run = desk.run(
        "oiler advise scene.toml --duration 5 --energy-drift 0.5 --budget-us 1000000 --min-rate "
        "130 --methods velocity_verlet,rk2_heun --json - --quiet");
    EXPECT_EQ(run.exit, 0) << run.err;
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("wish").at("position_error"), nullptr);
    EXPECT_EQ(json.at("wish").at("energy_drift"), 0.5);
    EXPECT_EQ(json.at("wish").at("us_per_frame"), 1'000'000);
    EXPECT_EQ(json.at("reference").at("meaningful_until"), 5);
    for (const char* role : {"advice", "runner_up"}) {
        EXPECT_GE(json.at(role).at("rate").get<int>(), 130) << role;
        EXPECT_TRUE(json.at(role).at("method") == "velocity_verlet" ||
                    json.at(role).at("method") == "rk2_heun")
            << role;
    }
    EXPECT_EQ(json.at("today").at("rate"), 100);
}

TEST(Advise, PrintsTheConclusionFirst) {
    const Outcome run =
        shell("oiler advise " + article + " --duration 10 --position-error 1e-3 --quiet");
    EXPECT_EQ(run.exit, 0);
    EXPECT_TRUE(run.out.starts_with("exact at 50 Hz in double")) << run.out;
}

// With velocity Verlet alone, the advice is the lowest rate within the tolerance, in double: it
// depends on the error and on no timing. The rate is a multiple of 60 Hz, so that both commands
// sample 60 times per second.
TEST(Advise, ApplyChangesOnlyTheSetting) {
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
    // The remarks shift with the widths of the cells before them.
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

TEST(Advise, IsNotAppliedIfNothingMeetsTheTolerance) {
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
    EXPECT_TRUE(run.out.starts_with("No setting meets 1e-09 m")) << run.out;
}

}  // namespace
}  // namespace oiler::test
