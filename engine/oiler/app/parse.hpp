// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>
#include <string>
#include <utility>

#include "oiler/app/parse_size.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

// What all command lines read alike. For the few files that include CLI11, which is slow to
// compile.

/// An option that takes a whole number in decimal digits: a leading 0 is no octal and 1e3 no
/// number.
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

/// `--damping`, in words.
CLI::Option* add_damping(CLI::App& app, std::string& words);

/// Parses; returns the text that --help or --version asks for, else none. Throws Error{usage} in
/// one line that names the program to ask for help.
[[nodiscard]] std::string parse(CLI::App& app, int argc, char** argv);

}  // namespace oiler
