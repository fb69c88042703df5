// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/nearest.hpp"
#include "oiler/core/read_number.hpp"

namespace oiler {

// Options that all command lines share. Few files include this header, because CLI11 compiles
// slowly.

/// Adds an option for a whole number from `low` to `high` in decimal digits: 010 is ten, not octal,
/// and 1e3 is refused.
template <class Whole, class Target>
CLI::Option* add_whole(CLI::App& app, const std::string& name, Target& target, Whole low,
                       Whole high, const std::string& help) {
    const auto parse = [=, &target](const std::string& words) {
        const char* const end = words.data() + words.size();
        Whole value = 0;
        const auto [last, error] = read_number(words.data(), end, value);
        if (error != std::errc() || last != end || value < low || value > high)
            throw CLI::ValidationError(
                fmt::format("{} {}: give a whole number from {} to {}", name, words, low, high));
        target = value;
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("N");
}

/// Adds an option for a number of seconds, 0 or more.
inline CLI::Option* add_seconds(CLI::App& app, const std::string& name,
                                std::optional<double>& target, const std::string& help) {
    const auto parse = [name, &target](const std::string& words) {
        const char* const end = words.data() + words.size();
        double value = 0;
        const auto [last, error] = read_number(words.data(), end, value);
        if (error != std::errc() || last != end || !(value >= 0) || !std::isfinite(value))
            throw CLI::ValidationError(
                fmt::format("{} {}: give a number of seconds, such as 60", name, words));
        target = value;
    };
    return app.add_option_function<std::string>(name, parse, help)->type_name("S");
}
inline constexpr const char* help_of_time_limit =
    "end after S seconds of real time, with exit code 4; unfinished results are missing";

/// The help of `--damping`, which is "kick" or "drift".
inline constexpr const char* help_of_damping =
    "where a splitting method puts damping: explicitly into its kicks or exactly into its drifts; "
    "the method's default if not given";
inline CLI::Option* add_damping(CLI::App& app, std::string& words) {
    return app.add_option("--damping", words, help_of_damping)
        ->check(CLI::IsMember({"kick", "drift"}))
        ->type_name("NAME");
}

/// The subcommand that the command line names, else the program.
[[nodiscard]] inline const CLI::App& named_command(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

/// "oiler play".
[[nodiscard]] inline std::string full_name(const CLI::App& app) {
    const CLI::App* const parent = app.get_parent();
    return parent ? parent->get_name() + " " + app.get_name() : app.get_name();
}

/// The message for the first word that no option and no command expects.
[[nodiscard]] inline std::string describe_extra(const CLI::App& app) {
    const std::string given = app.remaining(true).front();
    const CLI::App& command = named_command(app);
    const std::string word = given.substr(0, given.find('='));
    const bool is_option = word.starts_with("-");
    std::vector<std::string> names;
    if (is_option)
        for (const CLI::Option* const option : command.get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    else
        for (const CLI::App* const one : command.get_subcommands({}))
            names.push_back(one->get_name());
    const std::vector<std::string_view> views(names.begin(), names.end());
    const char* const kind = is_option       ? "no such option"
                             : names.empty() ? "unexpected argument"
                                             : "no such command";
    return fmt::format("{}: {}{}", word, kind, did_you_mean(word, views));
}

[[nodiscard]] inline std::string describe(const CLI::ParseError& error) {
    std::string text = error.what();
    for (const std::string_view repeated :
         {"At Most 1 required but received ", "At most 1 required but received "})
        if (const std::size_t at = text.find(repeated); at != text.npos)
            return text.replace(at, repeated.size(), "given ") + " times; give it once";
    return text;
}

/// Newer versions of CLI11 break lines and indent names, unless they are told not to, and leave
/// lines empty.
template <class Formatter>
void keep_lines(Formatter& formatter) {
    if constexpr (requires { formatter.right_column_width(1); }) {
        constexpr std::size_t wide = 1000;
        formatter.right_column_width(wide);
        formatter.description_paragraph_width(wide);
        formatter.footer_paragraph_width(wide);
        formatter.long_option_alignment_ratio(2.0F / 30);
    }
}

/// The help of the command, with one end of line at its end.
[[nodiscard]] inline std::string help_of(const CLI::App& app) {
    keep_lines(*app.get_formatter());
    std::string text = app.help();
    for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != text.npos;) text.erase(at, 2);
    return text.substr(0, text.find_last_not_of('\n') + 1) + "\n";
}

/// Parses the command line. Returns the text of --help or --version, else an empty text. Throws
/// Error{usage} in one line that ends with "(see PROGRAM COMMAND --help)".
[[nodiscard]] inline std::string parse(CLI::App& app, int argc, char** argv) {
    const auto refuse = [&app](const std::string& what) {
        fail(Exit::usage, "{} (see {} --help)", what, full_name(named_command(app)));
    };
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return help_of(app);
    } catch (const CLI::CallForVersion&) {
        return app.version() + "\n";
    } catch (const CLI::ExtrasError&) {
        refuse(describe_extra(app));
    } catch (const CLI::ParseError& error) {
        refuse(describe(error));
    }
    return {};
}

}  // namespace oiler
