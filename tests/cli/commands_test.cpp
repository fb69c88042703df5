// SPDX-License-Identifier: MIT
// The program `oiler` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "oiler/physics/methods/methods.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;

TEST(Oiler, ListsEveryMethodOnALine) {
    const Outcome run = shell("oiler methods");
    EXPECT_EQ(run.exit, 0);
    for (const Method& method : methods()) {
        EXPECT_TRUE(holds(run.out, "\n" + std::string(method.name) + " ")) << method.name;
        EXPECT_TRUE(holds(run.out, std::string(method.source) + "\n")) << method.name;
    }
    EXPECT_EQ(run.err, "");
}

TEST(Oiler, ListsMethodsForPrograms) {
    const Outcome run = shell("oiler methods --json -");
    const Json list = Json::parse(run.out);
    EXPECT_EQ(list.size(), methods().size());
    const auto rk4 = std::find_if(list.begin(), list.end(),
                                  [](const Json& method) { return method.at("name") == "rk4"; });
    ASSERT_NE(rk4, list.end());
    EXPECT_EQ(rk4->at("order"), 4);
    EXPECT_EQ(rk4->at("evaluations"), 4);
    EXPECT_EQ(rk4->at("symplectic"), false);
    EXPECT_NEAR(rk4->at("stability_limit").get<double>(), 2.828427124746, 1e-11);
}

TEST(Oiler, CertifiesThoseThatAreNamed) {
    const Outcome run = shell("oiler certify rk4 exact --steps 10000 --quiet");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(holds(run.out, "\nrk4 "));
    EXPECT_TRUE(holds(run.out, "\nexact "));
    EXPECT_FALSE(holds(run.out, "\nruth3 "));
    EXPECT_TRUE(holds(run.out, "  ok\n"));
    EXPECT_FALSE(holds(run.out, "FAILS"));
}

TEST(Oiler, CertifiesForPrograms) {
    const Outcome run =
        shell("oiler certify velocity_verlet --steps 10000 --json - --damping kick");
    EXPECT_EQ(run.exit, 0) << run.err;
    const Json certificate = Json::parse(run.out).at(0);
    EXPECT_EQ(certificate.at("method"), "velocity_verlet");
    EXPECT_EQ(certificate.at("damping"), "kick");
    EXPECT_EQ(certificate.at("orders").size(), 8U);
    EXPECT_EQ(certificate.at("failures"), Json::array());
    EXPECT_EQ(certificate.at("energy").at("steps"), 10000);
}

TEST(Oiler, DrawsTheFiguresOfTheArticle) {
    const Folder folder;
    const Outcome run =
        shell("oiler figures --quiet --size 320x180 --out '" + (folder / "f").string() + "'");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(names_in(folder / "f").size(), 10U);
}

TEST(Oiler, MeasuresStability) {
    const Folder folder;
    const Outcome run = shell("oiler stability velocity_verlet rk4 --quiet --size 640x360 --out '" +
                              (folder / "s").string() + "'");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(names_in(folder / "s").size(), 2U);
    EXPECT_EQ(lines(text_of(folder / "s" / "stability.csv")), 1 + 2 * 150 * 50);
}

const std::string scenes = OILER_SOURCE "/assets/scenes/";

TEST(Oiler, KeepsALedgerOfEveryScene) {
    for (const std::string& name : names_in(scenes)) {
        const Outcome run =
            shell("oiler ledger --quiet --steps 3 --json - '" + scenes + name + "'");
        EXPECT_EQ(run.exit, 0) << name << run.err;
        EXPECT_EQ(run.err, "") << name;
        const Json ledger = Json::parse(run.out);
        EXPECT_EQ(ledger.at("scene"), name.substr(0, name.size() - 5));
        EXPECT_EQ(ledger.at("steps"), 3) << name;
        EXPECT_GE(ledger.at("bytes_per_body").get<double>(), 12) << name;
        EXPECT_GE(ledger.at("ns_per_body_step").get<double>(), 0) << name;
        EXPECT_EQ(ledger.at("passes").back().at("name"), "moving") << name;
    }
}

