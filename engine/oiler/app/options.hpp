// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "oiler/app/game.hpp"
#include "oiler/core/size.hpp"
#include "oiler/platform/surface.hpp"

namespace oiler {

/// How a run goes, besides what the game itself is told.
struct Options {
    Settings settings;
    bool headless = false;
    Offscreen offscreen = Offscreen::automatic;
    std::optional<std::int64_t> frames;
    std::optional<int> fps;
    Size size{1280, 720};
    std::filesystem::path out;
    std::optional<std::int64_t> steps;  ///< nothing is drawn
    std::filesystem::path trace;        ///< empty: none, as for the other files
    std::filesystem::path energy;
    std::filesystem::path json;
    bool quiet = false;
};

/// Either options, or the text that --help or --version asks for.
struct CommandLine {
    Options options;
    std::string text;
    About about;  ///< of the game, or of the scene in the file
};

/// What a scene file says of itself; its texts outlive the command line.
using AboutFile = std::function<About(const std::string& path)>;

/// Throws Error{usage} that names the option and what it takes.
[[nodiscard]] CommandLine parse_command_line(int argc, char** argv, const About& about);

/// The same of a program `about` that plays the scene file which it is given, as the file says
/// unless the command line says otherwise.
[[nodiscard]] CommandLine parse_command_line(int argc, char** argv, const About& about,
                                             const AboutFile& about_file);

}  // namespace oiler
