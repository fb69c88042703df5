// SPDX-License-Identifier: MIT
// The program that a menu starts ends with the menu.
#include "oiler/cli/startable.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "oiler/process/interrupt.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using cli::run_and_wait;
using cli::Startable;

Startable shell(const std::string& script) {
    return {.name = "shell", .sentence = "", .command = {"/bin/sh", "-c", script}};
}

/// The next byte of a pipe; empty at its end, or after half a minute.
std::string read_byte(int pipe) {
    constexpr int milliseconds = 30'000;
    pollfd readable{.fd = pipe, .events = POLLIN, .revents = 0};
    char byte = 0;
    if (poll(&readable, 1, milliseconds) != 1) return "nothing";
    return read(pipe, &byte, 1) == 1 ? std::string(1, byte) : "";
}

/// Runs in a new process, whose output is the pipe, a program that waits.
pid_t start_menu(int output) {
    const pid_t menu = fork();
    if (menu != 0) return menu;
    Interrupt::handle_signals("menu");
    dup2(output, STDOUT_FILENO);
    close(output);
    _exit(run_and_wait(shell("printf x; exec sleep 60")));
}

class EndOfMenu : public testing::TestWithParam<int> {};

TEST_P(EndOfMenu, EndsWhatItStarted) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t menu = start_menu(ends[1]);
    close(ends[1]);
    ASSERT_EQ(read_byte(ends[0]), "x") << "it does not start";
    ASSERT_EQ(kill(menu, GetParam()), 0);
    EXPECT_EQ(read_byte(ends[0]), "") << "it still runs: its output is open";
    close(ends[0]);
    int status = 0;
    EXPECT_EQ(waitpid(menu, &status, 0), menu);
}
INSTANTIATE_TEST_SUITE_P(Signals, EndOfMenu, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGKILL));

TEST(RunAndWait, ReturnsTheExitCode) {
    EXPECT_EQ(run_and_wait(shell("exit 5")), 5);
    EXPECT_EQ(run_and_wait(shell("kill -9 $$")), 128 + 9);
    EXPECT_EQ(line_of_error(Exit::io,
                            [] {
                                (void)run_and_wait(
                                    {.name = "", .sentence = "", .command = {"/no/such/program"}});
                            }),
              "cannot start /no/such/program: No such file or directory");
}

}  // namespace
}  // namespace oiler::test
