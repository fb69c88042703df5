// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <functional>
#include <string>
#include <utility>

#include "oiler/core/error.hpp"

namespace oiler {

// Options that all command lines share. Few files include this header, because CLI11 compiles
// slowly.

/// Adds an option for a whole number from `low` to `high` in decimal digits: 010 is ten, not octal,
/// and 1e3 is refused.
template <class Whole>
CLI::Option* add_whole(CLI::App& app, const std::string& name, Whole& target, Whole low, Whole high,
                       const std::string& help) {
    const auto parse = [=, &target](const std::string& words) {
        const char* const end = words.data() + words.size();
        Whole value = 0;
        const auto [last, error] = std::from_chars(words.data(), end, value);
        if (error != std::errc() || last != end || value < low || value > high)
            throw CLI::ValidationError(
                fmt::format("{} {}: give a whole number from {} to {}", name, words, low, high));
        target = value;
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("N");
}

/// Adds `--damping`, "kick" or "drift".
inline CLI::Option* add_damping(CLI::App& app, std::string& words) {
    return app
        .add_option("--damping", words,
                    "where a splitting method puts damping: explicitly into its kicks or exactly "
                    "into its drifts; the method's default if not given")
        ->check(CLI::IsMember({"kick", "drift"}))
        ->type_name("NAME");
}

/// Parses the command line. Returns the text of --help or --version, else an empty text. Throws
/// Error{usage} in one line that ends with "(see PROGRAM --help)".
[[nodiscard]] inline std::string parse(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return app.help();
    } catch (const CLI::CallForVersion&) {
        return app.version() + "\n";
    } catch (const CLI::ParseError& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        fail(Exit::usage, "{} (see {} --help)", what, app.get_name());
    }
    return {};
}

}  // namespace oiler
