// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace oiler {

/// What a program tells the shell that started it.
enum class Exit : int {
    done = 0,
    comparison_failed = 1,
    usage = 2,
    no_display = 3,
    io = 4,
    diverged = 5,
    interrupted = 130,
};

/// The one thing that Oiler throws for what a user can mend: an option, a file, a machine. Its
/// message is one line that says what is wrong, where, and what to do about it; `run` and `main`
/// print it and leave with the exit code. Mistakes of the programmer assert instead.
class Error : public std::runtime_error {
public:
    Error(Exit exit, const std::string& line) : std::runtime_error(line), exit_(exit) {}

    [[nodiscard]] Exit exit() const { return exit_; }

private:
    Exit exit_;
};

/// Throws an Error with a line formatted as by fmt.
template <class... Args>
[[noreturn]] void fail(Exit exit, fmt::format_string<Args...> line, Args&&... args) {
    throw Error(exit, fmt::format(line, std::forward<Args>(args)...));
}

/// errno as text, "No space left on device".
[[nodiscard]] std::string system_reason(int error_number);

}  // namespace oiler
