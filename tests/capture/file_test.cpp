// SPDX-License-Identifier: MIT
#include "oiler/capture/file.hpp"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <functional>

#include "oiler/core/markup.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

std::string io_error_of(const std::function<void()>& action) {
    return line_of_error(Exit::io, action);
}

/// Runs tests in a child process, whose limits and signals die with it. A test that fails in it
/// fails.
void in_child(const std::function<void()>& tests) {
    const pid_t child = fork();
    if (child == 0) {
        EXPECT_NO_THROW(tests());
        std::fflush(stdout);
        _exit(testing::Test::HasFailure() ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

unsigned permissions_of(const fs::path& path) {
    return static_cast<unsigned>(fs::status(path).permissions());
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

// Names of all files, also hidden ones, while a file is written and after a kill.
TEST(File, AKilledRunLeavesNothing) {
    const Folder folder;
    const pid_t child = fork();
    if (child == 0) {
        File file(folder / "a");
        file.write(std::string(1 << 20, 'x'));
        raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    if (!names_in(folder.path()).empty()) {
        const int unnamed = open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
        if (unnamed < 0) GTEST_SKIP() << "this file system has no files without names";
        close(unnamed);
    }
    EXPECT_EQ(names_in(folder.path()), Names{});
}

/// Lets the system calls `numbers` fail with `error_number` from now on if their argument `index`
/// has a bit of `bits`; with no bits, always.
void refuse_calls(const std::vector<unsigned>& numbers, unsigned index, unsigned bits,
                  unsigned error_number) {
    constexpr auto offset = [](std::size_t of) { return static_cast<unsigned>(of); };
    std::vector<sock_filter> filter;
    for (const unsigned number : numbers) {
        filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset(offsetof(seccomp_data, nr))));
        filter.push_back(
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, static_cast<__u8>(bits == 0 ? 1 : 3)));
        if (bits != 0) {
            filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS,
                                      offset(offsetof(seccomp_data, args)) + 8 * index));
            filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, 1));
        }
        filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error_number));
    }
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    ASSERT_EQ(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), 0);
    ASSERT_EQ(prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program), 0);
}

/// Writes files where only named temporary files are possible.
void expect_named_temporary_files() {
    const Folder folder;
    const mode_t before = umask(027);
    {
        File dropped(folder / "b");
        File file(folder / "a");
        file.write("new");
        EXPECT_EQ(names_in(folder.path()).size(), 2U);
        file.commit();
    }
    EXPECT_EQ(permissions_of(folder / "a"), 0640U);
    fs::permissions(folder / "a", fs::perms{0600});
    write_file(folder / "a", bytes_of("newer"));
    umask(before);
    EXPECT_EQ(text_of(folder / "a"), "newer");
    EXPECT_EQ(permissions_of(folder / "a"), 0600U);
    EXPECT_EQ(names_in(folder.path()), Names{"a"});
}

TEST(File, HasATemporaryNameWhereFilesNeedNames) {
    // The bit that O_TMPFILE has besides O_DIRECTORY.
    constexpr unsigned tmpfile = O_TMPFILE & ~O_DIRECTORY;
    in_child([] {
        refuse_calls({SYS_openat}, 2, tmpfile, EOPNOTSUPP);
        expect_named_temporary_files();
    });
}