// In float with two axes: 4 numbers of 4 bytes, and the handle; all bodies share mass and forces.
TEST(Oiler, KeepsALedgerForPrograms) {
    const Outcome run =
        shell("oiler ledger --steps 60 --json - '" + scenes + "hundred_thousand.toml'");
    const Json ledger = Json::parse(run.out);
    EXPECT_EQ(ledger.at("bytes_per_body"), 28);
    EXPECT_EQ(ledger.at("method"), "semi_implicit_euler");
    EXPECT_EQ(ledger.at("precision"), "float");
    EXPECT_EQ(ledger.at("bodies"), 100000);
    EXPECT_EQ(ledger.at("absent"),
              Json({"springs", "quadratic drag", "coil springs", "attractors", "links"}));
    const Json& gravity = ledger.at("passes").at(0);
    EXPECT_EQ(gravity.at("name"), "gravity");
    EXPECT_GE(gravity.at("ns_per_body_step").get<double>(), 0);
    EXPECT_TRUE(gravity.at("saves_percent").is_number());
    EXPECT_GT(gravity.at("changes_position_m").get<double>(), 4);
    EXPECT_EQ(gravity.at("diverges"), nullptr);
    EXPECT_EQ(ledger.at("passes").at(2).at("changes_position_m"), nullptr);
    EXPECT_EQ(ledger.at("flags"), Json::array());
}

TEST(Oiler, KeepsALedgerForPeople) {
    const Outcome run = shell("oiler ledger --steps 60 '" + scenes + "salvo.toml'");
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_LE(lines(run.out), 40);
    EXPECT_TRUE(
        run.out.starts_with("A salvo with and without drag\n  velocity_verlet at 60 Hz in "
                            "double, 2 axes, 12 bodies, 0 links, 60 steps\n"))
        << run.out;
    EXPECT_TRUE(holds(run.out,
                      "\nNot stored, not evaluated: springs, coil springs, attractors, "
                      "links\n"));
    EXPECT_TRUE(holds(run.out, "\n  total               60\n")) << run.out;
    EXPECT_TRUE(holds(run.out, "4 of 12 bodies have it"));
    EXPECT_TRUE(holds(run.out, "\n  quadratic_drag "));
}

TEST(Oiler, KeepsALedgerUpToADivergence) {
    const Folder folder;
    put(folder / "bad.toml",
        "[scene]\naxes = 1\n[[body]]\nname = \"a\"\nposition = [1.0]\n"
        "[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = 1e9\n");
    const Outcome run = shell("oiler ledger --json - '" + (folder / "bad.toml").string() + "'");
    EXPECT_EQ(run.exit, 5);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    const Json ledger = Json::parse(run.out);
    EXPECT_TRUE(ledger.at("diverges").is_string());
    EXPECT_EQ(ledger.at("ns_per_body_step"), nullptr);
    EXPECT_EQ(ledger.at("bytes_per_body"), 28);
}

TEST(Oiler, HelpFitsAScreenAndEachCommandHasAnExample) {
    const Outcome help = shell("oiler --help");
    EXPECT_LE(lines(help.out), 24);
    for (const std::string command :
         {"play", "methods", "certify", "stability", "figures", "ledger"}) {
        EXPECT_TRUE(holds(help.out, "  " + command + " ")) << command;
        EXPECT_TRUE(holds(shell("oiler " + command + " --help").out, "Example: oiler " + command));
    }
}

class WrongUse : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(WrongUse, IsRefusedInOneLineThatNamesIt) {
    const auto [words, named] = GetParam();
    const Outcome run = shell(std::string("oiler ") + words);
    EXPECT_EQ(run.exit, 2);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_TRUE(holds(run.err, named)) << run.err;
    EXPECT_EQ(run.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongUse,
    testing::Values(std::pair{"", "give a command"}, std::pair{"certfy", "certfy"},
                    std::pair{"certify rk5", "rk5"}, std::pair{"certify --steps 1e6", "--steps"},
                    std::pair{"certify --damping drag", "drag"},
                    std::pair{"figures --size 10", "--size 10"},
                    std::pair{"methods extra", "extra"}, std::pair{"--frames 3", "--frames"},
                    std::pair{"ledger", "SCENE"}, std::pair{"ledger no.toml --steps 1", "--steps"},
                    std::pair{"ledger '" OILER_SOURCE "/README.md'", "README.md"}));

TEST(Oiler, AFolderThatCannotBeMadeIsNamed) {
    const Outcome run = shell("oiler figures --out /proc/nowhere");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 4);
    EXPECT_TRUE(holds(run.err, "/proc/nowhere")) << run.err;
}

}  // namespace
}  // namespace oiler::test
