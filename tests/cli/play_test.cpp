// SPDX-License-Identifier: MIT
// Runs `oiler play` as users do, and every scene in assets/scenes with several numbers of threads
// and instruction sets.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "scene/bad_files.hpp"
#include "scene/everything.hpp"
#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;
using Seconds = std::chrono::duration<double>;

const std::string scenes = OILER_SOURCE "/assets/scenes/";

Outcome play(const std::string& words) { return shell("oiler play " + words); }

Json report_of(const std::string& words) {
    const Outcome run = play(words + " --quiet --json -");
    EXPECT_EQ(run.exit, 0) << run.err;
    return Json::parse(run.out);
}

std::string scene(const std::string& name) { return "'" + scenes + name + ".toml'"; }

TEST(Play, EveryScene) {
    for (const std::string& name : names_in(scenes)) {
        if (!name.ends_with(".toml")) continue;
        const Json report = report_of("'" + scenes + name + "' --steps 3");
        EXPECT_EQ(report.at("scene"), name.substr(0, name.size() - 5));
        EXPECT_EQ(report.at("steps"), 3);
        EXPECT_GE(report.at("bodies"), 1);
    }
}

TEST(Play, OptionsOverrideTheScene) {
    const Json own = report_of(scene("chain") + " --steps 5");
    EXPECT_EQ(own.at("method"), "blanes_moan_srkn6b");
    EXPECT_EQ(own.at("rate"), 1000);
    EXPECT_EQ(own.at("precision"), "double");
    const Json given =
        report_of("--method rk4 --steps 5 --rate 250 " + scene("chain") + " --precision float");
    EXPECT_EQ(given.at("method"), "rk4");
    EXPECT_EQ(given.at("rate"), 250);
    EXPECT_EQ(given.at("precision"), "float");
    EXPECT_EQ(report_of(scene("million") + " --steps 0").at("precision"), "float");
}

TEST(Play, StepsTakesThatManySteps) {
    const Json report = report_of(scene("salvo") + " --steps 60 --threads 2");
    EXPECT_EQ(report.at("steps"), 60);
    EXPECT_EQ(report.at("state_hash"), report_of(scene("salvo") + " --steps 60").at("state_hash"));
}

TEST(Play, SeedChangesTheScatter) {
    const std::string words = scene("hundred_thousand") + " --steps 0 --seed ";
    EXPECT_NE(report_of(words + "1").at("state_hash"), report_of(words + "2").at("state_hash"));
    EXPECT_EQ(report_of(words + "0").at("state_hash"),
              report_of(scene("hundred_thousand") + " --steps 0").at("state_hash"));
}

TEST(Play, FilmLastsTheDurationOfTheScene) {
    const Folder folder;
    // Out of the way of linked bodies, which land with errors above the budget.
    const std::string aloft = altered(everything, "plane", "offset", "-40.0");
    put(folder / "short.toml", altered(aloft, "scene", "duration", "1.2"));
    const Outcome run = shell("cd '" + folder.path().string() +
                              "'; oiler play short.toml --headless --quiet --fps 10 --size 64x36");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(names_in(folder / "frames/short").size(), 12U + 2);
    const Json manifest = Json::parse(text_of(folder / "frames/short/manifest.json"));
    EXPECT_EQ(manifest.at("scene"), "short");
    EXPECT_EQ(manifest.at("frames").back().at("tick"), 110);
}

TEST(Play, FilmWithoutDurationNeedsFrames) {
    const Folder folder;
    put(folder / "long.toml", altered(everything, "scene", "duration", "1e9"));
    const Outcome run = play("'" + (folder / "long.toml").string() +
                             "' --headless --quiet --out '" + (folder / "o").string() + "'");
    if (run.exit == 3) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit, 2);
    EXPECT_TRUE(holds(run.err, "--frames"));
}

TEST(Play, RefusesAMethodOfTheCommandLineThatCannotStepTheScene) {
    const Outcome run = play(scene("orbit") + " --method exact --steps 1");
    EXPECT_EQ(run.exit, 2);
    EXPECT_TRUE(holds(run.err, "attractor has no exact flow"));
}

