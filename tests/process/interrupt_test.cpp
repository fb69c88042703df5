// SPDX-License-Identifier: MIT
// Stops programs by signals and limits of time.
#include "oiler/process/interrupt.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using testing::ExitedWithCode;

/// A program that does not stop is killed after 20 s of computing time.
void limit_computing() {
    const rlimit limit{20, 20};
    setrlimit(RLIMIT_CPU, &limit);
}
const std::string limited = "ulimit -t 20; ";

[[noreturn]] void compute_forever() {
    limit_computing();
    for (volatile unsigned i = 0;;) i = i + 1;
}

/// Shell: waits until the background program handles SIGTERM, number 15: bit 14 of the mask.
const std::string until_started =
    "until grep -q 'SigCgt:.*[4-7c-f]...$' /proc/$!/status; do sleep 0.01; done; ";

void raise_all() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) raise(signal);
}

TEST(Interrupt, AProgramThatPollsEndsWithALine) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        EXPECT_EXIT(_exit(guard_main("game",
                                     [&] {
                                         EXPECT_FALSE(Interrupt::requested());
                                         raise(signal);
                                         return Interrupt::requested() ? Exit::interrupted
                                                                       : Exit::done;
                                     })),
                    ExitedWithCode(130), "^game: interrupted\n$")
            << signal;
}

TEST(Interrupt, WhateverTheProgramReturnsItWasInterrupted) {
    EXPECT_EXIT(_exit(guard_main("game",
                                 [] {
                                     raise_all();
                                     return Exit::done;
                                 })),
                ExitedWithCode(130), "^game: interrupted\n$");
    EXPECT_EXIT(_exit(guard_main("game",
                                 []() -> Exit {
                                     raise_all();
                                     fail(Exit::io, "cannot write f");
                                 })),
                ExitedWithCode(130), "^game: interrupted: cannot write f\n$");
}

TEST(GuardMain, TellsInALineWhatTheLibraryThrows) {
    const std::string name(300, 'x');
    EXPECT_EXIT(_exit(guard_main("game",
                                 [&] {
                                     (void)std::filesystem::file_size(name);
                                     return Exit::done;
                                 })),
                ExitedWithCode(4),
                "^game: cannot use x+: File name too long; choose another place\n$");
    EXPECT_EXIT(
        _exit(guard_main(
            "game", []() -> Exit { throw std::system_error(EAGAIN, std::generic_category()); })),
        ExitedWithCode(4), "^game: the machine refuses: Resource temporarily unavailable");
}

TEST(Interrupt, AProgramThatDoesNotPollIsEnded) {
    EXPECT_EXIT(guard_main("game",
                           []() -> Exit {
                               raise_all();
                               compute_forever();
                           }),
                ExitedWithCode(130), "^game: interrupted; unfinished files are not written\n$");
}

TEST(TimeLimit, EndsAProgramThatPolls) {
    for (const double seconds : {0.0, 1e-300, 1e-9, 1e-3})
        EXPECT_EXIT(_exit(guard_main("game",
                                     [&] {
                                         limit_computing();
                                         Interrupt::set_time_limit(seconds);
                                         while (!Interrupt::requested()) continue;
                                         EXPECT_TRUE(Interrupt::by_time_limit());
                                         return Exit::done;
                                     })),
                    ExitedWithCode(4), "^game: the time limit is reached\n$")
            << seconds;
}

TEST(TimeLimit, EndsAProgramThatDoesNotPoll) {
    EXPECT_EXIT(guard_main("game",
                           []() -> Exit {
                               Interrupt::set_time_limit(0);
                               compute_forever();
                           }),
                ExitedWithCode(4),
                "^game: the time limit is reached; unfinished files are not written\n$");
}

TEST(TimeLimit, AfterASignalChangesNothing) {
    EXPECT_EXIT(_exit(guard_main("game",
                                 [] {
                                     raise(SIGTERM);
                                     Interrupt::set_time_limit(0);
                                     EXPECT_FALSE(Interrupt::by_time_limit());
                                     return Exit::done;
                                 })),
                ExitedWithCode(130), "^game: interrupted\n$");
}

TEST(TimeLimit, ThatIsNotReachedChangesNothing) {
    EXPECT_EXIT(_exit(guard_main("game",
                                 [] {
                                     Interrupt::set_time_limit(1e300);
                                     return Exit::comparison_failed;
                                 })),
                ExitedWithCode(1), "^$");
}

