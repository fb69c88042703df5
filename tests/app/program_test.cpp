// SPDX-License-Identifier: MIT
// Runs the demos as users do: from a shell, without a display.
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;

const std::string small = " --headless --quiet --size 160x90 ";

std::string quoted(const std::filesystem::path& path) { return fmt::format("'{}'", path.string()); }

bool is_one_line(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

TEST(Program, CapturesTheSameFolderTwice) {
    for (const std::string demo : {"hello", "jump", "spring_damper", "projectile"}) {
        const Folder folder;
        for (const char* name : {"a", "b"})
            shell(demo + small + "--frames 12 --out " + quoted(folder / name), 0);
        EXPECT_EQ(names_in(folder / "a").size(), 14U);
        shell("diff -r " + quoted(folder / "a") + " " + quoted(folder / "b"), 0);
    }
}

TEST(Program, OsmesaAndEglDrawTheSamePixels) {
    const Folder folder;
    std::vector<Json> frames;
    for (const std::string surface : {"osmesa", "egl"}) {
        const Outcome run = shell("projectile" + small + "--fps 2 --frames 5 --surface " + surface +
                                  " --out " + quoted(folder / surface));
        if (run.exit == 3) GTEST_SKIP() << run.err;
        frames.push_back(Json::parse(text_of(folder / surface / "manifest.json"))["frames"]);
    }
    EXPECT_EQ(frames[0].size(), 5U);
    EXPECT_EQ(frames[0], frames[1]);
}

// ω = √15 rad/s. At 1 Hz ω·dt is 3.87, above the limit of 2. At 100 Hz the dt of explicit Euler is
// above its limit of b/k = 1/150 s.
TEST(Program, WarnsOfASpringThatTheMethodCannotFollow) {
    const Outcome coarse = shell("spring_damper --steps 1 --rate 1", 0);
    EXPECT_TRUE(holds(coarse.err, "spring of body 'mass': ω·dt = 3.873"));
    EXPECT_TRUE(holds(coarse.err, "rate ≥ 2 Hz, or implicit_midpoint"));
    const Outcome euler = shell("spring_damper --steps 1 --method explicit_euler");
    EXPECT_TRUE(holds(euler.err, "rate ≥ 151 Hz"));
    for (const char* fine : {"--rate 2", "--rate 1 --method implicit_euler --quiet",
                             "--rate 1 --quiet", "--rate 150 --method explicit_euler"})
        EXPECT_EQ(shell(std::string("spring_damper --steps 1 ") + fine).err, "") << fine;
}

TEST(Program, NamesTheCauseOfADivergence) {
    const Folder folder;
    const Outcome run = shell(
        "spring_damper --steps 5000 --rate 1 --quiet --trace " + quoted(folder / "trace.csv"), 5);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_TRUE(holds(run.err, "semi_implicit_euler needs < 1.974"));
    // Tick 0 is in the trace, and the tick that diverged is not.
    const std::string trace = text_of(folder / "trace.csv");
    const auto tick = std::count(trace.begin(), trace.end(), '\n') - 1;
    EXPECT_TRUE(holds(run.err, "diverged at step " + std::to_string(tick) + " "));
    EXPECT_EQ(trace.back(), '\n');
}

TEST(Program, RefusesAMethodThatCannotStepItsForcesBeforeItWrites) {
    const Folder folder;
    const Outcome run =
        shell("projectile --method exact" + small + "--out " + quoted(folder / "o"), 2);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_TRUE(holds(run.err, "quadratic_drag has no exact flow"));
    EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

TEST(Program, TakesDampingFromTheOption) {
    const auto position = [](const std::string& options) {
        const Outcome run =
            shell("spring_damper --quiet --steps 1000 --json - --trace /dev/null " + options);
        const Json json = Json::parse(run.out);
        return std::pair(json.at("damping").get<std::string>(),
                         json.at("state_hash").get<std::string>());
    };
    const auto hash_of_rk4 = [](const std::string& options) {
        return Json::parse(
                   shell("spring_damper --quiet --steps 9 --json - --method rk4" + options).out)
            .at("state_hash");
    };
    EXPECT_EQ(position("").first, "kick");
    EXPECT_EQ(position(""), position("--damping kick"));
    EXPECT_NE(position("--damping drift").second, position("").second);
    EXPECT_EQ(hash_of_rk4(""), hash_of_rk4(" --damping kick"));
}

// The states of the run are the same with and without it, and the picture keeps its shape.
TEST(Program, FramesHaveTheInspectorIfAsked) {
    const Folder folder;
    const std::string film = "spring_damper --headless --quiet --rate 20 --fps 10 --frames 12 ";
    shell(film + "--size 800x360 --out " + quoted(folder / "without"), 0);
    shell(film + "--size 800x360 --inspector --out " + quoted(folder / "with"), 0);
    const Json without = Json::parse(text_of(folder / "without/manifest.json"))["frames"];
    const Json with = Json::parse(text_of(folder / "with/manifest.json"))["frames"];
    ASSERT_EQ(without.size(), 12U);
    ASSERT_EQ(with.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_EQ(with[i]["state_hash"], without[i]["state_hash"]);
        EXPECT_NE(with[i]["pixel_hash"], without[i]["pixel_hash"]);
    }
    EXPECT_NE(with[11]["pixel_hash"], with[10]["pixel_hash"]);
    for (const char* other : {"--sheet x.png", "--golden x", "--frame 3"})
        shell(film + "--inspector " + other, 2);
    shell("hello --inspector --steps 3", 2);
}

TEST(Program, FramesAreValidPngFiles) {
    if (shell("command -v pngcheck").exit != 0) GTEST_SKIP() << "pngcheck is not installed";
    const Folder folder;
    shell("projectile" + small + "--frames 3 --out " + quoted(folder / "o"), 0);
    shell("pngcheck -q " + quoted(folder / "o") + "/*.png", 0);
}

TEST(Program, FrameIShowsTickIWhenRateAndFpsAgree) {
    const Folder folder;
    shell("hello" + small + "--rate 60 --fps 60 --frames 40 --out " + quoted(folder / "o"), 0);
    const Json frames = Json::parse(text_of(folder / "o" / "manifest.json"))["frames"];
    for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(frames[i]["tick"], i);
        EXPECT_EQ(frames[i]["alpha"], 0.0);
    }
}

// With XDG_RUNTIME_DIR set, SDL falls back to an invisible driver.
TEST(Program, WithoutADisplayNamesHeadless) {
    const Folder folder;
    for (const std::string& set : {std::string("unset XDG_RUNTIME_DIR"),
                                   "export XDG_RUNTIME_DIR=" + quoted(folder.path())}) {
        const Outcome run = shell(set + "; hello --frames 2", 3);
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_TRUE(holds(run.err, "--headless"));
    }
}

TEST(Program, WrongUsageIsOneLineAndExitTwo) {
    for (const std::string words : {"--rate 0", "--nonsense", "--headless --size 99999x1"}) {
        const Outcome run = shell("hello " + words, 2);
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_TRUE(run.out.empty()) << run.out;
    }
}

TEST(Program, AFailedWriteIsOneLineAndExitFour) {
    for (const std::string words :
         {"--headless --quiet --frames 1 --size 16x9 --out /proc/none",
          "--steps 1 --trace /proc/none", "--steps 1 --quiet --json /dev/full",
          "--steps 100 --quiet --energy /dev/full"}) {
        const Outcome run = shell("hello " + words, 4);
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
    }
}

TEST(Program, AnInterruptedCaptureIsCompleteUpToThere) {
    const Folder folder;
    shell("hello" + small + "--frames 100000 --out " + quoted(folder / "o") +
              " & for i in $(seq 400); do [ -e " + quoted(folder / "o" / "frame_000003.png") +
              " ] && break; sleep 0.05; done; kill -TERM $!; wait $!",
          130);
    const Json manifest = Json::parse(text_of(folder / "o" / "manifest.json"));
    EXPECT_GE(manifest["frames"].size(), 4U);
    EXPECT_EQ(names_in(folder / "o").size(), manifest["frames"].size() + 2) << "no other file";
}

TEST(Program, TraceReadsBackAndJsonDescribesTheRun) {
    const Folder folder;
    const Outcome run =
        shell("spring_damper --quiet --steps 1000 --json - --trace " + quoted(folder / "t.csv") +
                  " --energy " + quoted(folder / "e.csv"),
              0);
    const Json report = Json::parse(run.out);
    for (const char* key : {"scene", "method", "rate", "precision", "steps", "time", "bodies",
                            "state_hash", "energy", "dropped_time", "wall_seconds"})
        EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_EQ(report["energy"]["first"]["total"], 7.5e6) << "k·x²/2 of 15 N/m and 1000 m";

    std::istringstream rows(text_of(folder / "t.csv"));
    std::string row;
    std::getline(rows, row);
    EXPECT_EQ(row, "tick,time,body,x,vx");
    std::getline(rows, row);
    EXPECT_EQ(row, "0,0,0,1000,0");
    int count = 1;
    for (std::string next; std::getline(rows, next); ++count) row = next;
    EXPECT_EQ(count, 1001);
    // tests/data/spring_states.json: semi_implicit_euler_kd/E after 1000 steps. Round-off of 1000
    // steps, each of a few half units in the last place of 1000 m, is below 1e-9.
    double x = 0;
    const std::string tail = row.substr(row.find(',', row.find(',') + 1) + 3);
    std::from_chars(tail.data(), tail.data() + tail.size(), x);
    EXPECT_NEAR(x, 303.79268459741713, 1e-9) << row;
}

// Semi-implicit Euler misses 2.025 m by speed·dt/2.
TEST(Program, JsonHasTheReadingsOfAGame) {
    const Outcome run = shell("jump --quiet --steps 240 --json -", 0);
    EXPECT_NEAR(Json::parse(run.out)["readings"]["apex of the right ball"].get<double>(),
                2.025 - 9.0 / 240 / 2, 1e-12);
    EXPECT_FALSE(Json::parse(shell("hello --quiet --steps 1 --json -").out).contains("readings"));
}

// Every option differs from the default of the demo. 7 steps at 50 Hz are 0.14 s.
TEST(Program, JsonHasTheGivenSettings) {
    const Outcome run = shell(
        "spring_damper --quiet --steps 7 --rate 50 --method velocity_verlet --precision float "
        "--damping kick --threads 3 --seed 9 --json -",
        0);
    const Json report = Json::parse(run.out);
    EXPECT_EQ(report["scene"], "spring_damper");
    EXPECT_EQ(report["method"], "velocity_verlet");
    EXPECT_EQ(report["damping"], "kick");
    EXPECT_EQ(report["rate"], 50);
    EXPECT_EQ(report["precision"], "float");
    EXPECT_EQ(report["threads"], 3);
    EXPECT_EQ(report["seed"], 9);
    EXPECT_EQ(report["steps"], 7);
    EXPECT_EQ(report["time"], 0.14);
    EXPECT_EQ(report["bodies"], 1);
    EXPECT_LT(report["energy"]["last"]["potential"], report["energy"]["first"]["potential"]);
    EXPECT_GT(report["energy"]["last"]["kinetic"], 0);
}

TEST(Program, DivergedRunNamesStepBodyAndFieldAndKeepsItsTrace) {
    const Folder folder;
    const Outcome run = shell(
        "spring_damper --quiet --method explicit_euler --rate 1 --steps 100000 "
        "--trace " +
            quoted(folder / "t.csv"),
        5);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    for (const char* word : {"step", "body 'mass'", "explicit_euler"})
        EXPECT_TRUE(holds(run.err, word));
    const std::string trace = text_of(folder / "t.csv");
    EXPECT_EQ(trace.back(), '\n');
    EXPECT_FALSE(holds(trace, "inf"));
}

TEST(Program, ClosedOrFullStreamsDoNoHarm) {
    const Folder folder;
    const std::string trace = quoted(folder / "t.csv");
    shell("hello --headless --size 16x9 --frames 1 --out " + quoted(folder / "o") + " --trace " +
              trace + " 2>&-",
          0);
    EXPECT_TRUE(text_of(folder / "t.csv").starts_with("tick,")) << text_of(folder / "t.csv");
    shell("hello --rate 0 2>&-", 2);
    shell("hello --rate 0 2>/dev/full", 2);
    shell("hello --help >/dev/full", 4);
    shell("hello --steps 5 --json - >/dev/full", 4);
    shell("(hello --steps 300000 --trace -; echo $? >" + trace + ") | head -1", 0);
    EXPECT_EQ(text_of(folder / "t.csv"), "4\n") << "the reader has closed the pipe";
}

TEST(Program, ADanglingLinkIsNotReplaced) {
    const Folder folder;
    std::filesystem::create_symlink("nothing", folder / "link");
    shell("hello --steps 5 --quiet --json " + quoted(folder / "link"), 4);
    EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"link"}));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
}

