// SPDX-License-Identifier: MIT
// Makes projects with `oiler new`, of which tests/install builds one. Lists and starts demos and
// scenes with `oiler demos`.

#include "app/played.hpp"
#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// The files below a folder, relative to it.
Names files_in(const fs::path& folder) {
    Names files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory()) files.insert(entry.path().lexically_relative(folder).string());
    return files;
}

/// The indented lines of the output: the commands that run and test the game.
std::vector<std::string> commands_in(const std::string& output) {
    std::vector<std::string> commands;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("    ")) commands.push_back(line.substr(4));
    return commands;
}

/// An empty folder in which commands are run.
class EmptyDesk : public Desk {
public:
    EmptyDesk() { fs::remove(folder() / "scene.toml"); }
};

TEST(New, WritesAProjectOfThatName) {
    const EmptyDesk desk;
    const Outcome run = desk.run("oiler new 'my games/cannon-2'", 0);
    EXPECT_EQ(run.err, "");
    const Names files = files_in(desk.folder());
    EXPECT_EQ(files, (Names{"my games/cannon-2/.github/workflows/frames.yml",
                            "my games/cannon-2/.gitignore", "my games/cannon-2/.gitlab-ci.yml",
                            "my games/cannon-2/CMakeLists.txt", "my games/cannon-2/game.cpp",
                            "my games/cannon-2/local.cmake", "my games/cannon-2/tests/frames.sh",
                            "my games/cannon-2/tests/play.txt"}));
    for (const auto& [file, text] :
         {std::pair{"CMakeLists.txt", "\nproject(cannon-2 CXX)\n"},
          std::pair{"game.cpp", ".name = \"cannon-2\""},
          std::pair{"tests/frames.sh", "golden=tests/golden/cannon-2\n"},
          std::pair{"tests/frames.sh", "--out frames/cannon-2 --junit frames/cannon-2.xml"},
          std::pair{".gitignore", "\n/local.cmake\n"},
          std::pair{".github/workflows/frames.yml", "\n            frames/cannon-2-differences\n"},
          std::pair{".gitlab-ci.yml", "\n      junit: frames/cannon-2.xml\n"}})
        EXPECT_TRUE(holds(desk.text("my games/cannon-2/" + std::string(file)), text)) << file;
}

TEST(New, KeepsNoNameAndNoLicenceOfTheTemplate) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("oiler new cannon").exit, 0);
    for (const std::string& file : files_in(desk.folder())) {
        const std::string text = desk.text(file);
        for (const char* const part : {"\"game\"", "/game", "project(game", "SPDX"})
            EXPECT_FALSE(holds(text, part)) << file << ": " << part;
        EXPECT_TRUE(text.ends_with("\n")) << file;
    }
    EXPECT_LE(lines(desk.text("cannon/game.cpp")), 60);
}

TEST(New, UsesTheSourceOfAProgramInItsBuildFolder) {
    const EmptyDesk desk;
    const Outcome run = desk.run("oiler new cannon");
    EXPECT_TRUE(holds(desk.text("cannon/local.cmake"),
                      "\nset(OILER_SOURCE [==[" OILER_SOURCE "]==] CACHE PATH\n"));
    EXPECT_TRUE(holds(run.out, "It compiles the Oiler in " OILER_SOURCE ":"));
}

TEST(New, UsesTheInstalledOilerOfTheProgramAlsoIfThatWasMoved) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("mkdir -p first/bin first/include/oiler; cp $(which oiler) first/bin; "
                       "touch first/include/oiler/oiler.hpp; mv first 'moved here'")
                  .exit,
              0);
    const Outcome run = desk.run("'moved here/bin/oiler' new cannon");
    ASSERT_EQ(run.exit, 0) << run.err;
    const std::string prefix = (desk.folder() / "moved here").string();
    EXPECT_TRUE(holds(desk.text("cannon/local.cmake"),
                      "\nlist(APPEND CMAKE_PREFIX_PATH [==[" + prefix + "]==])\n"));
    EXPECT_TRUE(holds(run.out, "installed in " + prefix + ".\n"));
}

TEST(New, SaysHowToNameAnOilerThatItDoesNotKnow) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("mkdir bin; cp $(which oiler) bin").exit, 0);
    const Outcome run = desk.run("bin/oiler new cannon");
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_FALSE(fs::exists(desk.folder() / "cannon/local.cmake"));
    EXPECT_TRUE(holds(run.out, "-DCMAKE_PREFIX_PATH=DIR"));
}

// Programs in the places of CMake, CTest and the game print their folder and their words.
TEST(New, PrintsTwoCommandsForAShell) {
    const EmptyDesk desk;
    desk.put("cmake", "#!/bin/sh\necho \"$(basename \"$0\")|$(basename \"$PWD\")|$*\"\n");
    desk.put("setup",
             "export PATH=\"$PWD:$PATH\" F=\"it's \\\"here\\\" for \\$HOME; \\\\ *\"\n"
             "nproc() { echo 3; }\n");
    ASSERT_EQ(desk.run("chmod +x cmake; cp cmake ctest").exit, 0);
    const Outcome made = desk.run(". ./setup; oiler new \"$F/cannon\"");
    ASSERT_EQ(made.exit, 0) << made.err;
    const std::vector<std::string> commands = commands_in(made.out);
    ASSERT_EQ(commands.size(), 2U) << made.out;
    desk.put("both", commands[0] + "\n" + commands[1] + "\n");
    const Outcome run = desk.run(
        ". ./setup; mkdir -p \"$F/cannon/build/bin\"; cp cmake \"$F/cannon/build/bin/cannon\"; "
        ". ./both");
    EXPECT_EQ(run.out,
              "cmake|cannon|-B build\ncmake|cannon|--build build -j 3\ncannon|cannon|--headless\n"
              "ctest|cannon|--test-dir build --output-on-failure\n")
        << commands[0] << run.err;
}

