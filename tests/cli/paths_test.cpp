// SPDX-License-Identifier: MIT
// Names the input of each command as each of its outputs. Commands and options are those of --help.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "cli/desk.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

/// The words of a text that the expression's group matches.
std::vector<std::string> words_in(const std::string& text, const std::string& expression) {
    const std::regex regex(expression);
    std::vector<std::string> words;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
        words.push_back((*it)[1]);
    return words;
}

struct CommandOfHelp {
    std::string name;
    std::string input;  ///< its argument, empty if it has none
    std::vector<std::string> outputs;
};

std::vector<CommandOfHelp> commands() {
    const std::string help = shell("oiler --help").out;
    std::vector<CommandOfHelp> all;
    for (const std::string& name :
         words_in(help.substr(help.find("\nSubcommands:")), "\n  ([a-z]+) ")) {
        const std::string text = shell("oiler " + name + " --help").out;
        CommandOfHelp command{name, "", words_in(text, "\n  (--[a-z-]+) (?:FILE|DIR)")};
        for (const std::string input : {"SCENE", "PART"})
            if (holds(text, "\n  " + input)) command.input = input;
        all.push_back(command);
    }
    return all;
}

TEST(OutputPaths, TheInputOfACommandIsNoneOfItsOutputs) {
    const Desk desk;
    const std::string scene = desk.text("scene.toml");
    ASSERT_EQ(desk.run("ln scene.toml hard; ln -s scene.toml soft").exit, 0);
    const auto names = desk.names();
    std::set<std::string> tried;
    for (const CommandOfHelp& command : commands()) {
        if (command.input.empty()) continue;
        for (const std::string& option : command.outputs)
            for (const std::string path :
                 {"scene.toml", "./scene.toml", "hard", "soft", "$PWD/hard"}) {
                const std::string line =
                    "oiler " + command.name + " scene.toml " + option + " " + path +
                    (command.name + option == "play--out" ? " --headless" : "");
                const Outcome run = desk.run(line);
                EXPECT_EQ(run.exit, 2) << line;
                EXPECT_EQ(lines(run.err), 1) << line << run.err;
                EXPECT_TRUE(holds(run.err, option + ": ") && holds(run.err, command.input))
                    << line << run.err;
                EXPECT_EQ(desk.text("scene.toml"), scene) << line;
                EXPECT_EQ(desk.names(), names) << line;
                tried.insert(command.name + option);
            }
    }
    EXPECT_EQ(tried,
              (std::set<std::string>{"advise--json", "check--json", "check--junit", "ledger--json",
                                     "merge--json", "merge--out", "play--energy", "play--json",
                                     "play--out", "play--trace", "rates--json", "report--json",
                                     "report--out", "tradeoff--json", "tradeoff--out"}));
}

TEST(OutputPaths, TwoOutputsOfACommandAreTwoFiles) {
    const Desk desk;
    for (const CommandOfHelp& command : commands()) {
        if (command.outputs.size() < 2) continue;
        for (const std::string path : {"same", "-"}) {
            const std::string& first = command.outputs.at(0);
            const std::string& second = command.outputs.at(1);
            const std::string line = "oiler " + command.name +
                                     (command.input.empty() ? " " : " scene.toml ") + first + " " +
                                     path + " " + second + " " + path +
                                     (command.name == "play" ? " --headless" : "");
            const Outcome run = desk.run(line);
            EXPECT_EQ(run.exit, 2) << line;
            EXPECT_TRUE(holds(run.err, first) && holds(run.err, second)) << line << run.err;
            EXPECT_EQ(run.out, "") << line;
        }
    }
    EXPECT_EQ(desk.names(), std::vector<std::string>{"scene.toml"});
    EXPECT_EQ(desk.run("oiler check scene.toml --json /dev/null --junit /dev/null").exit, 0);
}

TEST(OutputPaths, AreNotEmpty) {
    const Desk desk;
    for (const CommandOfHelp& command : commands())
        for (const std::string& option : command.outputs) {
            const std::string line = "oiler " + command.name +
                                     (command.input.empty() ? " " : " scene.toml ") + option +
                                     " ''";
            const Outcome run = desk.run(line);
            EXPECT_EQ(run.exit, 2) << line;
            EXPECT_TRUE(holds(run.err, option + ": ")) << line << run.err;
        }
}

}  // namespace
}  // namespace oiler::test
