// SPDX-License-Identifier: MIT
// Tests the help and the usage errors of the lab's commands.
#include "cli/desk.hpp"
#include "oiler/cli/ledger_text.hpp"
#include "oiler/scene/read.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;

class WrongUseOfTheLab : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(WrongUseOfTheLab, IsRefusedInOneLineThatNamesIt) {
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
    All, WrongUseOfTheLab,
    testing::Values(std::pair{"advise scene.toml", "--position-error"},
                    std::pair{"advise", "SCENE"}, std::pair{"advise", "(see oiler advise --help)"},
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
                    std::pair{"tradeoff scene.toml --methods rk5", "rk5"},
                    std::pair{"merge", "PART"}, std::pair{"compare 'a\nb' c", "a b"},
                    std::pair{"merge scene.toml", "scene.toml"},
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

}  // namespace
}  // namespace oiler::test