// A step of explicit Euler multiplies the energy by |1 + λ·dt|² = 1 − c·dt + ω²·dt², or 15.9 for
// the article's spring at 1 Hz: 7.5·10⁶ J pass the largest double between the steps 250 and 252.
TEST(Program, AnEnergyThatOverflowsIsADivergence) {
    const std::string line = "spring_damper --quiet --method explicit_euler --rate 1 --steps 300";
    const Outcome run = shell(line + " --json -", 5);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    const Json report = Json::parse(run.out);
    EXPECT_NEAR(report["steps"].get<int>(),
                std::log(std::numeric_limits<double>::max() / 7.5e6) / std::log(15.9), 1);
    EXPECT_EQ(report["energy"]["first"]["total"], 7.5e6);
    EXPECT_EQ(report["energy"]["last"], nullptr);
    EXPECT_TRUE(holds(
        run.err, fmt::format("at tick {}: body 'mass' moves at ", report["steps"].get<int>())));
    EXPECT_EQ("spring_damper: " + report["diverged"].get<std::string>() + "\n", run.err);
    const Outcome without = shell(line, 5);
    EXPECT_EQ(without.err, run.err);
}

TEST(Program, ADivergedRunReplacesTheReportOfAnEarlierOne) {
    const Folder folder;
    shell("spring_damper --steps 1 --quiet --json " + quoted(folder / "a.json"), 0);
    shell("spring_damper --steps 5000 --rate 1 --quiet --json " + quoted(folder / "a.json"), 5);
    const Json report = Json::parse(text_of(folder / "a.json"));
    EXPECT_TRUE(holds(report["diverged"].get<std::string>(), "diverged at step"));
    EXPECT_EQ(report["energy"]["last"], nullptr);
    EXPECT_EQ(report["state_hash"], nullptr);
}

