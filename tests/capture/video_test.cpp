// SPDX-License-Identifier: MIT
#include "oiler/capture/video.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr Size size{31, 17};  // odd: H.264 needs padding

/// A frame whose upper half is red, and whose lower half grows brighter.
std::vector<std::uint8_t> frame(int index, Size of = size) {
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < of.height; ++y)
        for (int x = 0; x < of.width; ++x) {
            const bool upper = y >= of.height / 2;
            rgb.push_back(upper ? 255 : static_cast<std::uint8_t>(20 * index));
            rgb.push_back(0);
            rgb.push_back(upper ? 0 : static_cast<std::uint8_t>(20 * index));
        }
    return rgb;
}

/// A variable of the environment with another value during a test.
class Variable {
public:
    Variable(const char* name, const std::string& value) : name_(name) {
        const char* const former = std::getenv(name);
        former_ = former ? former : "";
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { setenv(name_, former_.c_str(), 1); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::string former_;
};

class Videos : public testing::Test {
protected:
    void SetUp() override {
        signal(SIGPIPE, SIG_IGN);
        if (std::system("command -v ffmpeg ffprobe > /dev/null") != 0)
            GTEST_SKIP() << "needs the Debian package ffmpeg";
    }
    void write(const fs::path& path, int frames, int fps = 25) {
        Video video(path, size, fps);
        for (int i = 0; i < frames; ++i) video.add(frame(i));
        video.finish();
    }
    /// Runs a line of shell in the folder and returns its output.
    std::string output_of(const std::string& line) {
        const std::string at = "cd '" + folder.path().string() + "'; ";
        EXPECT_EQ(std::system((at + "{ " + line + "; } > output").c_str()), 0) << line;
        return text_of(folder / "output");
    }
    /// Facts of the video as ffprobe reads them.
    std::string probe(const std::string& name, const std::string& entries) {
        return output_of("ffprobe -v error -count_frames -show_entries stream=" + entries +
                         " -of csv=p=0 " + name);
    }
    Folder folder;
};

// Browsers show a GIF whose frames follow after less than 0.02 s at 10 frames per second.
TEST_F(Videos, AGifHasAtMostFiftyFramesPerSecond) {
    Video video(folder / "a.gif", size, 60);
    for (int i = 0; i < 60; ++i) video.add(frame(i));
    video.finish();
    EXPECT_TRUE(probe("a.gif", "r_frame_rate,nb_read_frames").starts_with("50/1,50"))
        << probe("a.gif", "r_frame_rate,nb_read_frames");
}

TEST_F(Videos, HaveTheFramesAndTheRate) {
    for (const char* name : {"a.mp4", "a.gif", "a.apng"}) {
        write(folder / name, 10);
        const bool is_mp4 = std::string(name) == "a.mp4";
        EXPECT_TRUE(probe(name, "width,height,nb_read_frames")
                        .starts_with(is_mp4 ? "32,18,10" : "31,17,10"))
            << probe(name, "width,height,nb_read_frames");
        EXPECT_TRUE(probe(name, "r_frame_rate").starts_with("25/1")) << name;
    }
    EXPECT_TRUE(probe("a.mp4", "codec_name,pix_fmt").starts_with("h264,yuv420p"));
    EXPECT_EQ(names_in(folder.path()), (Names{"a.apng", "a.gif", "a.mp4", "output"}));
}

// APNG keeps each bit: ffmpeg's own frames, top row first, are those that were added.
TEST_F(Videos, OfApngKeepEachPixel) {
    write(folder / "a.apng", 3);
    const std::string raw = output_of("ffmpeg -v error -i a.apng -f rawvideo -pix_fmt rgb24 -");
    ASSERT_EQ(raw.size(), 3U * 31 * 17 * 3);
    for (int i = 0; i < 3; ++i) {
        const std::vector<std::uint8_t> bottom_up = frame(i);
        for (int y = 0; y < 17; ++y) {
            const std::size_t row = static_cast<std::size_t>(31) * 3;
            const auto* const expected = bottom_up.data() + row * static_cast<std::size_t>(16 - y);
            EXPECT_EQ(raw.substr(row * static_cast<std::size_t>(17 * i + y), row),
                      std::string(expected, expected + row))
                << i << ' ' << y;
        }
    }
}

TEST_F(Videos, OfTheSameFramesHaveTheSameBytes) {
    for (const char* ending : {".mp4", ".gif", ".apng"}) {
        write(folder / ("a" + std::string(ending)), 5);
        write(folder / ("b" + std::string(ending)), 5);
        EXPECT_EQ(text_of(folder / ("a" + std::string(ending))),
                  text_of(folder / ("b" + std::string(ending))));
    }
}

TEST_F(Videos, WithoutTheirEndLeaveNoFile) {
    {
        Video video(folder / "a.mp4", size, 25);
        for (int i = 0; i < 5; ++i) video.add(frame(i));
    }
    EXPECT_EQ(names_in(folder.path()), Names{});
}

TEST_F(Videos, AnotherEndingIsRefusedBeforeAnyFolderIsMade) {
    for (const char* name : {"new/a.avi", "new/a", "new/.mp4"})
        EXPECT_TRUE(
            holds(line_of_error(Exit::usage, [&] { const Video video(folder / name, size, 25); }),
                  ".mp4, .gif or .apng"))
            << name;
    EXPECT_EQ(names_in(folder.path()), Names{});
}

// The first limits end the file of the video, the next ones the pipes to ffmpeg.
TEST_F(Videos, WithoutDescriptorsNameTheirLimit) {
    const int free = open("/dev/null", O_RDONLY);
    ASSERT_GE(free, 0);
    close(free);
    rlimit descriptors{};
    getrlimit(RLIMIT_NOFILE, &descriptors);
    int refused = 0;
    for (bool is_refused = true; is_refused; refused += is_refused ? 1 : 0) {
        const rlimit few{static_cast<rlim_t>(free + refused), descriptors.rlim_max};
        setrlimit(RLIMIT_NOFILE, &few);
        std::string line;
        try {
            const Video video(folder / "a.mp4", size, 25);
            is_refused = false;
        } catch (const Error& error) {
            line = error.what();
        }
        setrlimit(RLIMIT_NOFILE, &descriptors);
        if (!is_refused) break;
        EXPECT_TRUE(holds(line, "Too many open files; raise the limit of `ulimit -n`")) << line;
    }
    EXPECT_GT(refused, 3);
    EXPECT_EQ(names_in(folder.path()), Names{});
}

TEST_F(Videos, WithoutFfmpegNameThePackage) {
    const Variable path("PATH", folder.path().string());
    EXPECT_TRUE(
        holds(line_of_error(Exit::io, [&] { const Video video(folder / "a.mp4", size, 25); }),
              "install the Debian package ffmpeg"));
    EXPECT_EQ(names_in(folder.path()), Names{});
}

/// The process that this one started.
pid_t child() {
    const std::string file = "/proc/self/task/" + std::to_string(getpid()) + "/children";
    pid_t process = 0;
    std::ifstream(file) >> process;
    return process;
}

TEST_F(Videos, AKilledFfmpegIsAnError) {
    const auto error_of = [&](bool adds) {
        Video video(folder / "a.mp4", {640, 360}, 25);
        video.add(frame(0, {640, 360}));
        kill(child(), SIGKILL);
        return line_of_error(Exit::io, [&] {
            for (int i = 0; adds && i < 1000; ++i) video.add(frame(i % 10, {640, 360}));
            video.finish();
        });
    };
    for (const bool adds : {true, false}) {
        EXPECT_EQ(error_of(adds),
                  "cannot write " + (folder / "a.mp4").string() + ": ffmpeg ended with signal 9");
        EXPECT_EQ(names_in(folder.path()), Names{});
    }
}

/// A program in the place of ffmpeg.
void put_program(const fs::path& path, const std::string& script) {
    put(path, "#!/bin/sh\n" + script + "\n");
    fs::permissions(path, fs::perms::owner_all);
}

TEST_F(Videos, WithoutTheirEndDoNotWaitForFfmpeg) {
    put_program(folder / "ffmpeg", "exec sleep infinity");
    const Variable path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    {
        const Video video(folder / "a.gif", size, 25);
        EXPECT_NE(getpgid(child()), getpgrp()) << "Ctrl-C signals the group of the terminal";
    }
    EXPECT_EQ(names_in(folder.path()), Names{"ffmpeg"});
}

TEST_F(Videos, FfmpegEndsWithAKilledProgram) {
    put_program(folder / "ffmpeg",
                "echo $$ > pid.tmp; mv pid.tmp pid; sleep 20 <&- >&- 2>&-; touch survived");
    const Variable path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    const pid_t program = fork();
    if (program == 0) {
        fs::current_path(folder.path());
        const Video video("a.gif", size, 25);
        alarm(60);
        pause();
    }
    const fs::path pid = folder / "pid";
    while (!fs::exists(pid) && waitpid(program, nullptr, WNOHANG) == 0) std::this_thread::yield();
    kill(program, SIGKILL);
    waitpid(program, nullptr, 0);
    const std::string process = "/proc/" + std::to_string(std::stoi(text_of(pid))) + "/stat";
    const auto has_ended = [&] {
        const std::string stat = text_of(process);
        return stat.empty() || holds(stat, ") Z");
    };
    while (!has_ended()) std::this_thread::yield();
    EXPECT_EQ(names_in(folder.path()), (Names{"ffmpeg", "pid"}));
}

TEST_F(Videos, FollowLinksAndKeepPermissions) {
    put(folder / "old.gif", "GIF87a");
    fs::permissions(folder / "old.gif", fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("old.gif", folder / "link.GIF");
    write(folder / "link.GIF", 3);
    EXPECT_TRUE(fs::is_symlink(folder / "link.GIF"));
    EXPECT_TRUE(text_of(folder / "old.gif").starts_with("GIF8"));
    EXPECT_EQ(fs::status(folder / "old.gif").permissions(),
              fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Videos, TheLastWordsOfFfmpegAreTold) {
    put_program(folder / "ffmpeg", "cat > /dev/null; echo first >&2; echo last words >&2; exit 3");
    const Variable path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    EXPECT_EQ(line_of_error(Exit::io, [&] { write(folder / "a.gif", 2); }),
              "cannot write " + (folder / "a.gif").string() +
                  ": ffmpeg ended with exit code 3: last words");
    EXPECT_EQ(names_in(folder.path()), Names{"ffmpeg"});
}

TEST_F(Videos, WithoutAByteReplaceNoOlderOne) {
    put_program(folder / "ffmpeg", "cat > /dev/null");
    put(folder / "a.gif", "GIF8 older");
    const Variable path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    EXPECT_EQ(line_of_error(Exit::io, [&] { write(folder / "a.gif", 2); }),
              "cannot write " + (folder / "a.gif").string() + ": ffmpeg ended with exit code 0");
    EXPECT_EQ(text_of(folder / "a.gif"), "GIF8 older");
}

// ffmpeg alone would end with 0. A limit of 4 KiB stands for a full disk.
TEST_F(Videos, AFileThatCannotBeCompletedIsAnError) {
    if (!fs::exists("/usr/bin/ffmpeg")) GTEST_SKIP() << "ffmpeg is elsewhere";
    put_program(folder / "ffmpeg", "trap '' XFSZ; ulimit -f 8; exec /usr/bin/ffmpeg \"$@\"");
    const Variable path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    for (const char* name : {"a.mp4", "a.gif", "a.apng"}) {
        const std::string line = line_of_error(Exit::io, [&] {
            Video video(folder / name, size, 25);
            std::mt19937 random(3);
            for (int i = 0; i < 60; ++i) {
                std::vector<std::uint8_t> noise = frame(i);
                for (std::uint8_t& value : noise) value = static_cast<std::uint8_t>(random());
                video.add(noise);
            }
            video.finish();
        });
        EXPECT_TRUE(holds(line, "File too large")) << name;
    }
    EXPECT_EQ(names_in(folder.path()), Names{"ffmpeg"});
}

TEST_F(Videos, TheTemporaryFileOfAKilledRunIsRemoved) {
    put(folder / ".oiler-4194305-0.tmp", "half");  // Linux has no process of that number
    put(folder / ".oiler-mine", "mine");
    write(folder / "a.gif", 2);
    EXPECT_EQ(names_in(folder.path()), (Names{".oiler-mine", "a.gif"}));
}

// Two videos may be written into one folder at the same time.
TEST_F(Videos, TheTemporaryFileOfARunningVideoStays) {
    Video first(folder / "a.gif", size, 25);
    first.add(frame(1));
    write(folder / "b.gif", 2);
    first.finish();
    EXPECT_EQ(names_in(folder.path()), (Names{"a.gif", "b.gif"}));
}

}  // namespace
}  // namespace oiler::test
