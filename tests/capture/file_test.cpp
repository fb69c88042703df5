// SPDX-License-Identifier: MIT
#include "oiler/capture/file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <functional>
#include <memory>

#include "oiler/core/error.hpp"
#include "support/folder.hpp"

namespace {

namespace fs = std::filesystem;
using oiler::Error;
using oiler::Exit;
using oiler::File;
using oiler::make_folder;
using oiler::write_file;
using oiler::test::Folder;
using oiler::test::names_in;
using oiler::test::put;
using oiler::test::text_of;
using Names = std::vector<std::string>;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

std::string io_error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::io);
        return error.what();
    }
    ADD_FAILURE() << "nothing thrown";
    return {};
}

TEST(File, HasItsNameOnlyOnceCommitted) {
    const Folder folder;
    File file(folder / "a.txt");
    file.write("whole ");
    file.write(bytes_of("file"));
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
    file.commit();
    EXPECT_EQ(text_of(folder / "a.txt"), "whole file");
    EXPECT_EQ(names_in(folder.path()), Names{"a.txt"});
}

TEST(File, LeavesNothingWithoutACommit) {
    const Folder folder;
    put(folder / "a.txt", "old");
    {
        File file(folder / "a.txt");
        file.write(std::string(1 << 20, 'x'));
    }
    EXPECT_EQ(text_of(folder / "a.txt"), "old");
    EXPECT_EQ(names_in(folder.path()), Names{"a.txt"});
}

TEST(File, SeveralAtOnceHaveDifferentTemporaryFiles) {
    const Folder folder;
    File a(folder / "a");
    File b(folder / "b");
    a.write("A");
    b.write("B");
    b.commit();
    a.commit();
    EXPECT_EQ(text_of(folder / "a") + text_of(folder / "b"), "AB");
}

TEST(File, OnceCommittedDoesNotTouchTheNextOne) {
    const Folder folder;
    auto first = std::make_unique<File>(folder / "a");
    first->commit();
    File second(folder / "b");
    first.reset();
    second.commit();
    EXPECT_EQ(names_in(folder.path()), (Names{"a", "b"}));
}

unsigned permissions_of(const fs::path& path) {
    return static_cast<unsigned>(fs::status(path).permissions());
}

TEST(File, HasThePermissionsOfAnyNewFile) {
    const Folder folder;
    const mode_t before = umask(027);
    write_file(folder / "a", bytes_of("a"));
    umask(before);
    EXPECT_EQ(permissions_of(folder / "a"), 0640U);
}

// The replacing file is new, and the umask alone would make it 0640.
TEST(File, KeepsThePermissionsOfTheFileThatItReplaces) {
    const Folder folder;
    const mode_t before = umask(027);
    for (const unsigned kept : {0600U, 0755U, 0666U, 0444U}) {
        put(folder / "a", "old");
        fs::permissions(folder / "a", fs::perms{kept});
        write_file(folder / "a", bytes_of("new"));
        EXPECT_EQ(text_of(folder / "a"), "new");
        EXPECT_EQ(permissions_of(folder / "a"), kept);
    }
    umask(before);
}

TEST(File, KeepsThePermissionsOfTheFileThatASymbolicLinkNames) {
    const Folder folder;
    put(folder / "real", "old");
    fs::permissions(folder / "real", fs::perms{0600});
    fs::create_symlink("real", folder / "link");
    write_file(folder / "link", bytes_of("new"));
    EXPECT_EQ(text_of(folder / "real"), "new");
    EXPECT_EQ(permissions_of(folder / "real"), 0600U);
}

TEST(File, KeepsASymbolicLinkAndWritesItsTarget) {
    const Folder folder;
    put(folder / "real", "old");
    fs::create_symlink("real", folder / "link");
    write_file(folder / "link", bytes_of("new"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(text_of(folder / "real"), "new");
}

TEST(File, AcceptsTheLongestNameOfTheFileSystem) {
    const Folder folder;
    const std::string name(255, 'n');
    write_file(folder / name, bytes_of("a"));
    EXPECT_EQ(text_of(folder / name), "a");
}

// Not the machine's /dev/full: if this test fails as root, File would replace it.
TEST(File, AFullDeviceFailsAndStaysADevice) {
    const Folder folder;
    const fs::path full = folder / "full";
    if (mknod(full.c_str(), S_IFCHR | 0600, makedev(1, 7)) != 0 || !std::ofstream(full))
        GTEST_SKIP() << "no permission to make a device";
    for (const std::size_t count : {std::size_t{1}, std::size_t{1} << 20})
        EXPECT_EQ(io_error_of([&] { write_file(full, bytes_of(std::string(count, 'x'))); }),
                  "cannot write " + full.string() +
                      ": No space left on device; free some space or choose another place");
    EXPECT_TRUE(fs::is_character_file(full));
    EXPECT_EQ(names_in(folder.path()), Names{"full"});
}

TEST(File, StandardOutputIsWrittenInPlaceEvenWhenItIsAFile) {
    const Folder folder;
    fs::create_symlink("/proc/self/fd/1", folder / "stdout");
    std::fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    FILE* redirected = fopen((folder / "out").c_str(), "w");
    dup2(fileno(redirected), STDOUT_FILENO);
    std::printf("before ");
    std::fflush(stdout);
    write_file(folder / "stdout", bytes_of("data "));
    std::printf("after");
    std::fflush(stdout);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    fclose(redirected);
    EXPECT_TRUE(fs::is_symlink(folder / "stdout"));
    EXPECT_EQ(text_of(folder / "out"), "before data after");
}

TEST(File, MakesItsFolder) {
    const Folder folder;
    write_file(folder / "new/folder/a", bytes_of("data"));
    EXPECT_EQ(text_of(folder / "new/folder/a"), "data");
}

TEST(File, NamesTheReasonWhyItCannotBeOpened) {
    const Folder folder;
    put(folder / "file", "");
    EXPECT_EQ(
        io_error_of([&] { File{folder.path()}; }),
        "cannot write " + folder.path().string() + ": Is a directory; name a file, not a folder");
    EXPECT_NE(io_error_of([&] { File(folder / "file/a"); }).find("Not a directory"),
              std::string::npos);
}

TEST(File, LeavesNoTemporaryFileIfItCannotBeRenamed) {
    const Folder folder;
    {
        File file(folder / "a");
        fs::create_directory(folder / "a");
        io_error_of([&] { file.commit(); });
    }
    EXPECT_EQ(names_in(folder.path()), Names{"a"});
}

TEST(MakeFolder, MakesParentsAndReturnsWhetherItWasMissing) {
    const Folder folder;
    EXPECT_TRUE(make_folder(folder / "a/b/c"));
    EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
    EXPECT_FALSE(make_folder(folder / "a/b/c"));
    EXPECT_TRUE(make_folder(folder / "d/"));
}

TEST(MakeFolder, NamesTheReasonOfAFailure) {
    const Folder folder;
    put(folder / "file", "");
    for (const char* name : {"file", "file/below"})
        EXPECT_EQ(io_error_of([&] { make_folder(folder / name); }),
                  "cannot make the folder " + (folder / name).string() +
                      ": Not a directory; choose another place");
    EXPECT_NE(io_error_of([] { make_folder("/proc/none"); }).find("cannot make the folder"),
              std::string::npos);
}

}  // namespace