TEST(File, HasATemporaryNameWithoutProc) {
    in_child([] {
        std::vector<unsigned> calls{SYS_faccessat, 439 /* faccessat2 */};
#ifdef SYS_access  // an older call, which ARM64 lacks
        calls.push_back(SYS_access);
#endif
        refuse_calls(calls, 0, 0, ENOENT);
        expect_named_temporary_files();
    });
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

TEST(File, ALoopOfLinksIsNamed) {
    const Folder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    const std::string line = io_error_of([&] { File(folder / "a"); });
    EXPECT_TRUE(holds(line, "Too many levels of symbolic links; remove the loop")) << line;
}

TEST(File, ALinkToNothingIsNamed) {
    const Folder folder;
    for (const char* target : {"missing", "missing/too"}) {
        fs::create_symlink(target, folder / "link");
        const std::string line = io_error_of([&] { File(folder / "link"); });
        EXPECT_TRUE(holds(line, "it is a link to nothing; remove it, or choose another place"))
            << target;
        EXPECT_TRUE(fs::is_symlink(folder / "link"));
        EXPECT_FALSE(fs::exists(folder / "missing"));
        fs::remove(folder / "link");
    }
}

TEST(File, KeepsASymbolicLinkAndWritesItsTarget) {
    const Folder folder;
    put(folder / "real", "old");
    fs::create_symlink("real", folder / "link");
    write_file(folder / "link", bytes_of("new"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(text_of(folder / "real"), "new");
}

// Names within an output folder are Oiler's: a link there must not lead to another file.
TEST(File, ReplacesASymbolicLinkWhenAsked) {
    const Folder folder;
    put(folder / "victim", "old");
    fs::permissions(folder / "victim", fs::perms{0600});
    for (const char* const target : {"victim", "nothing", "/dev/null"}) {
        fs::create_symlink(target, folder / "link");
        write_file(folder / "link", bytes_of("new"), kinds::any, Links::replaced);
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "link"))) << target;
        EXPECT_EQ(text_of(folder / "link"), "new") << target;
        EXPECT_EQ(text_of(folder / "victim"), "old") << target;
        EXPECT_NE(permissions_of(folder / "link"), 0600U);
        fs::remove(folder / "link");
    }
    EXPECT_EQ(names_in(folder.path()), Names{"victim"});
}

TEST(File, ReplacesAPipeButNoFolderWhenAsked) {
    const Folder folder;
    ASSERT_EQ(mkfifo((folder / "a").c_str(), 0600), 0);
    const int reader = open((folder / "a").c_str(), O_RDONLY | O_NONBLOCK);
    write_file(folder / "a", bytes_of("new"), kinds::any, Links::replaced);
    close(reader);
    ASSERT_TRUE(fs::is_regular_file(folder / "a"));
    EXPECT_EQ(text_of(folder / "a"), "new");
    EXPECT_TRUE(holds(io_error_of([&] { File(folder.path(), kinds::any, Links::replaced); }),
                      "Is a directory"));
    EXPECT_TRUE(holds(io_error_of([&] { File(folder / "new/", kinds::any, Links::replaced); }),
                      "Is a directory"));
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

// A signal ends the wait for a pipe only if the pipe has taken no byte of the write. It takes up to
// PIPE_BUF bytes completely or not at all. A socket of packets shows the size of a write.
TEST(File, WritesNoMoreThanAPipeTakesCompletely) {
    int ends[2] = {};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
    std::fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    dup2(ends[0], STDOUT_FILENO);
    File file("-");
    dup2(saved, STDOUT_FILENO);
    file.write(std::string(3 * PIPE_BUF, 'x'));
    file.commit();
    std::string packet(4 * PIPE_BUF, ' ');
    EXPECT_LE(read(ends[1], packet.data(), packet.size()), PIPE_BUF);
    for (const int descriptor : {saved, ends[0], ends[1]}) close(descriptor);
}

// A reader that never comes, and one that never reads.
TEST(File, AnInterruptedWaitForAPipeIsAnInterruption) {
    const Folder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    in_child([&] {
        struct sigaction action {};
        action.sa_handler = [](int) {};
        sigaction(SIGALRM, &action, nullptr);  // without SA_RESTART
        ualarm(50'000, 50'000);
        EXPECT_EQ(line_of_error(Exit::interrupted, [&] { File file(pipe); }),
                  pipe.string() + ": waited for a reader; start the reader first");
        const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
        ASSERT_GE(reader, 0);
        EXPECT_EQ(
            line_of_error(Exit::interrupted,
                          [&] { write_file(pipe, bytes_of(std::string(1 << 22, 'x'))); }),
            pipe.string() + ": waited for its reader and is incomplete; run the command again");
        alarm(0);
    });
}

TEST(File, ALimitOfItsSizeIsAnErrorWithARemedy) {
    const Folder folder;
    put(folder / "a", "old");
    in_child([&] {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1 << 16, 1 << 16};
        setrlimit(RLIMIT_FSIZE, &limit);
        EXPECT_EQ(
            io_error_of([&] { write_file(folder / "a", bytes_of(std::string(1 << 20, 'x'))); }),
            "cannot write " + (folder / "a").string() +
                ": File too large; raise the limit of `ulimit -f`, or write less");
    });
    EXPECT_EQ(text_of(folder / "a"), "old");
    EXPECT_EQ(names_in(folder.path()), Names{"a"});
}