// An empty file in its place keeps a library from being loaded.
TEST(Program, TakesEglWhereMesaHasNoOsMesa) {
    const Folder folder;
    put(folder / "libOSMesa.so.8", "");
    const std::string capture = "LD_LIBRARY_PATH=" + quoted(folder.path()) + " hello" + small +
                                "--frames 1 --out " + quoted(folder / "out") + " --surface ";
    const Outcome osmesa = shell(capture + "osmesa", 3);
    EXPECT_TRUE(is_one_line(osmesa.err)) << osmesa.err;
    for (const char* const words : {"Mesa 25.1 dropped OSMesa", "--surface egl", "libosmesa6"})
        EXPECT_TRUE(holds(osmesa.err, words)) << osmesa.err;
    if (shell(capture + "egl").exit == 3) GTEST_SKIP() << "EGL is not installed";
    EXPECT_EQ(shell(capture + "auto", 0).err, "");
    EXPECT_EQ(Json::parse(text_of(folder / "out" / "manifest.json"))["provider"], "egl");
    put(folder / "libEGL.so.1", "");
    const Outcome neither = shell(capture + "auto", 3);
    EXPECT_TRUE(is_one_line(neither.err)) << neither.err;
    EXPECT_TRUE(holds(neither.err, "install the Debian packages libegl1 and libgl1-mesa-dri"));
}

