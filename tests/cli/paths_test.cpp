// SPDX-License-Identifier: MIT
// Names the input of each command as each of its outputs. Commands and options are those of --help.
#include <regex>

#include "cli/desk.hpp"
#include "support/test.hpp"

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
    const std::size_t list = std::min(help.find("\nSubcommands:"), help.find("\nSUBCOMMANDS:"));
    std::vector<CommandOfHelp> all;
    for (const std::string& name : words_in(help.substr(list), "\n  ([a-z]+) ")) {
        const std::string text = shell("oiler " + name + " --help").out;
        CommandOfHelp command{name, "", words_in(text, "\n  (--[a-z-]+) (?:FILE|DIR)")};
        for (const std::string input : {"SCENE", "PART", "GOLDEN"})
            if (holds(text, "\n  " + input)) command.input = input;
        for (const char* const input : {"--golden", "--from"}) std::erase(command.outputs, input);
        all.push_back(command);
    }
    return all;
}

/// The command with its input and what else its outputs need.
std::string line_of(const CommandOfHelp& command) {
    std::string line = "oiler " + command.name;
    if (!command.input.empty()) line += " scene.toml";
    if (command.input == "GOLDEN") line += " scene.toml";
    if (command.name == "diverge") line += " scene.toml scene.toml";
    if (command.name == "play") line += " --headless --golden none";
    return line + " ";
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
                const std::string line = line_of(command) + option + " " + path;
                const Outcome run = desk.run(line, 2);
                EXPECT_EQ(lines(run.err), 1) << line << run.err;
                EXPECT_TRUE(holds(run.err, option + ": ") && holds(run.err, command.input))
                    << line << run.err;
                EXPECT_EQ(desk.text("scene.toml"), scene) << line;
                EXPECT_EQ(desk.names(), names) << line;
                tried.insert(command.name + option);
            }
    }
    EXPECT_EQ(tried, (std::set<std::string>{
                         "advise--json",   "check--json",   "check--junit", "compare--json",
                         "compare--junit", "compare--out",  "ledger--json", "merge--json",
                         "merge--out",     "play--energy",  "play--json",   "play--junit",
                         "play--out",      "play--profile", "play--sheet",  "play--trace",
                         "play--video",    "rates--json",   "report--json", "report--out",
                         "tradeoff--json", "tradeoff--out"}));
}

TEST(OutputPaths, TwoOutputsOfACommandAreTwoFiles) {
    const Desk desk;
    for (const CommandOfHelp& command : commands()) {
        if (command.outputs.size() < 2) continue;
        for (const std::string path : {"same", "-"}) {
            const std::string& first = command.outputs.at(0);
            const std::string& second = command.outputs.at(1);
            const std::string line =
                line_of(command) + first + " " + path + " " + second + " " + path;
            const Outcome run = desk.run(line, 2);
            EXPECT_TRUE(holds(run.err, first) && holds(run.err, second)) << line << run.err;
            EXPECT_EQ(run.out, "") << line;
        }
    }
    EXPECT_EQ(desk.names(), std::vector<std::string>{"scene.toml"});
    desk.run("oiler check scene.toml --json /dev/null --junit /dev/null", 0);
}

// Fails before the work, which prints a table.
TEST(OutputPaths, ThatCannotBeWrittenAreNamedBeforeTheWork) {
    const Desk desk;
    ASSERT_EQ(desk.run("mkdir folder").exit, 0);
    for (const char* const path : {"/proc/none", "folder"})
        for (const std::string command :
             {"check scene.toml", "rates scene.toml", "certify exact --steps 1000"}) {
            const Outcome run = desk.run("oiler " + command + " --json " + path, 4);
            EXPECT_EQ(lines(run.err), 1) << run.err;
            EXPECT_TRUE(holds(run.err, path));
            EXPECT_EQ(run.out, "") << command;
        }
    desk.run("oiler rates scene.toml --rates 0 --json new/a.json", 2);
    EXPECT_EQ(desk.names(), (std::vector<std::string>{"folder", "scene.toml"}));
    desk.run("oiler methods --json new/a.json", 0);
    EXPECT_EQ(desk.names("new"), std::vector<std::string>{"a.json"});
}