TEST(Play, EscapesNamesThatAreNotUtf8) {
    const Folder folder;
    put(folder / "\xff.toml", "[scene]\naxes = 1\n[[body]]\n");
    EXPECT_EQ(report_of("'" + (folder / "\xff.toml").string() + "' --steps 1").at("scene"),
              "\xef\xbf\xbd");
}

TEST(Play, HelpNeedsNoScene) {
    const Outcome help = play("--help");
    EXPECT_EQ(help.exit, 0);
    for (const char* part :
         {"Example: oiler play assets/scenes/", "SCENE", "--headless", "frames/SCENE"})
        EXPECT_TRUE(holds(help.out, part)) << part;
    // CLI11 writes a default in brackets from version 2.4 on.
    EXPECT_TRUE(holds(help.out, "--rate N=the scene's") ||
                holds(help.out, "--rate N [the scene's]"));
}

TEST(Play, UsageErrorsAreOneLineAndExit2) {
    for (const std::string& words :
         {std::string(), std::string("none.toml"), std::string("/"), std::string("/dev/zero"),
          scene("orbit") + " " + scene("salvo"), scene("orbit") + " --rate 0"}) {
        const Outcome run = play(words);
        EXPECT_EQ(run.exit, 2) << words;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

struct Cost {
    int exit = -1;
    Seconds wall{0};
    double mebibytes = 0;
};

/// Runs `oiler play PATH --steps 1` without a shell and with at most 10 s of processor time.
Cost cost_of(const std::string& path) {
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit{10, 10};
        setrlimit(RLIMIT_CPU, &limit);
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        execl(OILER_PROGRAMS "/oiler", "oiler", "play", path.c_str(), "--steps", "1", nullptr);
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, std::chrono::steady_clock::now() - start,
            static_cast<double>(usage.ru_maxrss) / 1024};
}

TEST(Play, RefusesInvalidScenesQuicklyInLittleMemory) {
    Cost largest;
    for (const BadFile& file : bad_files()) {
        const Cost cost = cost_of(file.path);
        EXPECT_EQ(cost.exit, 2) << file.path;
        largest.wall = std::max(largest.wall, cost.wall);
        largest.mebibytes = std::max(largest.mebibytes, cost.mebibytes);
    }
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(largest.mebibytes, 256);
#endif
    std::printf("at most %.3f s and %.0f MiB\n", largest.wall.count(), largest.mebibytes);
}

/// Empty if the machine lacks the instructions.
std::string hash_of(const std::filesystem::path& scene, const std::string& environment,
                    const std::string& options) {
    const Outcome run = shell(environment + " oiler play " + scene.string() +
                              " --steps 100 --quiet --json - " + options);
    if (run.exit == 2 && run.err.find("which this build and machine have") != std::string::npos)
        return {};
    EXPECT_EQ(run.exit, 0) << run.err;
    return nlohmann::json::parse(run.out).at("state_hash");
}

TEST(SameBits, InEveryScene) {
    int played = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        if (entry.path().extension() != ".toml") continue;
        const std::string alone = hash_of(entry, "OILER_INSTRUCTIONS=baseline", "");
        ASSERT_EQ(alone.size(), 16U) << entry.path();
        for (const char* set : {"avx2", "avx512"}) {
            const std::string hash =
                hash_of(entry, std::string("OILER_INSTRUCTIONS=") + set, "--threads 2");
            EXPECT_TRUE(hash.empty() || hash == alone) << entry.path() << " with " << set;
        }
        for (const char* threads : {"1", "2", "3", "8"})
            EXPECT_EQ(hash_of(entry, "", std::string("--threads ") + threads), alone)
                << entry.path() << ", " << threads << " threads";
        ++played;
    }
    EXPECT_GE(played, 10);
}

TEST(SameBits, RefusesAnUnknownInstructionSet) {
    const Outcome run =
        shell("OILER_INSTRUCTIONS=mmx oiler play " + scene("orbit") + " --steps 1", 2);
    EXPECT_TRUE(holds(run.err, "OILER_INSTRUCTIONS=mmx: expected one of baseline"));
}

}  // namespace
}  // namespace oiler::test
