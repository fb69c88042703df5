// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/capture/manifest.hpp"
#include "oiler/core/size.hpp"
#include "oiler/game/game.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/play/recording.hpp"

namespace oiler {

/// Options of a run. `settings` are passed to the game.
struct Options {
    Settings settings;
    bool headless = false;
    Offscreen offscreen = Offscreen::automatic;
    std::optional<std::int64_t> frames;
    std::optional<int> fps;
    Size size{1280, 720};
    bool has_size = false;  ///< it was given
    std::filesystem::path out;
    bool has_png = true;         ///< false: hashes only
    std::int64_t keyframes = 1;  ///< every so many frames have a PNG
    std::filesystem::path video;
    std::filesystem::path sheet;
    std::filesystem::path golden;  ///< a capture to compare the frames with
    bool update_golden = false;    ///< `out` is then beside the golden
    std::filesystem::path junit;
    std::optional<std::int64_t> frame;  ///< if set, only that frame is drawn
    std::optional<Manifest> from;       ///< the capture whose settings and frame are taken
    std::optional<std::int64_t> steps;  ///< if set, the run draws no frames
    std::filesystem::path trace;        ///< empty: not written, also for `energy` and `json`
    std::filesystem::path energy;
    std::filesystem::path json;
    std::filesystem::path profile;
    bool no_line = false;          ///< a window has none, see About::has_line
    bool inspector = false;        ///< frames show it; a window opens with it
    std::filesystem::path script;  ///< of a game: its input, - is stdin; empty: nobody plays
    std::filesystem::path keys;
    ChosenControls controls;  ///< of --keys or of the recording that is replayed
    std::filesystem::path record;
    std::optional<Recording> replay;
    std::filesystem::path replay_file;
    bool replay_anyway = false;              ///< also of another version or of a changed game
    bool what_if = false;                    ///< plays `replay` with other settings
    std::vector<Stepping> what_if_settings;  ///< empty: the usual ones
    std::optional<double> time_limit;        ///< s, of real time
    bool quiet = false;
};

/// The given option that needs each step as it was first taken, such as "--record"; empty: none, so
/// the player may go back.
[[nodiscard]] std::string_view no_way_back(const Options& options);
/// The given option that fixes the setting of a run, such as "--json"; empty: none does.
[[nodiscard]] std::string_view fixing_option(const Options& options);
/// Why a player cannot change the setting of a run; empty: it can be changed.
[[nodiscard]] std::string why_fixed(const Options& options, const About& about);

/// The controls of the game with the buttons that the player has.
[[nodiscard]] inline std::span<const Control> controls_of(const Options& options,
                                                          const About& about) {
    return options.controls ? std::span<const Control>(*options.controls) : about.controls;
}

/// Options, or the text of --help or --version.
struct CommandLine {
    Options options;
    std::string text;
    About about;  ///< name and defaults of the game or the scene file
};

/// Reads name and defaults of a scene file or, if the path is empty, of the scene in a manifest.
/// Their texts must outlive the command line.
using AboutScene =
    std::function<About(const std::string& path, const std::optional<Manifest>& from)>;

/// Parses the options of a game, or with `about_scene` those of a program that plays a scene file,
/// whose settings hold unless the command line gives others. Throws Error{usage} with the option
/// and its allowed values.
[[nodiscard]] CommandLine parse_command_line(int argc, char** argv, const About& about,
                                             const AboutScene& about_scene = {});

}  // namespace oiler
