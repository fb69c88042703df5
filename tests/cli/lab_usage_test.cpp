// SPDX-License-Identifier: MIT
// Tests the help and the usage errors of the lab's commands.
#include <gtest/gtest.h>

#include "cli/desk.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

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
        const Outcome run = shell("oiler " + command + " --help");
        EXPECT_EQ(run.exit, 0);
        EXPECT_TRUE(holds(run.out, "Example: oiler " + command + " ")) << command;
        EXPECT_LE(lines(run.out), 25) << command;  // of a text screen
    }
}

}  // namespace
}  // namespace oiler::test
