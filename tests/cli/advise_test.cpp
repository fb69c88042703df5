// SPDX-License-Identifier: MIT
// Runs `oiler advise` as users do.
#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

const std::string article = "'" OILER_SOURCE "/assets/scenes/article_spring.toml'";

// Exact steps alone are right at the lowest rate, and float rounds 1000 m by more than 1e-6 m. They
// cost less than 1 % of a frame at the scene's own 100 Hz: the advice depends on no timing. Its
// chords deviate by up to 1000 m·(1 − cos(ω·dt/2)).
const std::string exact_steps = "--position-error 1e-6 --at-steps --methods exact --quiet ";

TEST(Advise, JsonHasTheKeysOfTheContract) {
    const Outcome run =
        shell("oiler advise " + article + " --duration 10 --json - " + exact_steps, 0);
    EXPECT_EQ(run.err, "");
    const Json json = Json::parse(run.out);
    const Json& advice = json.at("advice");
    EXPECT_EQ(advice.at("method"), "exact");
    EXPECT_EQ(advice.at("rate"), 100);
    EXPECT_EQ(advice.at("precision"), "double");
    EXPECT_EQ(advice.at("damping"), nullptr);
    for (const char* number : {"position_error", "step_error", "velocity_error", "energy_drift",
                               "evaluations", "ns_per_second", "ns_spread", "ns_worst_frame",
                               "ns_together", "us_per_frame", "us_worst_frame", "share_of_frame"})
        EXPECT_TRUE(advice.at(number).is_number() || advice.at(number).is_null()) << number;
    const double chord = 1000 * (1 - std::cos(std::sqrt(15.0) / 200));
    EXPECT_NEAR(advice.at("position_error").get<double>(), chord, 0.03 * chord);
    const Json& step_error = advice.at("step_error");
    EXPECT_TRUE(step_error.is_null() || step_error.get<double>() < 1e-9) << step_error;
    EXPECT_NEAR(advice.at("latency_ms").get<double>(), 10, 1e-9);
    EXPECT_LT(advice.at("share_of_frame").get<double>(), 0.01);
    EXPECT_EQ(json.at("cheapest").at("rate"), 30);
    EXPECT_EQ(json.at("ended_early"), false);
    EXPECT_NEAR(advice.at("us_per_frame").get<double>(),
                advice.at("ns_per_second").get<double>() / 60e3, 1e-9);
    EXPECT_NEAR(advice.at("share_of_frame").get<double>(),
                advice.at("ns_per_second").get<double>() / 1e9, 1e-12);
    EXPECT_EQ(json.at("meets"), true);
    EXPECT_EQ(json.at("obstacles"), Json::array());
    EXPECT_EQ(json.at("ties"), Json::array());
    EXPECT_EQ(json.at("perturbed_starts"), 3);
    EXPECT_EQ(json.at("growth").at("law"), "round-off");
    EXPECT_EQ(json.at("growth").at("holds_until"), nullptr);
    EXPECT_EQ(json.at("requirements").at("position_error"), 1e-6);
    EXPECT_EQ(json.at("requirements").at("at_steps"), true);
    EXPECT_EQ(json.at("requirements").at("display"), "any");
    EXPECT_EQ(json.at("requirements").at("energy_drift"), nullptr);
    EXPECT_EQ(json.at("current").at("method"), "semi_implicit_euler");
    EXPECT_EQ(json.at("current").at("rate"), 100);
    EXPECT_EQ(json.at("current").at("damping"), "kick");
    EXPECT_NEAR(json.at("current").at("position_error").get<double>(), 19.8, 0.05);
    EXPECT_NEAR(json.at("current").at("step_error").get<double>(), 19.8, 0.05);
    EXPECT_GT(json.at("runs").get<int>(), 0);
    EXPECT_TRUE(holds(json.at("words").at(0), "exact at 100 Hz in double"));
}

// A second of computing for a frame is always enough. The methods may cost the same.
TEST(Advise, UsesEveryOption) {
    const Desk desk;
    const Outcome run = desk.run(
        "oiler advise scene.toml --duration 5 --energy-drift 0.5 --budget-us 1000000 --min-rate "
        "130 --display 144 --methods velocity_verlet,rk2_heun --json - --quiet",
        0);
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json.at("requirements").at("position_error"), nullptr);
    EXPECT_EQ(json.at("requirements").at("at_steps"), false);
    EXPECT_EQ(json.at("requirements").at("display"), 144);
    EXPECT_EQ(json.at("requirements").at("energy_drift"), 0.5);
    EXPECT_EQ(json.at("requirements").at("us_per_frame"), 1'000'000);
    EXPECT_EQ(json.at("reference").at("meaningful_until"), 5);
    std::vector<Json> advised{json.at("advice")};
    for (const Json& tie : json.at("ties")) advised.push_back(tie);
    if (!json.at("runner_up").is_null()) advised.push_back(json.at("runner_up"));
    for (const Json& row : advised) {
        EXPECT_GE(row.at("rate").get<int>(), 130) << row;
        EXPECT_TRUE(row.at("method") == "velocity_verlet" || row.at("method") == "rk2_heun") << row;
    }
    EXPECT_EQ(json.at("current").at("rate"), 100);
}