TEST(OutputPaths, AreNotEmpty) {
    const Desk desk;
    for (const CommandOfHelp& command : commands())
        for (const std::string& option : command.outputs) {
            const std::string line = line_of(command) + option + " ''";
            const Outcome run = desk.run(line, 2);
            EXPECT_TRUE(holds(run.err, option + ": ")) << line << run.err;
        }
}

// A link of that name must not lead the output to another file. Captures refuse links.
TEST(OutputPaths, NamesInAnOutputFolderReplaceLinks) {
    const Desk desk;
    for (const std::string command :
         {"figures", "stability exact", "tradeoff scene.toml --methods exact --max-rate 60"}) {
        const std::string line = "oiler " + command + " --quiet --size 64x36 --out ";
        const Outcome first = desk.run(line + "o");
        if (first.exit == 3) GTEST_SKIP() << first.err;
        ASSERT_EQ(first.exit, 0) << command << first.err;
        const auto names = desk.names("o");
        ASSERT_EQ(
            desk.run("mkdir l; for n in $(ls o); do cp o/$n old-$n; ln -s ../old-$n l/$n; done; "
                     "md5sum old-* >sums; rm -f l/tradeoff.json")
                .exit,
            0);
        desk.run(line + "l", 0);
        EXPECT_EQ(desk.names("l"), names);
        EXPECT_EQ(desk.run("md5sum --quiet -c sums && test -z \"$(find l -type l)\"").exit, 0)
            << command;
        ASSERT_EQ(desk.run("rm -r o l old-* sums").exit, 0);
    }
}

TEST(OutputPaths, AFileOfTheGoldenIsNoOutput) {
    const Desk desk;
    ASSERT_EQ(desk.run("mkdir golden actual; echo '{}' >golden/manifest.json").exit, 0);
    const std::string play =
        "oiler play scene.toml --headless --frames 1 --golden golden --out out ";
    for (const std::string& line :
         {play + "--junit golden/manifest.json", play + "--json golden/manifest.json",
          play + "--trace ./golden/frame_000000.png", play + "--sheet golden/frame_000005.png",
          std::string("oiler compare golden actual --json golden/manifest.json"),
          std::string("oiler compare actual golden --junit golden/frames.jsonl.gz"),
          std::string("oiler diverge golden actual --json golden/manifest.json")}) {
        const Outcome run = desk.run(line, 2);
        EXPECT_TRUE(holds(run.err, "would overwrite")) << line << run.err;
    }
    EXPECT_EQ(desk.text("golden/manifest.json"), "{}\n");
    EXPECT_EQ(desk.names("golden"), std::vector<std::string>{"manifest.json"});
}

TEST(OutputPaths, AReadOnlySceneIsNotReplacedByAdvice) {
    const Desk desk;
    const std::string scene = desk.text("scene.toml");
    ASSERT_EQ(desk.run("chmod a-w scene.toml").exit, 0);
    const Outcome run =
        desk.run("oiler advise scene.toml --position-error 1 --methods exact --quiet --apply", 4);
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(holds(run.err, "scene.toml: it is read-only; allow it with `chmod u+w`"));
    EXPECT_EQ(desk.text("scene.toml"), scene);
}

TEST(OutputPaths, DataForAClosedStandardOutputAreAnError) {
    const Desk desk;
    for (const std::string command :
         {"methods", "--help", "check scene.toml", "play scene.toml --steps 2 --json -"}) {
        const Outcome run = desk.run("oiler " + command + " >&-", 4);
        EXPECT_TRUE(holds(run.err, "cannot write the standard output"));
    }
    desk.run("oiler play scene.toml --steps 2 --trace t.csv >&-", 0);
    EXPECT_EQ(desk.names(), (std::vector<std::string>{"scene.toml", "t.csv"}));
}

}  // namespace
}  // namespace oiler::test
