// SPDX-License-Identifier: MIT
#include "oiler/process/interrupt.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
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
std::atomic<int> ended_by = 0;  ///< the first signal; 0: none
static_assert(std::atomic<int>::is_always_lock_free);
constexpr int limit_signal = SIGVTALRM;
timer_t grace_timer{};
struct LastWords {
    char text[128];
    std::size_t size = 0;
};
LastWords words_after_signal;
LastWords words_after_limit;

constexpr std::string_view interrupted = "interrupted";
constexpr std::string_view limit_reached = "the time limit is reached";

void remember(int signal) {
    const int error_number = errno;
    int none = 0;
    if (ended_by.compare_exchange_strong(none, signal)) {
        const itimerspec once{.it_interval = {}, .it_value = Interrupt::grace};
        if (timer_settime(grace_timer, 0, &once, nullptr) != 0) alarm(1);
    }
    errno = error_number;
}

void end_program(int) {
    // A full pipe would block.
    const bool by_limit = Interrupt::by_time_limit();
    const LastWords& words = by_limit ? words_after_limit : words_after_signal;
    pollfd standard_error{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (poll(&standard_error, 1, 0) == 1 && standard_error.revents == POLLOUT)
        (void)!write(STDERR_FILENO, words.text, words.size);
    _exit(static_cast<int>(by_limit ? Exit::io : Exit::interrupted));
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    // Without SA_RESTART: a blocked system call ends with EINTR.
    action.sa_handler = handler;
    sigaction(signal, &action, nullptr);
}

/// A timer that sends a signal.
bool make_timer(int signal, timer_t& timer) {
    sigevent by_signal{};
    by_signal.sigev_notify = SIGEV_SIGNAL;
    by_signal.sigev_signo = signal;
    return timer_create(CLOCK_MONOTONIC, &by_signal, &timer) == 0;
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
        return {Exit::io, fmt::format("cannot use {}: {}; choose another place",
                                      error.path1().string(), error.code().message())};
    } catch (const std::system_error& error) {
        return {Exit::io, fmt::format("the machine refuses: {}; free some of its resources",
                                      error.code().message())};
    }
}

}  // namespace

void Interrupt::handle_signals(std::string_view name) {
    // A progress bar or the ^C of a terminal may have begun the line.
    const char* const before = isatty(STDERR_FILENO) == 1 ? "\n" : "";
    const auto prepare = [&](LastWords& words, std::string_view reason) {
        const auto text =
            fmt::format_to_n(words.text, std::size(words.text),
                             "{}{}: {}; unfinished files are not written\n", before, name, reason);
        words.size = std::min(text.size, std::size(words.text));
    };
    prepare(words_after_signal, interrupted);
    prepare(words_after_limit, limit_reached);
    (void)make_timer(SIGALRM, grace_timer);
    handle(SIGALRM, end_program);
    handle(limit_signal, remember);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!is_ignored(signal)) handle(signal, remember);
    for (const int signal : {SIGPIPE, SIGXFSZ}) handle(signal, SIG_IGN);
}

void Interrupt::set_time_limit(double seconds) {
    constexpr double longest = 1e9;
    constexpr double shortest = 1e-9;  // a timer of 0 ns never ends
    if (seconds < shortest) {
        std::raise(limit_signal);
        return;
    }
    const double limit = std::min(seconds, longest);
    const double whole = std::floor(limit);
    const itimerspec once{.it_interval = {},
                          .it_value = {.tv_sec = static_cast<std::time_t>(whole),
                                       .tv_nsec = static_cast<long>(1e9 * (limit - whole))}};
    timer_t timer{};
    if (!make_timer(limit_signal, timer) || timer_settime(timer, 0, &once, nullptr) != 0)
        throw std::system_error(errno, std::generic_category());
}

bool Interrupt::requested() { return ended_by != 0; }

bool Interrupt::by_time_limit() { return ended_by == limit_signal; }

std::string_view Interrupt::reason() { return by_time_limit() ? limit_reached : interrupted; }

int guard_main(std::string_view name, const std::function<Exit()>& program) {
    Ending ending = ending_of(name, program);
    if (Interrupt::requested())
        ending = {
            Interrupt::by_time_limit() ? Exit::io : Exit::interrupted,
            std::string(Interrupt::reason()) + (ending.error.empty() ? "" : ": " + ending.error)};
    if (!ending.error.empty()) say(fmt::format("{}: {}", name, one_line(ending.error)));
    return static_cast<int>(ending.exit);
}

}  // namespace oiler