// Mesa 22.3 would dereference null.
TEST(Program, MesaWithoutItsDriverIsNoOpenGl) {
    const Folder folder;
    const std::string line = "hello --headless --frames 1 --size 64x36 --quiet --out " +
                             quoted(folder / "out") + " --surface ";
    for (const std::string surface : {"osmesa", "egl", "auto"}) {
        if (shell(line + surface).exit == 3) continue;
        for (const std::string driver : {"bogus", "zink", "LLVMPIPE"}) {
            const Outcome run = shell("export GALLIUM_DRIVER=" + driver + "; " + line + surface, 3);
            EXPECT_TRUE(holds(run.err, "unset variables of Mesa such as GALLIUM_DRIVER"));
        }
        if (surface == "egl")
            shell("export MESA_LOADER_DRIVER_OVERRIDE=zink; " + line + surface, 3);
    }
}

// Mesa 22.3 would damage its memory.
TEST(Program, AVectorWithoutRoomForAFloatIsNoOpenGl) {
    const Folder folder;
    const std::string line =
        " hello --headless --frames 1 --size 64x36 --quiet --out " + quoted(folder / "out");
    for (const char* width : {"0", "7", "31", "5x", "0x1f"})
        EXPECT_TRUE(holds(shell(std::string("LP_NATIVE_VECTOR_WIDTH=") + width + line, 3).err,
                          "unset it, or set it to 128, 256 or 512"));
}

