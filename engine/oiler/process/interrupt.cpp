// SPDX-License-Identifier: MIT
#include "oiler/process/interrupt.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <new>
#include <string>
#include <system_error>

#include "oiler/core/floating_point.hpp"
#include "oiler/process/console.hpp"

namespace oiler {
namespace {

// Global: signal handlers have no argument for these.
std::atomic<bool> requested_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);
timer_t grace_timer{};
char last_words[128];
std::size_t last_words_size = 0;

void remember(int) {
    const int error_number = errno;
    if (!requested_flag.exchange(true)) {
        const itimerspec once{.it_interval = {}, .it_value = Interrupt::grace};
        if (timer_settime(grace_timer, 0, &once, nullptr) != 0) alarm(1);
    }
    errno = error_number;
}

void end_program(int) {
    // A full pipe would block.
    pollfd standard_error{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (poll(&standard_error, 1, 0) == 1 && standard_error.revents == POLLOUT)
        (void)!write(STDERR_FILENO, last_words, last_words_size);
    _exit(static_cast<int>(Exit::interrupted));
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    // Without SA_RESTART: a blocked system call ends with EINTR.
    action.sa_handler = handler;
    sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    return action.sa_handler == SIG_IGN;
}

struct Ending {
    Exit exit = Exit::done;
    std::string error{};  ///< a line without the program's name; empty: none
};

/// Names of files and options may have line breaks.
std::string one_line(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
}

Ending ending_of(std::string_view name, const std::function<Exit()>& program) {
    try {
        fill_closed_streams();
        Interrupt::handle_signals(name);
        require_ieee_arithmetic();
        return {program()};
    } catch (const Error& error) {
        return {error.exit(), error.what()};
    } catch (const std::bad_alloc&) {
        return {Exit::io, "not enough memory; take fewer bodies or a shorter time"};
    } catch (const std::filesystem::filesystem_error& error) {
        return {Exit::io,
                fmt::format("cannot use {}: {}; choose another place", error.path1().string(),
                            error.code().message())};
    } catch (const std::system_error& error) {
        return {Exit::io, fmt::format("the machine refuses: {}; free some of its resources",
                                      error.code().message())};
    }
}

}  // namespace

void Interrupt::handle_signals(std::string_view name) {
    // A progress bar or the ^C of a terminal may have begun the line.
    const char* const before = isatty(STDERR_FILENO) == 1 ? "\n" : "";
    const auto text =
        fmt::format_to_n(last_words, std::size(last_words),
                         "{}{}: interrupted; unfinished files are not written\n", before, name);
    last_words_size = std::min(text.size, std::size(last_words));
    sigevent by_signal{};
    by_signal.sigev_notify = SIGEV_SIGNAL;
    by_signal.sigev_signo = SIGALRM;
    timer_create(CLOCK_MONOTONIC, &by_signal, &grace_timer);
    handle(SIGALRM, end_program);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!is_ignored(signal)) handle(signal, remember);
    for (const int signal : {SIGPIPE, SIGXFSZ}) handle(signal, SIG_IGN);
}

bool Interrupt::requested() { return requested_flag; }

int guard_main(std::string_view name, const std::function<Exit()>& program) {
    Ending ending = ending_of(name, program);
    if (Interrupt::requested())
        ending = {Exit::interrupted,
                  "interrupted" + (ending.error.empty() ? "" : ": " + ending.error)};
    if (!ending.error.empty()) say(fmt::format("{}: {}", name, one_line(ending.error)));
    return static_cast<int>(ending.exit);
}

}  // namespace oiler
