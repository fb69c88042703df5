// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "oiler/core/error.hpp"

namespace oiler::cli {

class Arguments;

/// The texts of a command in `oiler --help` and `oiler COMMAND --help`.
struct CommandTexts {
    std::string_view name;
    std::string_view summary;
    std::string_view example;  ///< a command line without "oiler NAME"
    std::string_view notes{};  ///< lines below the example
    bool may_take_long = true;  ///< it has --time-limit
};

/// A command of the program `oiler`. All functions throw Error and return the exit code.
struct Command {
    using Run = std::function<Exit()>;

    CommandTexts texts;
    /// Declares the arguments and returns the function that runs the command with them.
    std::function<Run(Arguments&)> declare;
    /// Replaces `declare` in a command that parses its own arguments; `argv[0]` is its name.
    std::function<Exit(int argc, char** argv)> parse_and_run{};
};

/// Returns the command of a class that declares one: see arguments.hpp. Each command's file
/// instantiates this template for its own class, so that no header lists the classes.
template <class Declared>
[[nodiscard]] Command make_command();

/// Runs the command that the command line names, or prints its help.
[[nodiscard]] Exit run_command(const std::vector<Command>& commands, int argc, char** argv);

}  // namespace oiler::cli
