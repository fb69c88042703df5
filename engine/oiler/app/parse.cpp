// SPDX-License-Identifier: MIT
#include "oiler/app/parse.hpp"

#include <algorithm>

namespace oiler {

CLI::Option* add_damping(CLI::App& app, std::string& words) {
    return app
        .add_option("--damping", words,
                    "where a splitting method puts damping: explicitly into its kicks or exactly "
                    "into its drifts; the method's default if not given")
        ->check(CLI::IsMember({"kick", "drift"}))
        ->type_name("NAME");
}

Size parse_size(const std::string& words) {
    constexpr int largest_side = 16384;
    Size size;
    const char* const end = words.data() + words.size();
    const auto width = std::from_chars(words.data(), end, size.width);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.height);
        const bool in_range = std::min(size.width, size.height) >= 1 &&
                              std::max(size.width, size.height) <= largest_side;
        if (height.ec == std::errc() && height.ptr == end && in_range) return size;
    }
    fail(Exit::usage, "--size {}: give WIDTHxHEIGHT, each from 1 to {}, such as 1280x720", words,
         largest_side);
}

std::string parse(CLI::App& app, int argc, char** argv) {
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