// A rate below 30 Hz only if it is asked for, and only as the cheapest: its cost does not decide.
TEST(Advise, PrintsTheConclusionFirst) {
    for (const auto& [options, cheapest] :
         {std::pair{"", "Cheapest: exact at 30 Hz in double"},
          {"--min-rate 10 ", "Cheapest: exact at 10 Hz in double"}}) {
        const Outcome run =
            shell("oiler advise " + article + " --duration 10 " + options + exact_steps, 0);
        EXPECT_TRUE(run.out.starts_with("exact at 100 Hz in double")) << run.out;
        EXPECT_TRUE(holds(run.out, cheapest));
    }
}

// The setting must hold for 20 s, not for the scene's 10 s.
TEST(Advise, ForALongerTime) {
    const Desk desk;
    const Outcome run =
        desk.run("oiler advise scene.toml --for 20 --json a.json " + exact_steps, 0);
    EXPECT_TRUE(holds(run.out, " 20 s"));
    EXPECT_EQ(desk.json("a.json").at("reference").at("meaningful_until"), 20);
}

// At 60 Hz every frame of a display of 60 Hz is an exact step. Its chords miss 0.5 m in between,
// which a display of 120 Hz shows.
TEST(Advise, OnADisplayMissesTheTimeBetweenItsFrames) {
    const Desk desk;
    const auto rate = [&](const std::string& display) {
        const Outcome run = desk.run(
            "oiler advise scene.toml --position-error 1e-4 --min-rate 60 --methods exact --json - "
            "--quiet --display " +
                display,
            0);
        return Json::parse(run.out).at("advice").at("rate").get<int>();
    };
    EXPECT_EQ(rate("60"), 60);
    EXPECT_EQ(rate("120"), 120);
    EXPECT_GT(rate("any"), 1000);
}

// A camera of 2400 m has 4 m per pixel in a picture of 600 lines, and 10/3 m in one of 720.
TEST(Advise, TakesPixelsThroughTheCamera) {
    const Desk desk(spring_scene("[camera]\ncentre = [0.0]\nheight = 2400.0\n"));
    const auto tolerance = [&](const std::string& options) {
        const Outcome run = desk.run(
            "oiler advise scene.toml --methods exact --json - --quiet --pixels 0.5 " + options, 0);
        return Json::parse(run.out).at("requirements").at("position_error").get<double>();
    };
    EXPECT_DOUBLE_EQ(tolerance("--size 800x600"), 2);
    EXPECT_DOUBLE_EQ(tolerance(""), 5.0 / 3);
}

// With velocity Verlet alone, the advice is the lowest rate within the tolerance, in double: it
// depends on the error and on no timing. From the scene's new rate, the search ends within 1/32 of
// it.
TEST(Advise, ApplyChangesOnlyTheSetting) {
    std::string scene = spring_scene("");
    scene.replace(scene.find("100 "), 4, "60   ");
    scene.replace(scene.find("duration"), 0, "precision = \"float\"\n");
    const Desk desk(scene);
    const std::string words =
        "oiler advise scene.toml --position-error 1e-3 --methods velocity_verlet --quiet --json ";
    desk.run(words + "before.json", 0);
    EXPECT_EQ(desk.text("scene.toml"), scene);
    desk.run(words + "advice.json --apply", 0);
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
    desk.run(words + "again.json", 0);
    const Json again = desk.json("again.json");
    for (const char* part : {"method", "rate", "precision", "damping"})
        EXPECT_EQ(again.at("current").at(part), advice.at(part)) << part;
    EXPECT_EQ(again.at("advice").at("method"), advice.at("method"));
    EXPECT_LE(again.at("advice").at("rate").get<double>(), advice.at("rate").get<double>());
    EXPECT_GE(again.at("advice").at("rate").get<double>(),
              (1 - 1.0 / 30) * advice.at("rate").get<double>());
    EXPECT_EQ(again.at("current").at("position_error"), advice.at("position_error"));
}

// A thrown body with drag: with damping in the drifts, semi-implicit Euler is exact at the steps.
TEST(Advise, ApplyWritesTheTreatmentOfDamping) {
    const Desk desk(
        "[scene]\naxes = 1\nrate = 100\nduration = 4.0\n[[body]]\nname = \"mass\"\n"
        "velocity = [10.0]\nlinear_drag = 1.0\n");
    const Outcome run = desk.run(
        "oiler advise scene.toml --position-error 1e-4 --at-steps --methods semi_implicit_euler "
        "--apply --json advice.json --quiet",
        0);
    EXPECT_TRUE(holds(run.out, "damping in the drift"));
    const Json advice = desk.json("advice.json").at("advice");
    EXPECT_EQ(advice.at("damping"), "drift");
    EXPECT_EQ(advice.at("rate"), 100);
    EXPECT_TRUE(holds(desk.text("scene.toml"), "damping = \"drift\"")) << desk.text("scene.toml");
    desk.run("oiler play scene.toml --steps 120 --json a.json --trace t.csv --quiet", 0);
    EXPECT_EQ(desk.json("a.json").at("rate"), 100);
}

TEST(Advise, IsNotAppliedIfNothingMeetsTheTolerance) {
    const Desk desk;
    const Outcome run = desk.run(
        "oiler advise scene.toml --position-error 1e-9 --methods explicit_euler --apply --quiet "
        "--json advice.json",
        1);
    EXPECT_EQ(desk.text("scene.toml"), spring_scene(""));
    const Json json = desk.json("advice.json");
    EXPECT_EQ(json.at("meets"), false);
    EXPECT_FALSE(json.at("obstacles").empty());
    EXPECT_EQ(json.at("advice").at("method"), "explicit_euler");
    EXPECT_TRUE(run.out.starts_with("No setting meets 1e-09 m")) << run.out;
}

}  // namespace
}  // namespace oiler::test
