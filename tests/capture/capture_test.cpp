// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "oiler/capture/capture.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/core/state_hash.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr Size size{1, 2};
const std::vector<std::uint8_t> bottom_up = {1, 2, 3, 4, 5, 6};

Manifest header() {
    Manifest manifest;
    manifest.version = "0.1.0";
    manifest.compiler = "g++ 12.2.0";
    manifest.provider = "osmesa";
    manifest.gl_renderer = "llvmpipe";
    manifest.gl_version = "3.3";
    manifest.size = size;
    manifest.fps = 60;
    manifest.rate = 100;
    manifest.method = "rk4";
    manifest.precision = "double";
    manifest.scene = "spring \"damper\" \xff";
    manifest.seed = 18'446'744'073'709'551'615U;
    manifest.damping = "drift";
    manifest.scene_text = "[scene]\n";
    return manifest;
}

Manifest header(int frames) {
    Manifest manifest = header();
    manifest.planned_frames = frames;
    return manifest;
}

Shot shot(int i) {
    return {.tick = i,
            .alpha = 0.1 * i,
            .state_hash = 0xfedcba9876543210U,
            .picture_hash = 0x0123456789abcdefU,
            .rgb = bottom_up};
}

void capture(const fs::path& folder, int frames) {
    Capture capture(folder, header(frames));
    for (int i = 0; i < frames; ++i) capture.add(shot(i));
    capture.finish();
}

void expect_io_error(const fs::path& folder) {
    (void)line_of_error(Exit::io, [&] { capture(folder, 1); });
}

TEST(Capture, WritesFramesAndAManifestThatNamesThem) {
    const Folder folder;
    capture(folder / "out", 2);
    EXPECT_EQ(names_in(folder / "out"),
              (Names{"frame_000000.png", "frame_000001.png", "manifest.json"}));
    const auto json = nlohmann::json::parse(text_of(folder / "out/manifest.json"));
    EXPECT_EQ(json["frames"].size(), 2U);
    const auto& frame = json["frames"][1];
    EXPECT_EQ(frame["index"], 1);
    EXPECT_EQ(frame["file"], "frame_000001.png");
    EXPECT_EQ(frame["tick"], 1);
    EXPECT_EQ(frame["alpha"], 0.1);
    EXPECT_EQ(frame["state_hash"], "fedcba9876543210");
    const std::string_view top_down = "\4\5\6\1\2\3";
    StateHash expected;
    expected.add(std::as_bytes(std::span(top_down)));
    EXPECT_EQ(frame["pixel_hash"], hash_text(expected.value()));
}

// All numbers and all texts of the header are different.
TEST(Capture, ManifestHasEachFieldOfTheHeader) {
    const Folder folder;
    capture(folder / "out", 1);
    const auto json = nlohmann::json::parse(text_of(folder / "out/manifest.json"));
    EXPECT_EQ(json["version"], "0.1.0");
    EXPECT_EQ(json["compiler"], "g++ 12.2.0");
    EXPECT_EQ(json["provider"], "osmesa");
    EXPECT_EQ(json["gl_renderer"], "llvmpipe");
    EXPECT_EQ(json["gl_version"], "3.3");
    EXPECT_EQ(json["width"], 1);
    EXPECT_EQ(json["height"], 2);
    EXPECT_EQ(json["fps"], 60);
    EXPECT_EQ(json["rate"], 100);
    EXPECT_EQ(json["method"], "rk4");
    EXPECT_EQ(json["precision"], "double");
    EXPECT_EQ(json["scene"], "spring \"damper\" \xef\xbf\xbd");
    EXPECT_EQ(json["seed"], 18'446'744'073'709'551'615U);
    EXPECT_EQ(json["damping"], "drift");
    EXPECT_EQ(json["scene_text"], "[scene]\n");
    EXPECT_EQ(json["planned_frames"], 1);
    EXPECT_EQ(json["finished"], true);
}