TEST(TimeLimit, LeavesTheReportOfTheStepsSoFar) {
    const Folder folder;
    const std::string json = (folder / "run.json").string();
    const Outcome run =
        shell(limited + "hello --steps 1000000000000 --time-limit 0.01 --quiet --json " + json, 4);
    EXPECT_EQ(run.err, "hello: the time limit is reached\n");
    EXPECT_TRUE(holds(text_of(json), "\"state_hash\": \""));
    shell(limited + "hello --steps 1000000000000 --time-limit 0 --quiet --json " + json, 4);
    EXPECT_TRUE(holds(text_of(json), "\"steps\": 0,"));
}

TEST(TimeLimit, EndsTheWaitForAPipe) {
    const Folder folder;
    for (const std::string option : {"--replay ", "--script "}) {
        const Outcome run =
            shell("cd " + folder.path().string() +
                      "; rm -f fifo; mkfifo fifo; timeout -s KILL 60 hello --steps 5 "
                      "--quiet --time-limit 0.1 " +
                      option + "fifo",
                  4);
        EXPECT_EQ(
            run.err,
            "hello: the time limit is reached: fifo: waited for data; start its writer first\n");
    }
}

TEST(TimeLimit, IsANumberOfSeconds) {
    for (const std::string words : {"-1", "x", "inf", "nan", "1e999", "5s"}) {
        const Outcome run = shell("hello --steps 1 --time-limit=" + words, 2);
        EXPECT_TRUE(holds(run.err, "give a number of seconds, such as 60")) << run.err;
    }
}

TEST(Interrupt, ASignalAfterTheProgramDoesNotChangeItsEnd) {
    EXPECT_EXIT(
        {
            const int code = guard_main("game", [] { return Exit::usage; });
            raise_all();
            _exit(code);
        },
        ExitedWithCode(2), "^$");
}

TEST(Interrupt, AFullStandardErrorDoesNotKeepItAlive) {
    EXPECT_EXIT(guard_main("game",
                           []() -> Exit {
                               std::array<int, 2> ends{};
                               EXPECT_EQ(pipe(ends.data()), 0);
                               fcntl(ends[1], F_SETFL, O_NONBLOCK);
                               while (write(ends[1], "x", 1) == 1) continue;
                               fcntl(ends[1], F_SETFL, 0);
                               dup2(ends[1], STDERR_FILENO);
                               raise(SIGTERM);
                               compute_forever();
                           }),
                ExitedWithCode(130), "^$");
}

TEST(Interrupt, IgnoredSignalsStayIgnored) {
    EXPECT_EXIT(
        {
            std::signal(SIGHUP, SIG_IGN);
            _exit(guard_main("game", [] {
                raise(SIGHUP);
                return Interrupt::requested() ? Exit::interrupted : Exit::comparison_failed;
            }));
        },
        ExitedWithCode(1), "^$");
}

TEST(Interrupt, APipeThatNobodyReadsIsLeft) {
    const Folder folder;
    for (const std::string path : {"--json ", "--trace ", "--energy "}) {
        const Outcome run = shell("cd " + folder.path().string() +
                                      "; rm -f fifo; mkfifo fifo; hello --steps 5 --quiet " + path +
                                      "fifo & " + until_started + "kill -TERM $!; wait $!",
                                  130);
        EXPECT_TRUE(run.err.starts_with("hello: interrupted")) << run.err;
    }
}

// 10^12 steps take an hour.
TEST(Interrupt, ALongRunWritesItsReportUpToThere) {
    const Folder folder;
    const std::string json = (folder / "run.json").string();
    const Outcome run =
        shell(limited + "hello --steps 1000000000000 --quiet --json " + json + " & " +
                  until_started + "kill -INT $! && kill -HUP $! && kill -TERM $!; wait $!",
              130);
    EXPECT_EQ(run.err, "hello: interrupted\n");
    EXPECT_TRUE(holds(text_of(json), "\"steps\": "));
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"run.json"});
}

TEST(Interrupt, AClosedPipeIsAWriteError) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    close(ends[0]);
    const std::string to_pipe = " >&" + std::to_string(ends[1]);
    for (const std::string line : {"hello --help", "hello --version", "hello --steps 1 --json -"}) {
        const Outcome run = shell(line + to_pipe, 4);
        EXPECT_TRUE(run.err.ends_with("Broken pipe; choose another place\n")) << run.err;
    }
    close(ends[1]);
}

TEST(Interrupt, ALimitOfFileSizeIsAWriteErrorAndLeavesTheRecording) {
    const Folder folder;
    const std::string there = "cd " + folder.path().string() + "; ";
    const Outcome run = shell(
        there + "ulimit -f 16; hello --steps 10000 --quiet --trace t.csv --record play.rec", 4);
    EXPECT_TRUE(holds(run.err, "t.csv: File too large"));
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"play.rec"});
    shell(there + "hello --replay play.rec --headless --png none --quiet", 0);
}

}  // namespace
}  // namespace oiler::test
