// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <map>

#include "capture/captures.hpp"
#include "oiler/capture/capture_folder.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/team.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace {

enum class Fault { one_rename_fails, all_renames_fail_from_there, process_is_killed };

Fault fault;
int renames_before_fault = -1;  // none if negative
bool has_failed = false;
bool gives_threads = true;

}  // namespace

// These replace the C library's functions in this program.

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) noexcept {
    static const auto create =
        reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
    return gives_threads ? create(thread, attributes, start, argument) : EAGAIN;
}

extern "C" int rename(const char* from, const char* to) noexcept {
    if (renames_before_fault == 0) {
        if (fault == Fault::process_is_killed) _exit(1);
        if (fault == Fault::one_rename_fails) renames_before_fault = -1;
        has_failed = true;
        errno = EIO;
        return -1;
    }
    if (renames_before_fault > 0) --renames_before_fault;
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

namespace oiler::test {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file()) files[entry.path().filename()] = text_of(entry.path());
    return files;
}

/// Replaces the capture in the folder, with the fault after some renames. Returns whether it
/// occurred.
bool replace_with_fault(const fs::path& folder, int renames) {
    const auto replace = [&] {
        CaptureFolder owned(folder, "made up");
        renames_before_fault = renames;
        owned.replace();
    };
    if (fault == Fault::process_is_killed) {
        const pid_t child = fork();
        if (child == 0) {
            replace();
            _exit(0);
        }
        int status = -1;
        waitpid(child, &status, 0);
        return status != 0;
    }
    has_failed = false;
    try {
        replace();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::io);
    }
    renames_before_fault = -1;
    return has_failed;
}

bool is_of(const fs::path& folder, const std::map<std::string, std::string>& capture) {
    auto files = files_in(folder);
    files.erase(".oiler-capture");
    return files == capture;
}

bool is_called_whole(const fs::path& folder) {
    try {
        require_whole(folder);
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::io);
        return false;
    }
}

class Replacement : public testing::TestWithParam<Fault> {};

TEST_P(Replacement, KeepsBothCapturesWhereverItStops) {
    fault = GetParam();
    int renames = 0;
    for (bool occurred = true; occurred; ++renames) {
        const Folder folder;
        const fs::path golden = folder.path() / "golden";
        write(film_of(3), golden);
        const auto before = files_in(golden);
        write(film_of(2), folder_of_new(golden));
        const auto after = files_in(folder_of_new(golden));
        occurred = replace_with_fault(golden, renames);
        if (occurred && fault == Fault::one_rename_fails) {
            EXPECT_EQ(files_in(golden), before);
        }
        const bool is_whole = is_of(golden, before) || is_of(golden, after);
        EXPECT_TRUE(is_whole || !is_called_whole(golden)) << renames;
        EXPECT_TRUE(occurred || is_called_whole(golden)) << renames;
        const CaptureFolder next(golden, "made up");
        auto files = files_in(golden);
        files.erase(".oiler-capture");
        EXPECT_EQ(files, occurred ? before : after) << renames;
        if (occurred) {
            EXPECT_EQ(files_in(folder_of_new(golden)), after) << renames;
        }
        EXPECT_FALSE(fs::exists(golden / ".oiler-old")) << renames;
    }
    EXPECT_EQ(renames, 5 + 4 + 1);  // each file once
}

TEST(UsersFolder, IsNotTakenForThatOfAReplacement) {
    for (const char* name : {".oiler-old", ".oiler-back"}) {
        const Folder folder;
        const fs::path golden = folder.path() / "golden";
        write(film_of(3), golden);
        write(film_of(2), golden / name);
        const auto before = files_in(golden / name);
        EXPECT_TRUE(holds(line_of_error(Exit::io, [&] { CaptureFolder(golden, "made up"); }),
                          "is not from Oiler; rename it"));
        EXPECT_EQ(files_in(golden / name), before) << name;
        require_whole(golden);
    }
}

TEST(LinkedReplacement, FollowsNoLinkToAnotherCapture) {
    for (const char* name : {".oiler-new", ".oiler-old", ".oiler-back"}) {
        const Folder folder;
        const fs::path golden = folder.path() / "golden";
        const fs::path other = folder.path() / "other";
        write(film_of(3), golden);
        write(film_of(2), other);
        const auto before = files_in(other);
        fs::create_directory_symlink(other, golden / name);
        EXPECT_TRUE(holds(line_of_error(Exit::io, [&] { CaptureFolder(golden, "made up"); }),
                          "is a link; remove it"));
        EXPECT_EQ(files_in(other), before) << name;
    }
}

// The second process is killed while it puts the earlier files back.
TEST(KilledReplacement, IsUndoneHoweverOftenItIsKilled) {
    fault = Fault::process_is_killed;
    for (int first = 1; first < 9; ++first)
        for (int second = 0; second < 10; ++second) {
            const Folder folder;
            const fs::path golden = folder.path() / "golden";
            write(film_of(3), golden);
            const auto before = files_in(golden);
            write(film_of(2), folder_of_new(golden));
            EXPECT_TRUE(replace_with_fault(golden, first));
            const pid_t child = fork();
            if (child == 0) {
                renames_before_fault = second;
                const CaptureFolder killed(golden, "made up");
                _exit(0);
            }
            waitpid(child, nullptr, 0);
            const CaptureFolder next(golden, "made up");
            auto files = files_in(golden);
            files.erase(".oiler-capture");
            EXPECT_EQ(files, before) << first << ' ' << second;
        }
}

TEST_P(Replacement, OfNothingIsMadeAgainWhereverItStopped) {
    fault = GetParam();
    for (int renames = 0; renames < 4; ++renames) {
        const Folder folder;
        const fs::path golden = folder.path() / "golden";
        write(film_of(2), folder_of_new(golden));
        const auto after = files_in(folder_of_new(golden));
        EXPECT_TRUE(replace_with_fault(golden, renames));
        CaptureFolder next(golden, "made up");
        next.replace();
        auto files = files_in(golden);
        files.erase(".oiler-capture");
        EXPECT_EQ(files, after) << renames;
    }
}

TEST(Capture, WritesTheSameFilesIfTheMachineGivesNoThread) {
    const Folder folder;
    write(film_of(20), folder / "threads");
    gives_threads = false;
    write(film_of(20), folder / "none");
    const Team team(3, false);
    gives_threads = true;
    EXPECT_EQ(files_in(folder / "none"), files_in(folder / "threads"));
    EXPECT_EQ(team.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Faults, Replacement,
                         testing::Values(Fault::one_rename_fails,
                                         Fault::all_renames_fail_from_there,
                                         Fault::process_is_killed));

}  // namespace
}  // namespace oiler::test