TEST(Capture, ManifestHasOneLinePerFrame) {
    const Folder folder;
    capture(folder / "out", 2);
    const std::string text = text_of(folder / "out/manifest.json");
    EXPECT_TRUE(holds(text,
                      "\n    {\"index\":1,\"file\":\"frame_000001.png\",\"tick\":1,\"alpha\":0.1,"
                      "\"state_hash\":\"fedcba9876543210\",\"picture_hash\":\"0123456789abcdef\","
                      "\"pixel_hash\":\""));
    EXPECT_TRUE(text.ends_with("}\n  ]\n}\n"));
}

TEST(Capture, TheSameRunGivesTheSameBytes) {
    const Folder folder;
    capture(folder / "a", 3);
    capture(folder / "b", 3);
    ASSERT_EQ(names_in(folder / "a"), names_in(folder / "b"));
    for (const std::string& name : names_in(folder / "a"))
        EXPECT_EQ(text_of(folder / "a" / name), text_of(folder / "b" / name)) << name;
}

TEST(Capture, ACaptureOfAnotherSceneStays) {
    const Folder folder;
    capture(folder / "out", 2);
    const std::string manifest = text_of(folder / "out/manifest.json");
    Manifest other = header(1);
    other.scene = "jump";
    EXPECT_TRUE(
        holds(line_of_error(Exit::io, [&] { const Capture refused(folder / "out", other); }),
              "not of jump; remove it or choose another folder"));
    EXPECT_EQ(names_in(folder / "out"),
              (Names{"frame_000000.png", "frame_000001.png", "manifest.json"}));
    EXPECT_EQ(text_of(folder / "out/manifest.json"), manifest);
}

TEST(Capture, AShorterRunLeavesNoStaleFrame) {
    const Folder folder;
    capture(folder / "out", 5);
    put(folder / "out/notes.txt", "mine");
    capture(folder / "out", 1);
    EXPECT_EQ(names_in(folder / "out"), (Names{"frame_000000.png", "manifest.json", "notes.txt"}));
}

// A capture that is not finished is one that was killed.
TEST(Capture, AKilledRunLeavesNoStaleFrameEither) {
    const Folder folder;
    {
        Capture killed(folder / "out", header(9));
        const auto json = nlohmann::json::parse(text_of(folder / "out/manifest.json"));
        EXPECT_EQ(json["finished"], false) << "there from the start";
        EXPECT_EQ(json["frames"].size(), 0U);
        for (int i = 0; i < 5; ++i) killed.add(shot(i));
    }
    EXPECT_EQ(names_in(folder / "out").size(), 6U);
    capture(folder / "out", 1);
    EXPECT_EQ(names_in(folder / "out"), (Names{"frame_000000.png", "manifest.json"}));
}

TEST(Capture, AnInterruptedRunNamesTheFramesThatAreThere) {
    const Folder folder;
    {
        Capture stopped(folder / "out", header(9));
        for (int i = 0; i < 2; ++i) stopped.add(shot(i));
        stopped.finish();
    }
    const auto json = nlohmann::json::parse(text_of(folder / "out/manifest.json"));
    EXPECT_EQ(json["finished"], false);
    EXPECT_EQ(json["frames"].size(), 2U);
    EXPECT_EQ(json["planned_frames"], 9);
}

// Readers of frame_*.png would mix such files with the frames of a capture.
TEST(Capture, FramesOfAnotherProgramAreRefused) {
    for (const char* name : {"frame_000000.png", "frame_1.png", "frame_.png", "frame_00000a.png",
                             "frame_000007.png", "frame_1000000.png"}) {
        const Folder folder;
        fs::create_directories(folder / "out");
        for (const bool after_a_capture : {false, true}) {
            if (after_a_capture) {
                fs::remove(folder / "out" / name);
                capture(folder / "out", 7);
                if (fs::exists(folder / "out" / name)) continue;  // a frame of ours
            }
            put(folder / "out" / name, "keep");
            const Names before = names_in(folder / "out");
            expect_io_error(folder / "out");
            EXPECT_EQ(text_of(folder / "out" / name), "keep") << name;
            EXPECT_EQ(names_in(folder / "out"), before) << name;
        }
    }
}

