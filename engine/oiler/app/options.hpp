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

/// Options of a run. `settings` are passed to the game.
struct Options {
    Settings settings;
    bool headless = false;
    Offscreen offscreen = Offscreen::automatic;
    std::optional<std::int64_t> frames;
    std::optional<int> fps;
    Size size{1280, 720};
    std::filesystem::path out;
    std::optional<std::int64_t> steps;  ///< if set, the run draws no frames
    std::filesystem::path trace;        ///< empty: not written, also for `energy` and `json`
    std::filesystem::path energy;
    std::filesystem::path json;
    bool quiet = false;
};

/// Options, or the text of --help or --version.
struct CommandLine {
    Options options;
    std::string text;
    About about;  ///< name and defaults of the game or the scene file
};

/// Reads name and defaults of a scene file. Their texts must outlive the command line.
using AboutFile = std::function<About(const std::string& path)>;

/// Parses the options of a game. Throws Error{usage} with the option and its allowed values.
[[nodiscard]] CommandLine parse_command_line(int argc, char** argv, const About& about);

/// Parses the options of a program `about` that plays a scene file. Settings of the file hold
/// unless the command line gives others. Throws Error{usage} with the option and its allowed
/// values.
[[nodiscard]] CommandLine parse_command_line(int argc, char** argv, const About& about,
                                             const AboutFile& about_file);

}  // namespace oiler