// A failed sync leaves the old file, so the sync comes before the name. The frames of a capture
// replace nothing and are not synced, which would take longer than encoding them.
TEST(File, IsOnTheDiskBeforeItReplacesAnother) {
    const Folder folder;
    put(folder / "a", "old");
    write_file(folder / "a", "new");
    EXPECT_EQ(text_of(folder / "a"), "new");
    in_child([&] {
        refuse_calls({SYS_fsync, SYS_fdatasync}, 0, 0, EIO);
        EXPECT_TRUE(
            holds(io_error_of([&] { write_file(folder / "a", "newer"); }), "Input/output error"));
        File published(folder / "a");
        published.write("newer");
        published.publish();
        EXPECT_TRUE(holds(io_error_of([&] { published.commit(); }), "Input/output error"));
        write_file(folder / "b", "new");
    });
    EXPECT_EQ(text_of(folder / "a"), "new");
    EXPECT_EQ(text_of(folder / "b"), "new");
    EXPECT_EQ(names_in(folder.path()), (Names{"a", "b"}));
}

TEST(File, ReplacesOnlyItsKind) {
    const Folder folder;
    const FileKind kind{"a letter", "Dear ?,|Hello"};
    for (const char* old : {"", "Dear A, thanks", "Dear B,", "Hello"}) {
        put(folder / "a", old);
        write_file(folder / "a", "Hello, you", kind);
        EXPECT_EQ(text_of(folder / "a"), "Hello, you") << old;
    }
    for (const char* old : {"D", "Dear AB,", "hello", "Hell", "\n", " Hello"}) {
        put(folder / "a", old);
        fs::create_symlink("a", folder / "link");
        for (const char* name : {"a", "link"})
            EXPECT_EQ(
                line_of_error(Exit::usage, [&] { write_file(folder / name, "Hello, you", kind); }),
                (folder / name).string() +
                    " is not a letter and would be lost; remove it or "
                    "choose another path");
        EXPECT_EQ(text_of(folder / "a"), old);
        fs::remove(folder / "link");
    }
    EXPECT_EQ(names_in(folder.path()), Names{"a"});
}

void expect_replaceable(const FileKind& kind, const std::vector<std::string>& texts,
                        bool expected) {
    const Folder folder;
    for (const std::string& text : texts) {
        put(folder / "a", text);
        EXPECT_EQ(is_replaceable(folder / "a", kind), expected) << text.substr(0, 300);
    }
}

TEST(FileKind, OfJsonIsThatOfOiler) {
    const std::string run = "{\n  \"scene\": \"a, b\",\n  \"method\": \"rk4\"\n}\n";
    expect_replaceable(kinds::json,
                       {run, "{\n  \"meets\": true,\n  \"why\": \"\"}", "",
                        "[\n  {\n    \"scene\": \"s.toml\",\n    \"kept\": null\n  }\n]\n"},
                       true);
    expect_replaceable(kinds::json,
                       {"{\n  \"name\": \"my-app\",\n  \"version\": \"1.0.0\"}", "{}", "[]",
                        "[\n  {\n", "{\n  \"scene\": \"level 1\",\n  \"enemies\": []}",
                        "{\"scene\": \"a\", \"method\": \"b\"}", "{\n  \"scene\": \"a\"\n}\n",
                        "[scene]\n", "{\\rtf1 text}", "{% extends \"base\" %}\n",
                        "{\n  \"scene\": \"a\",\n  \"mine\": 1,\n  \"method\": \"b\"\n}\n"},
                       false);
    for (const std::string& after :
         {std::string("important text\n"), run, std::string("\0mine", 5)})
        expect_replaceable(kinds::json, {run + after}, false);
    for (std::size_t size = 1; size + 1 < run.size(); ++size)
        expect_replaceable(kinds::json, {run.substr(0, size)}, false);
    expect_replaceable(kinds::sweep, {"{\n \"oiler\": \"1\"\n}\n"}, true);
    expect_replaceable(kinds::sweep, {"{\n \"oiler\": \"1\"\n}\nmine\n"}, false);
}