TEST(Capture, OtherFilesStay) {
    const Folder folder;
    capture(folder / "out", 2);
    fs::create_directories(folder / "out/sub");
    const Names kept = {"out/xframe_000001.png", "out/sub/frame_000001.png", "out/notes.png"};
    for (const std::string& name : kept) put(folder / name, "keep");
    capture(folder / "out", 1);
    for (const std::string& name : kept) EXPECT_EQ(text_of(folder / name), "keep") << name;
}

TEST(Capture, FilesThatAreLinksAreRefused) {
    for (const char* name : {"frame_000001.png", "manifest.json"}) {
        const Folder folder;
        capture(folder / "out", 2);
        fs::rename(folder / "out" / name, folder / "victim");
        const std::string before = text_of(folder / "victim");
        fs::create_symlink("../victim", folder / "out" / name);
        expect_io_error(folder / "out");
        EXPECT_EQ(text_of(folder / "victim"), before);
        EXPECT_TRUE(fs::is_symlink(folder / "out" / name));
    }
}

TEST(Capture, ASecondCaptureIntoTheFolderIsRefusedWithTheOwner) {
    const Folder folder;
    Capture first(folder / "out", header(1));
    first.add(shot(0));
    const std::string line =
        line_of_error(Exit::io, [&] { const Capture second(folder / "out", header(1)); });
    EXPECT_TRUE(holds(line, "process " + std::to_string(getpid())));
    first.finish();
    EXPECT_EQ(names_in(folder / "out"),
              (Names{".oiler-capture", "frame_000000.png", "manifest.json"}));
}

TEST(Capture, ADeadOwnerIsNamedAndItsFolderFree) {
    const Folder folder;
    fs::create_directories(folder / "out");
    put(folder / "out/.oiler-capture", "process 1234 of elsewhere\n");
    const Capture next(folder / "out", header(1));
    EXPECT_EQ(next.dead_owner(), "process 1234 of elsewhere");
}

TEST(Capture, AFileOfTheUserIsNotTakenForThatOfAnOwner) {
    const Folder folder;
    fs::create_directories(folder / "out");
    put(folder / "out/.oiler-capture", "my notes");
    EXPECT_TRUE(
        holds(line_of_error(Exit::io, [&] { const Capture next(folder / "out", header(1)); }),
              ".oiler-capture is not from Oiler; rename it"));
    EXPECT_EQ(text_of(folder / "out/.oiler-capture"), "my notes");
}

TEST(Capture, AFinishedCaptureHasNoDeadOwner) {
    const Folder folder;
    capture(folder / "out", 2);
    put(folder / "out/.oiler-capture", "process 1234 of elsewhere\n");
    const Capture next(folder / "out", header(1));
    EXPECT_EQ(next.dead_owner(), "");
}

// Linux has no processes of seven digits above 4194304. Process 1 runs.
TEST(Capture, TemporaryFilesOfKilledRunsAreRemoved) {
    const Folder folder;
    fs::create_directories(folder / "out/.oiler-4194307-0.tmp");
    for (const char* name :
         {".oiler-4194305-0.tmp", ".oiler-4194306-17.tmp", ".oiler-1-0.tmp", ".oiler-notes",
          ".oiler-4194305.tmp", ".oiler-a-0.tmp", ".oiler-4194305-0.tmp.tmp"})
        put(folder / "out" / name, "half");
    File mine(folder / "out/notes.txt");
    mine.write("mine");
    capture(folder / "out", 1);
    mine.commit();
    EXPECT_EQ(names_in(folder / "out"),
              (Names{".oiler-1-0.tmp", ".oiler-4194305-0.tmp.tmp", ".oiler-4194305.tmp",
                     ".oiler-4194307-0.tmp", ".oiler-a-0.tmp", ".oiler-notes", "frame_000000.png",
                     "manifest.json", "notes.txt"}));
}

