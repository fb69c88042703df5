// SPDX-License-Identifier: MIT
// Lists and starts demos and scenes with `oiler demos`.
#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;

/// The first words of the indented lines, and the other words of them.
std::vector<std::pair<std::string, std::string>> listed(const std::string& output) {
    std::vector<std::pair<std::string, std::string>> all;
    std::istringstream stream(output);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with("  ")) continue;
        std::istringstream words(line);
        std::string name, sentence;
        words >> name >> std::ws;
        std::getline(words, sentence);
        all.emplace_back(name, sentence);
    }
    return all;
}

/// An installed Oiler with one demo, which prints its words, and one scene.
class Installed : public Desk {
public:
    Installed() {
        put("demo", "#!/bin/sh\necho \"demo|$*\"\nexit 7\n");
        const Outcome run = this->run(
            "mkdir -p bin libexec/oiler share/oiler/demos share/oiler/scenes && "
            "cp \"$(which oiler)\" bin && chmod +x demo && mv demo libexec/oiler/toy && "
            "printf 'toy: A toy\\nabsent: Not built\\n' >share/oiler/demos/demos.txt && "
            "mv scene.toml share/oiler/scenes/spring.toml");
        EXPECT_EQ(run.exit, 0) << run.err;
    }
};

TEST(Demos, ListsEveryDemoThatIsBuiltAndEveryScene) {
    const Outcome run = shell("oiler demos", 0);
    EXPECT_EQ(run.err, "");
    std::set<std::string> names;
    for (const auto& [name, sentence] : listed(run.out)) {
        EXPECT_GE(sentence.size(), 5U) << name;
        EXPECT_TRUE(names.insert(name).second) << name << " comes twice";
    }
    for (const auto& entry : fs::directory_iterator(OILER_SOURCE "/assets/scenes")) {
        const fs::path& file = entry.path();
        EXPECT_EQ(names.count(file.filename()), file.extension() == ".toml" ? 1U : 0U) << file;
    }
    EXPECT_EQ(names.count("hello"), 1U) << "cli_tests builds it";
    EXPECT_LE(lines(run.out), 40);
}

// CMake builds what demos.txt lists, so that it lists every file.
TEST(Demos, AllAreInTheList) {
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(OILER_SOURCE "/demos"))
        if (entry.path().extension() == ".cpp") files.insert(entry.path().stem());
    std::set<std::string> names;
    std::istringstream list(text_of(OILER_SOURCE "/demos/demos.txt"));
    for (std::string line; std::getline(list, line);) names.insert(line.substr(0, line.find(':')));
    EXPECT_EQ(names, files);
}

TEST(Demos, FindsThoseOfAnInstalledOiler) {
    const Installed desk;
    const Outcome run = desk.run("bin/oiler demos", 0);
    EXPECT_EQ(listed(run.out), (std::vector<std::pair<std::string, std::string>>{
                                   {"toy", "A toy"}, {"spring.toml", "A <spring> & \"damper\""}}))
        << run.out;
}

// Its exit code is that of `oiler demos`, and its options are not those of `oiler`.
TEST(Demos, StartsADemoWithItsOwnOptions) {
    const Installed desk;
    const Outcome run = desk.run("bin/oiler demos toy --help --rate 30 'two words' --window", 7);
    EXPECT_EQ(run.out, "demo|--help --rate 30 two words --window\n");
    EXPECT_EQ(desk.run("bin/oiler demos toy").out, "demo|\n");
}

TEST(Demos, StartsASceneByItsNameOrItsFile) {
    const Installed desk;
    for (const std::string name : {"spring", "spring.toml"}) {
        const Outcome run =
            desk.run("bin/oiler demos " + name + " --steps 7 --rate 50 --quiet --json -", 0);
        EXPECT_EQ(Json::parse(run.out).at("time"), 0.14);
        EXPECT_EQ(Json::parse(run.out).at("scene"), "spring");
    }
    EXPECT_EQ(shell("oiler demos hello").exit, 3) << "there is no display";
}

// A broken scene is listed with its error and does not hide the others.
TEST(Demos, ListsASceneThatIsBroken) {
    const Installed desk;
    desk.put("share/oiler/scenes/broken.toml", "[scene]\naxis = 1\n");
    const Outcome run = desk.run("bin/oiler demos", 0);
    const auto all = listed(run.out);
    ASSERT_EQ(all.size(), 3U) << run.out;
    EXPECT_EQ(all[1].first, "broken.toml");
    EXPECT_TRUE(holds(all[1].second, "broken.toml:2"));
}

TEST(Demos, RefusesWhatItCannotStart) {
    const Installed desk;
    for (const auto& [words, named] :
         {std::pair{"toys", "NAME toys: no such demo or scene; did you mean `toy`?"},
          std::pair{"absent", "NAME absent: no such demo or scene"},
          std::pair{"../toy", "NAME ../toy: no such demo or scene"},
          std::pair{"--windw", "--windw: no such option; did you mean `--window`?"},
          std::pair{"''", "no such demo or scene"}}) {
        const Outcome run = desk.run(std::string("bin/oiler demos ") + words, 2);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_TRUE(holds(run.err, named));
        EXPECT_EQ(run.out, "");
    }
    ASSERT_EQ(desk.run("chmod -x libexec/oiler/toy").exit, 0);
    const Outcome run = desk.run("bin/oiler demos toy", 4);
    EXPECT_TRUE(holds(run.err, "cannot start ") && holds(run.err, "Permission denied")) << run.err;
    EXPECT_EQ(desk.run("mkdir alone; cp bin/oiler alone; alone/oiler demos").exit, 0)
        << "alone/ is beside share/, as bin/ is";
    const Outcome lost = desk.run("mkdir -p a/b; cp bin/oiler a/b; a/b/oiler demos", 2);
    EXPECT_TRUE(holds(lost.err, "neither installed nor in its build folder"));
}

TEST(Demos, NeedsADisplayForItsWindow) {
    const Outcome run = shell("oiler demos --window", 3);
    EXPECT_EQ(lines(run.err), 1) << run.err;
}

}  // namespace
}  // namespace oiler::test
