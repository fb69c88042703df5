// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace oiler {

/// The exit code of a program.
enum class Exit : int {
    done = 0,
    comparison_failed = 1,
    usage = 2,
    no_display = 3,
    io = 4,
    diverged = 5,
    interrupted = 130,
};

/// The type that Oiler throws for errors that a user can mend: in an option, in a file or on
/// the machine. The message is one line with the place, the error and the remedy. `run` and `main`
/// print it and return the exit code. For a programmer's mistakes, see Mistake.
class Error : public std::runtime_error {
public:
    Error(Exit exit, const std::string& line) : std::runtime_error(line), exit_(exit) {}

    [[nodiscard]] Exit exit() const { return exit_; }

private:
    Exit exit_;
};

/// Throws an Error whose line fmt formats.
template <class... Args>
[[noreturn]] void fail(Exit exit, fmt::format_string<Args...> line, Args&&... args) {
    throw Error(exit, fmt::format(line, std::forward<Args>(args)...));
}

/// The exit code after an input could not be opened: usage if the path names no such file, io if
/// the machine is the reason.
[[nodiscard]] Exit exit_of_open(int error_number);

/// The text of an errno value, for example "No space left on device".
[[nodiscard]] std::string system_reason(int error_number);

}  // namespace oiler