TEST(Capture, AManifestOfAnotherProgramIsNotTouched) {
    for (const char* text :
         {"{}", "[]", "", "{\"frames\":1}", "{\"gl_renderer\":\"x\"}", "{\"frames\":{}}",
          "{\"frames\":[{}]}", "not json", "{\"name\":\"a web app\"}"}) {
        const Folder folder;
        put(folder / "manifest.json", text);
        expect_io_error(folder.path());
        EXPECT_EQ(text_of(folder / "manifest.json"), text);
        EXPECT_EQ(names_in(folder.path()), Names{"manifest.json"});
    }
}

TEST(Capture, AFolderThatStayedEmptyIsRemoved) {
    const Folder folder;
    { const Capture unused(folder / "out", header(1)); }
    EXPECT_FALSE(fs::exists(folder / "out"));
    fs::create_directory(folder / "mine");
    { const Capture unused(folder / "mine", header(1)); }
    EXPECT_TRUE(fs::exists(folder / "mine"));
}

/// Captures three frames with records, of which one cannot get its name.
void capture_with_a_failure(const fs::path& folder, int failing) {
    Capture capture(folder, header(3));
    fs::create_directory(folder / frame_name(failing));
    put(folder / frame_name(failing) / "kept", "");
    try {
        for (int i = 0; i < 3; ++i) {
            Shot next = shot(i);
            next.record.emplace();
            capture.add(std::move(next));
        }
    } catch (const Error&) {
        // The frame may fail before the last one is added; finish() throws its error again.
    }
    capture.finish();
}

TEST(Capture, AFailedFrameEndsTheCaptureBeforeIt) {
    for (const int failing : {0, 1, 2}) {
        const Folder folder;
        EXPECT_THROW(capture_with_a_failure(folder / "out", failing), Error);
        Names expected;
        for (int i = 0; i <= failing; ++i) expected.push_back(frame_name(i));
        if (failing > 0) expected.push_back("manifest.json");
        EXPECT_EQ(names_in(folder / "out"), expected) << "neither later frames nor records";
        if (failing == 0) continue;
        const Manifest manifest = read_manifest(folder / "out");
        EXPECT_FALSE(manifest.is_finished());
        EXPECT_EQ(manifest.frames.size(), static_cast<std::size_t>(failing));
    }
}

TEST(Capture, AFolderThatIsRemovedMeanwhileIsAnErrorAndStaysAway) {
    const Folder folder;
    {
        Capture capture(folder / "frames", header(3));
        capture.add(shot(0));
        while (!fs::exists(folder / "frames" / frame_name(0))) std::this_thread::yield();
        fs::remove_all(folder / "frames");
        EXPECT_TRUE(holds(line_of_error(Exit::io,
                                        [&] {
                                            capture.add(shot(1));
                                            capture.finish();
                                        }),
                          "was removed during the capture"));
    }
    EXPECT_EQ(names_in(folder.path()), Names{});
}

TEST(Capture, AFrameThatCannotBeWrittenIsAnError) {
    const Folder folder;
    fs::create_directories(folder / "out/frame_000000.png");
    expect_io_error(folder / "out");
    EXPECT_EQ(names_in(folder / "out"), Names{"frame_000000.png"});
    put(folder / "file", "");
    expect_io_error(folder / "file");
    expect_io_error("/proc/none");
}

class Paths : public testing::Test {
protected:
    Paths() : former_(fs::current_path()) {
        put(folder_ / "in.toml", "scene");
        put(folder_ / "other", "");
        fs::create_directory(folder_ / "sub");
        fs::create_symlink("in.toml", folder_ / "soft");
        fs::create_symlink(".", folder_ / "here");
        fs::create_hard_link(folder_ / "in.toml", folder_ / "hard");
        fs::current_path(folder_.path());
    }
    ~Paths() override { fs::current_path(former_); }