// project_game is the game of the template.
TEST(New, TheTestWritesGoldenFramesAndThenComparesThem) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("oiler new game").exit, 0);
    const auto test = [&](const std::string& before) {
        return desk.run("unset CI JENKINS_URL; cd game; " + before +
                        "; sh tests/frames.sh $(which project_game)");
    };
    const Outcome in_ci = test("export CI=true");
    EXPECT_EQ(in_ci.exit, 2);
    EXPECT_TRUE(holds(in_ci.out, "no frames in tests/golden/game"));
    const Outcome first = test("true");
    if (first.exit == 3) GTEST_SKIP() << first.err;
    EXPECT_EQ(first.exit, 0) << first.err;
    EXPECT_EQ(desk.names("game/tests/golden/game").size(), 20U + 2);
    const std::string golden = desk.text("game/tests/golden/game/manifest.json");
    EXPECT_EQ(test("export CI=true").exit, 0);
    const Outcome changed = test("echo '100 press Space' >tests/play.txt");
    EXPECT_EQ(changed.exit, 1);
    EXPECT_TRUE(holds(changed.err, "simulation changed at tick 31;"));
    EXPECT_TRUE(fs::exists(desk.folder() / "game/frames/game-differences/index.html"));
    EXPECT_TRUE(holds(desk.text("game/frames/game.xml"), "<failure"));
    EXPECT_EQ(desk.text("game/tests/golden/game/manifest.json"), golden);
}

// The step is 0.4 m high and reaches from x = -0.4 to 1.6 m, the ball has a radius of 0.4 m.
TEST(New, TheTestPlaysABounceOffTheStepAndAHit) {
    const auto rows = trace_of("project_game --quiet --steps 240 --script '" OILER_SOURCE
                               "/assets/project/tests/play.txt'");
    double lowest = INFINITY;
    bool hits = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool is_ball = rows[i].body == 0;
        if (is_ball && std::abs(rows[i].x - 0.6) < 1) lowest = std::min(lowest, rows[i].y);
        if (!is_ball && i >= 2 && std::abs(rows[i].x - rows[i - 2].x) > 1) hits = true;
    }
    EXPECT_GE(lowest, 0.4 + 0.4 - 1e-9);
    EXPECT_LT(lowest, 0.8 + 5.2 / 120) << "it falls by 0.9 m, to 5.2 m/s";
    EXPECT_TRUE(hits) << "a new lantern hangs elsewhere";
}

TEST(New, OpensAWindowIfThereIsADisplay) {
    const EmptyDesk desk;
    for (const std::string display : {"DISPLAY=:0", "WAYLAND_DISPLAY=wayland-0", "DISPLAY="}) {
        const Outcome run = desk.run("rm -rf cannon; " + display + " oiler new cannon");
        EXPECT_EQ(holds(run.out, "bin/cannon --headless\n"), display == "DISPLAY=") << run.out;
    }
}

TEST(New, FillsAnEmptyFolder) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("mkdir cannon; cd cannon && oiler new . && test -f game.cpp").exit, 0);
    EXPECT_TRUE(holds(desk.text("cannon/CMakeLists.txt"), "project(cannon CXX)"));
}

TEST(New, RefusesNamesThatAreNotUsable) {
    const EmptyDesk desk;
    for (const std::string name :
         {"''", "/", "2d", "_x", "a.b", "'a b'", "games/a+b", "'ü'", "'a;b'", "'a\"b'", "'a$b'"}) {
        const Outcome run = desk.run("oiler new " + name, 2);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_TRUE(holds(run.err, "letters a to z and A to Z, digits, _ and -"));
        EXPECT_EQ(run.out, "");
    }
    EXPECT_EQ(desk.names(), std::vector<std::string>{});
}

TEST(New, RefusesPlacesThatAreTaken) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("mkdir full; touch full/.keep file").exit, 0);
    for (const auto& [name, words] :
         {std::pair{"full", "NAME full: the folder is not empty"},
          std::pair{"full/", "NAME full/: the folder is not empty"},
          std::pair{"file", "NAME file: there is a file of that name"}}) {
        const Outcome run = desk.run("oiler new " + std::string(name), 2);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_TRUE(holds(run.err, words));
    }
    EXPECT_EQ(files_in(desk.folder()), (Names{"file", "full/.keep"}));
}

TEST(New, LeavesNothingIfItCannotWrite) {
    const EmptyDesk desk;
    ASSERT_EQ(desk.run("mkdir empty; touch file").exit, 0);
    for (const std::string line :
         {"oiler new /proc/cannon", "oiler new file/cannon", "oiler new games/cannon >&-",
          "ulimit -f 2; oiler new games/of/mine/cannon", "ulimit -f 2; oiler new empty"}) {
        const Outcome run = desk.run(line, 4);
        EXPECT_EQ(lines(run.err), 1) << line << run.err;
        EXPECT_EQ(run.out, "") << line;
        EXPECT_EQ(desk.names(), (std::vector<std::string>{"empty", "file"})) << line;
        EXPECT_EQ(desk.names("empty"), std::vector<std::string>{}) << line;
    }
}

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
    EXPECT_EQ(desk.run("mv share/oiler/scenes/spring.toml share/oiler/scenes/toy.toml; "
                       "bin/oiler demos toy")
                  .out,
              "demo|\n")
        << "a scene of its name is toy.toml";
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
