// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <ctime>
#include <functional>
#include <string_view>

#include "oiler/core/error.hpp"

namespace oiler {

/// The signals and the time limit that end a program. SIGINT (Ctrl-C), SIGTERM and SIGHUP set a
/// flag, and the program ends where it polls the flag, with complete files. A program that has not
/// ended after `grace` is ended with Exit::interrupted: it computes without polling, or a system
/// call blocks. A time limit ends a program in the same way, with Exit::io. Signals that the parent
/// ignores, as nohup ignores SIGHUP, stay ignored. SIGPIPE and SIGXFSZ are ignored, so that a
/// closed pipe and a limit of file size are write errors.
class Interrupt {
public:
    static constexpr std::timespec grace{.tv_sec = 0, .tv_nsec = 700'000'000};

    /// Sets the handlers for the rest of the process: a second signal may arrive while it exits.
    /// `name` starts the line on standard error of a program that is ended after `grace`.
    static void handle_signals(std::string_view name);

    /// Ends the program after so many seconds from now; at once for 0. Call it once.
    static void set_time_limit(double seconds);

    [[nodiscard]] static bool requested();
    /// Whether the time limit came first.
    [[nodiscard]] static bool by_time_limit();
    /// "interrupted" or "the time limit is reached".
    [[nodiscard]] static std::string_view reason();
};

/// Runs the program of a main function and returns its exit code. An Error becomes a line on
/// standard error that starts with `name`. An interrupted program prints one, too, and its exit
/// code is Exit::interrupted or Exit::io whatever `program` returns: see Interrupt.
int guard_main(std::string_view name, const std::function<Exit()>& program);

}  // namespace oiler
