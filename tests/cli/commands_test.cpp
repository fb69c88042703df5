// SPDX-License-Identifier: MIT
// The program `oiler` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "oiler/sim/methods.hpp"
#include "support/program.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

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

TEST(Oiler, HelpFitsAScreenAndEachCommandHasAnExample) {
    const Outcome help = shell("oiler --help");
    EXPECT_LE(lines(help.out), 24);
    for (const std::string command : {"play", "methods", "certify", "stability", "figures"}) {
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
                    std::pair{"methods extra", "extra"}, std::pair{"--frames 3", "--frames"}));

TEST(Oiler, AFolderThatCannotBeMadeIsNamed) {
    const Outcome run = shell("oiler figures --out /proc/nowhere");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 4);
    EXPECT_TRUE(holds(run.err, "/proc/nowhere")) << run.err;
}

}  // namespace
}  // namespace oiler::test