// Mesa would wait for its threads for ever. The limit is not that of root.
TEST(Program, DrawsTheSameWithoutThreads) {
    const Folder folder;
    const std::string line = "hello --headless --frames 2 --size 64x36 --quiet --out ";
    const Outcome run = shell(line + quoted(folder / "threads"));
    if (run.exit == 3) GTEST_SKIP() << run.err;
    const std::string as_nobody = getuid() == 0
                                      ? "setpriv --reuid=65534 --inh-caps=-all,+dac_override "
                                        "--ambient-caps=-all,+dac_override "
                                      : "";
    shell("timeout 60 " + as_nobody + "prlimit --nproc=1 " + line + quoted(folder / "none"), 0);
    EXPECT_EQ(text_of(folder / "none/frame_000001.png"),
              text_of(folder / "threads/frame_000001.png"));
}

// The runs would take hours.
TEST(Program, KeepsFilesOfAnotherKind) {
    const Folder folder;
    put(folder / "mine", "my notes\n");
    put(folder / "scene.gif", "[scene]\naxes = 1\n");
    put(folder / "package.json", "{\n  \"name\": \"mine\"\n}\n");
    const std::string steps = "timeout 60 hello --steps 1000000000000 --quiet ";
    const std::string frames = "timeout 60 hello --headless --frames 1000000 --quiet --out " +
                               quoted(folder / "out") + " ";
    for (const char* option : {"--json", "--trace", "--energy", "--profile", "--record"})
        shell(steps + option + " " + quoted(folder / "mine"), 2);
    for (const char* option : {"--json", "--profile"})
        shell(steps + option + " " + quoted(folder / "package.json"), 2);
    for (const char* option : {"--sheet", "--json"})
        shell(frames + option + " " + quoted(folder / "scene.gif"), 2);
    const Outcome run = shell(frames + "--video " + quoted(folder / "scene.gif"), 2);
    EXPECT_EQ(run.err, "hello: " + (folder / "scene.gif").string() +
                           " is not a video and would be lost; remove it or choose another path\n");
    EXPECT_EQ(text_of(folder / "mine"), "my notes\n");
    EXPECT_EQ(text_of(folder / "scene.gif"), "[scene]\naxes = 1\n");
    EXPECT_EQ(text_of(folder / "package.json"), "{\n  \"name\": \"mine\"\n}\n");
    EXPECT_EQ(names_in(folder.path()),
              (std::vector<std::string>{"mine", "package.json", "scene.gif"}));
}

// The run would take hours.
TEST(Program, AReportThatCannotBeWrittenIsNamedBeforeTheRun) {
    const Outcome run =
        shell("timeout 60 hello --quiet --steps 1000000000000 --json /proc/none", 4);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
}

TEST(Program, QuietPrintsNothingAndDataNeedsAnOption) {
    const Folder folder;
    const Outcome quiet = shell("hello" + small + "--frames 2 --out " + quoted(folder / "o"));
    EXPECT_EQ(quiet.out + quiet.err, "");
    const Outcome loud =
        shell("hello --headless --size 160x90 --frames 2 --out " + quoted(folder / "p"));
    EXPECT_EQ(loud.out, "");
    const Json manifest = Json::parse(text_of(folder / "p" / "manifest.json"));
    EXPECT_TRUE(holds(loud.err, manifest["provider"].get<std::string>()))
        << "auto prints the selected surface";
}

// 501 steps of 1/60 s at 2 frames per second; without a script, hello is 4 s long.
TEST(Program, FilmsAScriptToItsEnd) {
    const Folder folder;
    put(folder / "long", "500 press Space\n");
    put(folder / "short", "5 press Space\n");
    const auto frames = [&](const std::string& script) {
        shell("hello" + small + "--fps 2 --png none --script " + quoted(folder / script) +
                  " --out " + quoted(folder / (script + "_film")),
              0);
        return Json::parse(text_of(folder / (script + "_film") / "manifest.json"))["frames"].size();
    };
    EXPECT_EQ(frames("long"), 17U);
    EXPECT_EQ(frames("short"), 8U);
}

}  // namespace
}  // namespace oiler::test