TEST(FileKind, OfATraceHasNumbersOnly) {
    const std::string names = "tick,time,body,x,vx\n";
    const std::string row = "12,0.2,0,-1e-300,5\n";
    std::string many = names;
    for (int i = 0; i < 10'000; ++i) many += row;
    expect_replaceable(
        kinds::trace,
        {names, names + row, names + row + row, many, "tick,time,body,x,y,vx,vy\n0,0,0,1,2,3,4\n",
         "tick,time,body,x,y,z,vx,vy,vz\n0,0,0,1,2,3,4,5,6\n"},
        true);
    for (const char* mine : {"important text\n", "12,0.2,0,1\n", "12,0.2,0,1,5,6\n", "a,b,c,d,e\n",
                             "12,0.2,0,1,\n", "12,0.2,0,1,5m\n", "\n", "12,0.2,0,1,5"})
        expect_replaceable(kinds::trace,
                           {names + mine, names + row + mine, many + mine,
                            names + mine + many.substr(names.size())},
                           false);
    expect_replaceable(kinds::trace, {"tick,time,body,x,vx,notes\n", "tick,time,body,x\n"}, false);
}

TEST(FileKind, OfATableHasItsColumns) {
    const std::string energy = "tick,time,kinetic,potential,total";
    expect_replaceable(kinds::energy, {energy + "\n0,0,1,2,3\n"}, true);
    expect_replaceable(
        kinds::energy,
        {energy + ",notes\n", energy, energy + "\n0,0,1,2,3,mine\n", energy + "\n0,0,1,2,mine\n"},
        false);
    const std::string map =
        "method,damping,omega_dt,zeta,spectral_radius,stable,bounded_double,bounded_float\n";
    expect_replaceable(kinds::table,
                       {map, map + "rk4,kick,0.02,0,1,1,1,1\n", map + "rk4,kick,0.02,0,,1,1,1\n"},
                       true);
    expect_replaceable(
        kinds::table,
        {"method,damping,mine\n", map + "important text\n", map + "my notes,kick,0.02,0,1,1,1,1\n"},
        false);
}

TEST(FileKind, OfJunitIsThatOfOilerAsAWhole) {
    JunitSuite suite("a <suite>");
    suite.add("a", "b", JunitSuite::Outcome::failed, "</testsuite>");
    expect_replaceable(kinds::junit, {suite.xml()}, true);
    expect_replaceable(kinds::junit,
                       {"<?xml version=\"1.0\"?>\nnot xml at all", "<testsuite/>\ntext after",
                        suite.xml() + "text after", "text" + suite.xml(),
                        suite.xml().substr(0, suite.xml().size() - 2)},
                       false);
}

TEST(FileKind, OfAPageHasNothingAfterIt) {
    for (const FileKind* kind : {&kinds::report, &kinds::differences}) {
        const std::string page = std::string(kind->beginnings) + " -->\n<html>\n</html>\n";
        expect_replaceable(*kind, {page}, true);
        expect_replaceable(*kind, {page + "mine\n"}, false);
    }
}

TEST(FileKind, OfAFileThatMayNotBeReadIsUnknown) {
    const Folder folder;
    fs::permissions(folder.path(), fs::perms{0755});
    put(folder / "a", "mine");
    fs::permissions(folder / "a", fs::perms::none);
    const bool is_root = geteuid() == 0;
    if (is_root) {
        ASSERT_EQ(seteuid(65534), 0);
    }
    const std::string line =
        line_of_error(Exit::io, [&] { (void)is_replaceable(folder / "a", kinds::json); });
    if (is_root) {
        ASSERT_EQ(seteuid(0), 0);
    }
    EXPECT_TRUE(holds(line, "cannot read " + (folder / "a").string()));
}

TEST(File, OfAKindIsWrittenToDevices) {
    write_file("/dev/null", "data", kinds::json);
    require_replaceable("/dev/zero", kinds::json);
}

TEST(RequireWritable, RefusesAFileThatIsReadOnlyForAll) {
    const Folder folder;
    put(folder / "a", "old");
    require_writable(folder / "a");
    require_writable(folder / "missing");
    fs::permissions(folder / "a", fs::perms{0444});
    EXPECT_EQ(
        io_error_of([&] { require_writable(folder / "a"); }),
        "cannot write " + (folder / "a").string() + ": it is read-only; allow it with `chmod u+w`");
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
    EXPECT_TRUE(holds(io_error_of([&] { File(folder / "file/a"); }), "Not a directory"));
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
    EXPECT_TRUE(holds(io_error_of([] { make_folder("/proc/none"); }), "cannot make the folder"));
}

}  // namespace
}  // namespace oiler::test
