// SPDX-License-Identifier: MIT
// Runs the program `oiler` as users do. Help and usage errors of all commands.

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/desk.hpp"
#include "oiler/cli/ledger_text.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "oiler/scene/read.hpp"
#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> split(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

TEST(Oiler, ListsEveryMethodOnALine) {
    const Outcome run = shell("oiler methods", 0);
    for (const Method& method : methods()) {
        EXPECT_TRUE(holds(run.out, "\n" + std::string(method.name) + " ")) << method.name;
        EXPECT_TRUE(holds(run.out, std::string(method.source) + "\n")) << method.name;
    }
    EXPECT_EQ(run.err, "");
}

TEST(Oiler, ListsMethodsAsJson) {
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

TEST(Oiler, CountsSplittingsAsExplicitMethods) {
    const auto chosen = cli::parse_methods("explicit");
    EXPECT_EQ(cli::parse_methods("explicit,splitting,rk4"), chosen);
    EXPECT_EQ(std::ranges::count(chosen, &find_method("implicit_midpoint")), 0);
}

/// The cells of a method's line, computed from its JSON, without the source.
std::vector<std::string> line_of(const Json& method) {
    const auto cell = [&](const char* name, const char* without) {
        const Json& value = method.at(name);
        if (value.is_null()) return std::string(without);
        if (value.is_boolean()) return std::string(value ? "yes" : "no");
        return value.is_string() ? value.get<std::string>() : value.dump();
    };
    const Json& limit = method.at("stability_limit");
    return {cell("name", ""),
            cell("order", ""),
            cell("damped_order", ""),
            cell("dragged_order", "-"),
            cell("evaluations", "solves"),
            cell("symplectic", ""),
            cell("symmetric", ""),
            limit.is_string() ? "all"
            : limit == 0      ? "none"
                              : fmt::format("{:.10g}", limit.get<double>())};
}

TEST(Oiler, ListsTheSameInTableAndJson) {
    const std::string table = shell("oiler methods").out;
    std::vector<std::string> names = split(table.substr(0, table.find('\n')));
    EXPECT_EQ(names, split("method order damped dragged forces symplectic symmetric stable ω·dt "
                           "source"));
    for (const Json& method : Json::parse(shell("oiler methods --json -").out)) {
        const std::string name = method.at("name");
        const std::size_t at = table.find("\n" + name + " ");
        ASSERT_NE(at, std::string::npos) << name;
        std::vector<std::string> cells = split(table.substr(at + 1, table.find('\n', at + 1) - at));
        cells.resize(8);
        EXPECT_EQ(cells, line_of(method));
    }
}

TEST(Oiler, CertifiesTheNamedMethods) {
    const Outcome run = shell("oiler certify rk4 exact --steps 10000 --quiet", 0);
    EXPECT_TRUE(holds(run.out, "\nrk4 "));
    EXPECT_TRUE(holds(run.out, "\nexact "));
    EXPECT_FALSE(holds(run.out, "\nruth3 "));
    EXPECT_TRUE(holds(run.out, "  ok\n"));
    EXPECT_FALSE(holds(run.out, "FAILS"));
}

TEST(Oiler, CertifiesAsJson) {
    const Outcome run =
        shell("oiler certify velocity_verlet --steps 10000 --json - --damping kick", 0);
    const Json certificate = Json::parse(run.out).at(0);
    EXPECT_EQ(certificate.at("method"), "velocity_verlet");
    EXPECT_EQ(certificate.at("damping"), "kick");
    EXPECT_EQ(certificate.at("orders").size(), 8U);
    EXPECT_EQ(certificate.at("failures"), Json::array());
    EXPECT_EQ(certificate.at("energy").at("steps"), 10000);
}

// rk4 has four evaluations per step, is stable up to ω·dt = √8, and is run at 0.45. The table and
// the JSON have the same measurements.
TEST(Oiler, CertifiesTheSameInTableAndJson) {
    const std::string command = "oiler certify rk4 --steps 10000 --quiet";
    const Json json = Json::parse(shell(command + " --json -").out).at(0);
    const std::string table = shell(command).out;
    const std::vector<std::string> names = split(table.substr(0, table.find('\n')));
    EXPECT_EQ(names, split("method order spring orbit damped dragged forces alone MᵀJM−J reversal "
                           "stable ω·dt ω·dt lowest highest trend"));
    const std::vector<std::string> cells = split(table.substr(table.find("\nrk4 ")));
    ASSERT_GE(cells.size(), 16U) << table;
    const auto small = [](const Json& number) {
        return fmt::format("{:.1e}", number.get<double>());
    };
    const Json& energy = json.at("energy");
    const double lowest = energy.at("lowest").get<double>() - 1;
    const double highest = energy.at("highest").get<double>() - 1;
    EXPECT_LT(lowest, highest);
    EXPECT_EQ(
        std::vector(cells.begin() + 6, cells.begin() + 16),
        (std::vector<std::string>{"4.000", "4.000", small(json.at("symplectic_defect")),
                                  small(json.at("reversal_defect")), "2.828427125", "0.45",
                                  small(lowest), small(highest), small(energy.at("trend")), "ok"}));
    EXPECT_EQ(cells[1], "4");
    // The slopes of errors over dt, in long double.
    for (const Json& order : json.at("orders")) {
        if (order.at("problem") != "orbit" || order.at("precision") != "long double") continue;
        EXPECT_EQ(cells[3], fmt::format("{:.2f}/{:.2f}", order.at("position").get<double>(),
                                        order.at("velocity").get<double>()));
    }
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

TEST(Oiler, MeasuresStabilityWithTheGivenDamping) {
    for (const std::string damping : {"kick", "drift"}) {
        const Folder folder;
        const Outcome run = shell("oiler stability velocity_verlet --damping " + damping +
                                  " --quiet --size 64x36 --out '" + folder.path().string() + "'");
        if (run.exit == 3) GTEST_SKIP() << run.err;
        EXPECT_TRUE(
            holds(text_of(folder / "stability.csv"), "\nvelocity_verlet," + damping + ",0.02,"));
    }
}

const std::string scenes = OILER_SOURCE "/assets/scenes/";

TEST(Oiler, LedgerRunsEveryScene) {
    for (const std::string& name : names_in(scenes)) {
        if (!name.ends_with(".toml") || name == "million.toml") continue;  // as hundred_thousand
        const Outcome run =
            shell("oiler ledger --quiet --steps 3 --json - '" + scenes + name + "'", 0);
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
TEST(Oiler, LedgerWritesJson) {
    const Outcome run =
        shell("oiler ledger --steps 60 --json - '" + scenes + "hundred_thousand.toml'");
    const Json ledger = Json::parse(run.out);
    EXPECT_EQ(ledger.at("bytes_per_body"), 28);
    EXPECT_EQ(ledger.at("method"), "semi_implicit_euler");
    EXPECT_EQ(ledger.at("precision"), "float");
    EXPECT_EQ(ledger.at("bodies"), 100000);
    EXPECT_EQ(ledger.at("absent"), Json({"springs", "quadratic drag", "coil springs", "attractors",
                                         "wind", "drives", "links"}));
    const Json& gravity = ledger.at("passes").at(0);
    EXPECT_EQ(gravity.at("name"), "gravity");
    EXPECT_GE(gravity.at("ns_per_body_step").get<double>(), 0);
    EXPECT_TRUE(gravity.at("saves_percent").is_number());
    EXPECT_GT(gravity.at("changes_position_m").get<double>(), 4);
    EXPECT_EQ(gravity.at("diverges"), nullptr);
    EXPECT_EQ(ledger.at("passes").at(2).at("changes_position_m"), nullptr);
    EXPECT_EQ(ledger.at("flags"), Json::array());
}

TEST(Oiler, LedgerPrintsATable) {
    const Outcome run = shell("oiler ledger --steps 60 '" + scenes + "salvo.toml'", 0);
    EXPECT_LE(lines(run.out), 40);
    EXPECT_TRUE(
        run.out.starts_with("A salvo: no drag (blue), linear drag (green), quadratic drag "
                            "(orange)\n  velocity_verlet at 60 Hz in "
                            "double, 2 axes, 12 bodies, 0 links, 60 steps\n"))
        << run.out;
    EXPECT_TRUE(holds(run.out,
                      "\nNot stored, not evaluated: springs, coil springs, attractors, "
                      "wind, drives, links\n"));
    EXPECT_TRUE(holds(run.out, "\n  total               60\n"));
    EXPECT_TRUE(holds(run.out, "4 of 12 bodies have it"));
    EXPECT_FALSE(holds(run.out, "12 of 12"));
    EXPECT_TRUE(holds(run.out, "\n  quadratic_drag "));
}

TEST(Oiler, LedgerReportsADivergence) {
    const Folder folder;
    put(folder / "bad.toml",
        "[scene]\naxes = 1\n[[body]]\nname = \"a\"\nposition = [1.0]\n"
        "[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = 1e9\n");
    const Outcome run = shell("oiler ledger --json - '" + (folder / "bad.toml").string() + "'", 5);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    const Json ledger = Json::parse(run.out);
    EXPECT_TRUE(holds(ledger.at("diverges").get<std::string>(), " of body 'a' "));
    EXPECT_EQ(ledger.at("ns_per_body_step"), nullptr);
    EXPECT_EQ(ledger.at("bytes_per_body"), 28);
}

TEST(Oiler, HelpFitsAScreenAndEachCommandHasAnExample) {
    const Outcome help = shell("oiler --help");
    EXPECT_LE(lines(help.out), 24);
    for (const std::string command :
         {"play", "methods", "certify", "stability", "figures", "ledger", "demos", "new"}) {
        EXPECT_TRUE(holds(help.out, "  " + command + " ")) << command;
        EXPECT_TRUE(holds(shell("oiler " + command + " --help").out, "Example: oiler " + command));
    }
}

// `advise` and others have no results before their end.
TEST(Oiler, HelpOfTheTimeLimitPromisesNoResults) {
    for (const std::string command : {"advise", "report", "tradeoff", "check"}) {
        const std::string help = shell("oiler " + command + " --help").out;
        EXPECT_TRUE(holds(help, "--time-limit S")) << command;
        EXPECT_FALSE(holds(help, "so far")) << command;
    }
}

TEST(Oiler, AloneIsWrongUseWithoutADisplay) {
    for (const std::string display : {"env -u DISPLAY", "env DISPLAY=", "env DISPLAY=:no"}) {
        const Outcome run = shell(display + " WAYLAND_DISPLAY= oiler", 2);
        EXPECT_TRUE(holds(run.err, "command"));
    }
}

class WrongUse : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(WrongUse, IsRefusedInOneLineThatNamesIt) {
    const auto [words, named] = GetParam();
    const Desk desk;
    desk.put("tight.toml", spring_scene("[budget]\nenergy_drift = 1e-15\n"));
    desk.put("tighter.toml", spring_scene("[budget]\nposition_error = 1e-15\n"));
    const auto before = desk.names();
    const Outcome run = desk.run(std::string("oiler ") + words, 2);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_TRUE(holds(run.err, named));
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(desk.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongUse,
    testing::Values(
        std::pair{"", "`oiler demos` lists games and scenes to start"},
        std::pair{"certfy", "certfy: no such command; did you mean `certify`? (see oiler --help)"},
        std::pair{"certify rk5", "rk5"},
        std::pair{"certify --stps 3",
                  "--stps: no such option; did you mean `--steps`? (see oiler certify --help)"},
        std::pair{"certify --steps", "(see oiler certify --help)"},
        std::pair{"certify --steps 1e6", "--steps"}, std::pair{"certify --damping drag", "drag"},
        std::pair{"figures --size 10", "--size 10"},
        std::pair{"methods extra", "extra: unexpected argument (see oiler methods --help)"},
        std::pair{"play x.toml --methd rk4", "did you mean `--method`? (see oiler play --help)"},
        std::pair{"--frames 3", "--frames"}, std::pair{"ledger", "SCENE"},
        std::pair{"ledger no.toml --steps 1", "--steps"},
        std::pair{"ledger '" OILER_SOURCE "/README.md'", "README.md"},
        std::pair{"advise scene.toml", "--position-error"}, std::pair{"advise", "SCENE"},
        std::pair{"advise", "(see oiler advise --help)"},
        std::pair{"advise scene.toml --position-error 1cm",
                  "--position-error 1cm: give a number above 0, in m, such as 0.01"},
        std::pair{"advise scene.toml --energy-drift 1% ", "above 0, such as 0.01"},
        std::pair{"advise scene.toml --position-error 1 --for 9h", "0, in s, such"},
        std::pair{"advise scene.toml --position-error 1 --size 9x9", "--size has no"},
        std::pair{"advise scene.toml --energy-drift 1 --at-steps", "--at-steps has no"},
        std::pair{"advise scene.toml --energy-drift 1 --display 60", "--display has"},
        std::pair{"advise scene.toml --pixels 1 --at-steps --display 60",
                  "--display has no effect with --at-steps"},
        std::pair{"rates scene.toml --methods rk4,splittin", "splittin"},
        std::pair{"merge none.json", "none.json: cannot be read: No such file"},
        std::pair{"merge .", ".: it is a folder; give a file"},
        std::pair{"merge scene.toml/x", "Not a directory"},
        std::pair{"check none.toml", "none.toml: No such file"},
        std::pair{"rates .", ".: not a file"},
        std::pair{"advise scene.toml --position-error 1 --methods rk5", "rk5"},
        std::pair{"advise scene.toml --position-error 0", "--position-error"},
        std::pair{"advise scene.toml --position-error -1", "--position-error"},
        std::pair{"advise scene.toml --position-error nan", "--position-error"},
        std::pair{"advise scene.toml --position-error 1e-15 --quiet", "1e-15"},
        std::pair{"advise scene.toml --energy-drift 1e-15 --quiet", "1e-15"},
        std::pair{"advise scene.toml --budget-us inf", "--budget-us"},
        std::pair{"advise scene.toml --position-error 1 --duration 0", "--duration"},
        std::pair{"advise scene.toml --position-error 1 --min-rate 0", "--min-rate"},
        std::pair{"advise scene.toml --pixels 1 --position-error 1", "--pixels"},
        std::pair{"advise scene.toml --pixels 0", "--pixels"},
        std::pair{"advise scene.toml --pixels 1 --size 3", "--size"},
        std::pair{"advise scene.toml --for 5 --duration 5 --pixels 1", "--for"},
        std::pair{"advise scene.toml --for 0 --pixels 1", "--for"},
        std::pair{"advise scene.toml --pixels 1 --display 0", "--display"},
        std::pair{"advise scene.toml --pixels 1 --display 1001", "--display"},
        std::pair{"advise scene.toml --pixels 1 --display all", "--display"},
        std::pair{"tradeoff scene.toml --shard 5/4", "--shard 5/4"},
        std::pair{"tradeoff scene.toml --shard 0/4", "--shard 0/4"},
        std::pair{"tradeoff scene.toml --shard x", "--shard x"},
        std::pair{"tradeoff scene.toml --shard 1/4x", "--shard 1/4x"},
        std::pair{"tradeoff scene.toml --shard 1", "--shard 1"},
        std::pair{"tradeoff scene.toml --shard 1/2 --json a.json", "--json"},
        std::pair{"tradeoff scene.toml --max-rate 0", "--max-rate"},
        std::pair{"tradeoff scene.toml --size 3", "--size"},
        std::pair{"tradeoff scene.toml --methods rk5", "rk5"}, std::pair{"merge", "PART"},
        std::pair{"compare 'a\nb' c", "a b"}, std::pair{"merge scene.toml", "scene.toml"},
        std::pair{"rates scene.toml --rates 0", "--rates 0"},
        std::pair{"rates scene.toml --rates 60,x", "--rates 60,x"},
        std::pair{"rates scene.toml --rates 60,1e3", "--rates 60,1e3"},
        std::pair{"rates scene.toml --body nobody --quiet", "nobody"}, std::pair{"check", "SCENE"},
        std::pair{"check tight.toml", "energy_drift = 1e-15"},
        std::pair{"check tighter.toml", "tighter.toml"},
        std::pair{"check scene.toml --rate 3", "--rate"},
        std::pair{"report scene.toml --duration 0", "--duration"}));

TEST(Oiler, NamesAFolderThatCannotBeCreated) {
    const Outcome run = shell("oiler figures --out /proc/nowhere");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 4);
    EXPECT_TRUE(holds(run.err, "/proc/nowhere"));
}

using namespace lab;

TEST(Lab, CommandsHaveExamples) {
    for (const std::string command : {"tradeoff", "merge", "advise", "rates", "check", "report"}) {
        const Outcome run = shell("oiler " + command + " --help", 0);
        EXPECT_TRUE(holds(run.out, "Example: oiler " + command + " ")) << command;
        EXPECT_LE(lines(run.out), 25) << command;  // of a text screen
    }
}

// Shares of 25 ± 0.5 %, 0.4 ± 0.5 %, −30 ± 2 % and none.
std::string printed() {
    lab::Ledger ledger;
    ledger.bodies = 1;
    ledger.steps = ledger.samples = 40;
    ledger.timed_steps = 19;
    ledger.rounds = 300;
    ledger.ns = 20;
    ledger.spread_ns = 0.1;
    const auto add = [&](const char* name, double percent, double spread) {
        ledger.passes.push_back({.name = name,
                                 .ns = std::max(0.0, 20 * percent / 100),
                                 .saves_ns = 20 * percent / 100,
                                 .saves_percent = percent,
                                 .spread_percent = spread,
                                 .changes_position = 1.5});
    };
    add("spring", 25, 0.5);
    add("linear_drag", 0.4, 0.5);
    add("gravity", -30, 2);
    ledger.passes.push_back({.name = "attractor", .diverged = "diverged at step 7"});
    ledger.passes.push_back({.name = "moving", .ns = 12});
    const Scene scene = parse_scene("[scene]\naxes = 1\nrate = 100\n[[body]]\n", "test.toml");
    return cli::ledger_text(scene, "test", ledger, 40);
}

bool has_line(const std::string& text, const std::string& line) {
    return text.find("\n" + line + "\n") != std::string::npos;
}

TEST(LedgerText, HasASpreadInEachRow) {
    const std::string text = printed();
    EXPECT_TRUE(holds(text, "A step takes 20 ± 0.1 ns per body."));
    EXPECT_TRUE(has_line(text, "  spring                 5 ns,   25.0 ±  0.5 %  1.5 m")) << text;
    EXPECT_TRUE(has_line(text, "  linear_drag      within the spread, ±  0.5 %  1.5 m")) << text;
    EXPECT_TRUE(has_line(text, "  gravity               -6 ns,  -30.0 ±    2 %  1.5 m")) << text;
    EXPECT_TRUE(has_line(text, "  attractor                                  -  diverges")) << text;
    EXPECT_TRUE(holds(text, " 300 rounds of 19 steps"));
}

// A scene's title, its body and its file begin with a command of GitHub or Azure; the name of the
// file has the start of a terminal's command, too.
TEST(Output, OfNamesOfOthersIsNoCommand) {
    std::string scene = spring_scene("[budget]\nposition_error = 1e-9\n");
    scene.replace(scene.find("A <"), 0, "::error::a ##vso[b] ");
    for (std::size_t at = 0; (at = scene.find("mass", at)) != scene.npos; at += 20)
        scene.replace(at, 4, "::warning::");
    const Desk desk(scene);
    const std::string file = "'::error::d/\x1b[2J##vso[x].toml'";
    for (const std::string command :
         {"play FILE --steps 5 --json -", "rates FILE", "check FILE", "check FILE --junit -",
          "advise FILE --position-error 10", "advise FILE --position-error 10 --json -",
          "play none/FILE --steps 1", "play FILE --steps 1 --json FILE/x", "merge FILE",
          "compare FILE FILE", "play FILE --method FILE"}) {
        std::string line = command;
        for (std::size_t at = 0; (at = line.find("FILE", at)) != line.npos; at += file.size())
            line.replace(at, 4, file);
        const Outcome run =
            desk.run("mkdir '::error::d'; cp scene.toml " + file + "; oiler " + line);
        EXPECT_FALSE((run.out + run.err).empty()) << command;
        for (const std::string& text : {"\n" + run.out, "\n" + run.err})
            for (const char* bad : {"\x1b", "##", "\n::", "\n ::"})
                EXPECT_FALSE(holds(text, bad)) << command;
    }
}

}  // namespace
}  // namespace oiler::test