    static std::string refusal(const std::vector<NamedPath>& inputs,
                               const std::vector<NamedPath>& outputs) {
        try {
            require_distinct(inputs, outputs);
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
            return error.what();
        }
        return "";
    }

    Folder folder_;

private:
    fs::path former_;
};

TEST_F(Paths, AnOutputIsNoInputByWhateverName) {
    const std::vector<NamedPath> input{{"SCENE", "in.toml"}};
    for (const fs::path& same :
         {fs::path("in.toml"), fs::path("./in.toml"), fs::path("sub/../in.toml"),
          fs::path("here/in.toml"), folder_ / "in.toml", fs::path("soft"), fs::path("hard")})
        EXPECT_EQ(
            refusal(input, {{"--json", same}}),
            "--json: " + same.string() + " would overwrite SCENE, an input; give another path");
    for (const char* const another : {"other", "new", "sub/in.toml", "-", ""})
        EXPECT_EQ(refusal(input, {{"--json", another}}), "") << another;
}

TEST_F(Paths, TwoOutputsAreTwoFiles) {
    fs::create_symlink("other", folder_ / "link");
    using Pair = std::pair<fs::path, fs::path>;
    for (const auto& [a, b] :
         {Pair{"new", "./new"}, Pair{"new", folder_ / "new"}, Pair{"new/a", "sub/../new/a"},
          Pair{"sub/new", "here/sub/new"}, Pair{"link", "other"}, Pair{"-", "-"},
          Pair{"sub", "sub/"}, Pair{"new", "new/"}})
        EXPECT_EQ(refusal({}, {{"--trace", a}, {"--json", b}}),
                  "--trace and --json: both write " + b.string() + "; give two paths");
    for (const auto& [a, b] : {Pair{"new", "newer"}, Pair{"", ""}, Pair{"-", "new"},
                               Pair{"/dev/null", "/dev/null"}, Pair{"sub/new", "new"}})
        EXPECT_EQ(refusal({}, {{"--trace", a}, {"--json", b}}), "") << a << b;
}

TEST_F(Paths, ThePlaceOfStandardOutputCounts) {
    const int saved = dup(STDOUT_FILENO);
    std::fflush(stdout);
    FILE* const redirected = fopen("in.toml", "a");
    dup2(fileno(redirected), STDOUT_FILENO);
    const std::string input = refusal({{"SCENE", "in.toml"}}, {{"--json", "-"}});
    const std::string output = refusal({}, {{"--json", "-"}, {"--trace", "in.toml"}});
    dup2(saved, STDOUT_FILENO);
    close(saved);
    fclose(redirected);
    EXPECT_TRUE(holds(input, "SCENE"));
    EXPECT_TRUE(holds(output, "--trace"));
}

TEST_F(Paths, FilesOfAnOutputFolderCount) {
    const auto writes = [](std::string_view name) { return name == "in.toml" || name == "made"; };
    for (const fs::path& out :
         {fs::path("."), fs::path("here"), fs::path("here/"), folder_.path()}) {
        EXPECT_NE(refusal({{"PART", "in.toml"}}, {{"--out", out, writes}}), "") << out;
        EXPECT_NE(refusal({}, {{"--out", out, writes}, {"--json", "made"}}), "") << out;
        EXPECT_NE(refusal({}, {{"--json", "made"}, {"--out", out, writes}}), "") << out;
        EXPECT_EQ(refusal({}, {{"--out", out, writes}, {"--json", "other"}}), "") << out;
        EXPECT_EQ(refusal({}, {{"--out", out, writes}, {"--json", "sub/made"}}), "") << out;
    }
    EXPECT_NE(refusal({}, {{"--out", "new/", writes}, {"--json", "new/made"}}), "");
    EXPECT_NE(refusal({}, {{"--out", "new", writes}, {"--json", "here/new/made"}}), "");
    EXPECT_EQ(refusal({}, {{"--out", "new", writes}, {"--json", "newer/made"}}), "");
}

}  // namespace
}  // namespace oiler::test
