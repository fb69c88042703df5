// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <ctime>
#include <functional>
#include <string_view>

#include "oiler/core/error.hpp"

namespace oiler {

/// The signals that end a program. SIGINT (Ctrl-C), SIGTERM and SIGHUP set a flag, and the program
/// ends where it polls the flag, with complete files. A program that has not ended after `grace` is
/// ended with Exit::interrupted: it computes without polling, or a system call blocks. Signals that
/// the parent ignores, as nohup ignores SIGHUP, stay ignored. SIGPIPE and SIGXFSZ are ignored, so
/// that a closed pipe and a limit of file size are write errors.
class Interrupt {
public:
    static constexpr std::timespec grace{.tv_sec = 0, .tv_nsec = 700'000'000};

    /// Sets the handlers for the rest of the process: a second signal may arrive while it exits.
    /// `name` starts the line on standard error of a program that is ended after `grace`.
    static void handle_signals(std::string_view name);

    [[nodiscard]] static bool requested();
};

/// Runs the program of a main function and returns its exit code. An Error becomes a line on
/// standard error that starts with `name`. An interrupted program prints one, too, and its exit
/// code is Exit::interrupted whatever `program` returns: see Interrupt.
int guard_main(std::string_view name, const std::function<Exit()>& program);

}  // namespace oiler
