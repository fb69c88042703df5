// SPDX-License-Identifier: MIT
#include "oiler/app/options.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <type_traits>
#include <utility>
#include <vector>

#include "oiler/app/golden.hpp"
#include "oiler/app/loop_keys.hpp"
#include "oiler/capture/capture_folder.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/capture/paths.hpp"
#include "oiler/capture/video.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/version.hpp"
#include "oiler/overlay/help.hpp"
#include "oiler/play/keys.hpp"
#include "oiler/process/parse.hpp"
#include "oiler/process/parse_size.hpp"
#include "oiler/whatif/what_if_settings.hpp"

namespace oiler {
namespace {

/// The options as words of the command line.
struct Words {
    std::string scene;
    std::string surface = "auto";
    std::string size = "1280x720";
    std::string method;
    std::string precision;
    std::string damping;
    std::int64_t rate = 0;
    std::int64_t frames = 0;
    std::int64_t steps = 0;
    int fps = 60;
    std::uint64_t seed = 0;
    int threads = 1;
    std::string png = "all";
    std::filesystem::path from;
    std::int64_t frame = 0;
    std::string what_if;
    bool force = false;
};

/// Default values, for --help.
struct Defaults {
    explicit Defaults(const About& about)
        : method(about.method),
          precision(name_of(about.precision)),
          rate(std::to_string(about.rate)),
          seconds(fmt::format("{:g} s", about.duration)),
          out(fmt::format("frames/{}", about.name)) {}
    static Defaults of_scene() {
        Defaults defaults{About{.name = "SCENE", .title = {}}};
        defaults.method = defaults.precision = defaults.rate = "the scene's";
        defaults.seconds = "the scene's duration";
        return defaults;
    }

    std::string method;
    std::string precision;
    std::string rate;
    std::string seconds;
    std::string out;
};

void declare_drawing(CLI::App& app, Options& options, Words& words, const Defaults& defaults) {
    app.add_flag("--headless", options.headless, "draw frames into a folder, without a window")
        ->disable_flag_override();
    app.add_option("--surface", words.surface,
                   "provider of OpenGL: a window, or without a window OSMesa or EGL")
        ->check(CLI::IsMember({"auto", "window", "osmesa", "egl"}))
        ->type_name("NAME")
        ->capture_default_str();
    add_whole<std::int64_t>(
        app, "--frames", words.frames, 1, 1'000'000,
        "number of frames; if not given, a headless run draws " + defaults.seconds);
    add_whole<int>(
        app, "--fps", words.fps, 1, 1000,
        "frames per second, 60 if not given; in a window a limit, the display's if not given");
    app.add_option("--size", words.size, "size of frames or window in pixels; pictures are 16:9")
        ->type_name("WxH")
        ->capture_default_str();
    app.add_option("--out", options.out, "folder for headless frames")
        ->type_name("DIR")
        ->default_str(defaults.out);
    add_whole<std::int64_t>(app, "--steps", words.steps, 0, 1'000'000'000'000,
                            "take N steps as fast as possible and draw nothing");
}

void declare_capture(CLI::App& app, Options& options, Words& words) {
    const auto add_file = [&](const char* name, std::filesystem::path& path, const char* type,
                              const char* help) {
        app.add_option(name, path, help)->type_name(type);
    };
    app.add_option("--png", words.png, "write PNG frames: all, or none for hashes only")
        ->check(CLI::IsMember({"all", "none"}))
        ->type_name("NAME")
        ->capture_default_str();
    add_whole<std::int64_t>(app, "--keyframes", options.keyframes, 1, 1'000'000,
                            "write a PNG for every Nth frame only, hashes for all");
    add_file("--video", options.video, "FILE",
             "write the frames as .mp4, .gif or .apng, too; needs ffmpeg");
    add_file("--sheet", options.sheet, "FILE", "write up to 12 frames of the run on one PNG");
    add_file("--golden", options.golden, "DIR",
             "compare the frames with those in DIR: exit 1 with the cause if they differ");
    app.add_flag("--update-golden", options.update_golden,
                 "write the frames into the folder of --golden")
        ->disable_flag_override();
    app.add_flag("--force", words.force, "let --update-golden run in CI")->disable_flag_override();
    add_file("--junit", options.junit, "FILE", "write the comparison with --golden as JUnit XML");
    add_file("--from", words.from, "FILE", "take the settings of a capture from its manifest.json");
    add_whole<std::int64_t>(app, "--frame", words.frame, 0, 999'999,
                            "draw frame N only; with --from, compare it with the manifest");
}

void declare_stepping(CLI::App& app, Words& words, const Defaults& defaults) {
    app.add_option(
           "--method", words.method,
           "method of the step: semi_implicit_euler, velocity_verlet, rk4, blanes_moan_srkn6b, "
           "implicit_midpoint, exact, …; `oiler methods` lists all")
        ->type_name("NAME")
        ->default_str(defaults.method);
    add_damping(app, words.damping);
    add_whole<std::int64_t>(app, "--rate", words.rate, 1, 1'000'000, "steps per second: dt = 1/N s")
        ->default_str(defaults.rate);
    app.add_option("--precision", words.precision,
                   "precision of positions and velocities: float, double")
        ->check(CLI::IsMember({"float", "double"}))
        ->type_name("NAME")
        ->default_str(defaults.precision);
    add_whole<int>(app, "--threads", words.threads, 1, 256,
                   "number of threads; results do not depend on it")
        ->default_str("1");
    add_whole<std::uint64_t>(app, "--seed", words.seed, 0, ~std::uint64_t{0},
                             "seed of the game's random numbers")
        ->default_str("0");
}

void declare_output(CLI::App& app, Options& options) {
    const auto add_file = [&](const char* name, std::filesystem::path& path, const char* help) {
        app.add_option(name, path, help)->type_name("FILE");
    };
    add_file("--trace", options.trace, "write each body after each step as CSV, - for stdout");
    add_file("--energy", options.energy, "write energies after each step as CSV, - for stdout");
    add_file("--json", options.json, "write a summary of the run as JSON, - for stdout");
    app.add_flag("--inspector", options.inspector,
                 "show what the timestep costs beside the picture, as F1 does in a window")
        ->disable_flag_override();
    add_file("--profile", options.profile,
             "write the times of all stages in Chrome's trace format");
    app.add_flag("--quiet", options.quiet, "print no remarks and no progress on standard error")
        ->disable_flag_override();
}

/// Checks that no path is empty, no output is an input and no two outputs are the same.
void check_paths(const CLI::App& app, const Options& options, const Words& words) {
    std::vector<NamedPath> outputs{{"--trace", options.trace}, {"--energy", options.energy},
                                   {"--json", options.json},   {"--profile", options.profile},
                                   {"--junit", options.junit}, {"--video", options.video},
                                   {"--sheet", options.sheet}, {"--record", options.record}};
    if (options.headless)
        outputs.push_back({options.update_golden ? "--golden" : "--out",
                           options.update_golden ? options.golden : options.out, is_capture_file});
    std::vector<NamedPath> inputs{{"SCENE", words.scene},
                                  {"--from", words.from},
                                  {"--script", options.script},
                                  {"--keys", options.keys},
                                  {"--replay", options.replay_file}};
    if (!options.update_golden) inputs.push_back({"--golden", options.golden, is_capture_file});
    for (const std::vector<NamedPath>& paths : {outputs, inputs})
        for (const NamedPath& path : paths)
            if (path.name != "SCENE" && app.get_option_no_throw(path.name) != nullptr &&
                app.count(path.name) > 0 && path.path.empty())
                fail(Exit::usage, "{}: give a path", path.name);
    if (options.record == "-")
        fail(Exit::usage, "--record -: a recording is written to a file; give a name");
    std::erase_if(inputs, [](const NamedPath& input) {
        return input.path.empty() || (input.name == "--script" && input.path == "-");
    });
    require_distinct(inputs, outputs);
    if (!options.video.empty()) Video::require_format(options.video);
}

/// Refuses options that contradict each other.
void check_conflicts(const CLI::App& app, const Options& options, const Words& words) {
    const auto refuse = [](std::string_view option, std::string_view why) {
        fail(Exit::usage, "{}: {}", option, why);
    };
    const bool offscreen = words.surface == "osmesa" || words.surface == "egl";
    if (app.count("--steps") > 0)
        for (const char* other :
             {"--headless", "--frames", "--fps", "--size", "--out", "--surface"})
            if (app.count(other) > 0)
                refuse(other, "draws, but --steps draws nothing; give one of them");
    if (offscreen && !options.headless && !options.what_if)
        refuse("--surface " + words.surface, "draws without a window; add --headless");
    if (words.surface == "window" && options.headless)
        refuse("--surface window", "opens a window; leave out --headless");
    for (const char* option :
         {"--out", "--png", "--keyframes", "--video", "--sheet", "--golden", "--from", "--frame"})
        if (app.count(option) > 0 && !options.headless)
            refuse(option, "needs a run without a window; add --headless");
    if (words.png == "none" && app.count("--keyframes") > 0)
        refuse("--keyframes", "chooses PNG frames, but --png none writes none; give one of them");
    for (const char* option : {"--update-golden", "--junit"})
        if (app.count(option) > 0 && options.golden.empty())
            refuse(option, "needs a golden; add --golden DIR");
    if (options.inspector)
        for (const char* other : {"--steps", "--frame", "--golden", "--sheet"})
            if (app.count(other) > 0)
                refuse("--inspector", fmt::format("{} has no place for it; leave one out", other));
    if (app.count("--frame") > 0)
        for (const char* other : {"--frames", "--video", "--sheet", "--golden", "--keyframes"})
            if (app.count(other) > 0) refuse(other, "draws more frames than --frame; give one");
}

/// Only options that mean something for many runs.
void check_what_if(const CLI::App& app, const Words& words) {
    constexpr std::array allowed{"--replay", "--replay-anyway", "--what-if", "--json",
                                 "--quiet",  "--threads",       "--size",    "--surface"};
    for (const CLI::Option* const option : app.get_options())
        if (option->count() > 0 && std::ranges::count(allowed, option->get_name()) == 0)
            fail(Exit::usage, "{}: --what-if prints a table of many runs of a recording; {}",
                 option->get_name(),
                 option->get_name() == "--script"
                     ? "record the script with --record FILE, then give --replay FILE"
                     : "leave one of them out");
    if (words.surface == "window")
        fail(Exit::usage, "--surface window: --what-if draws off screen; give osmesa or egl");
    if (app.count("--replay") == 0)
        fail(Exit::usage, "--what-if: plays a recording; add --replay FILE");
}

/// A golden that is not there is named before the run.
void check_golden(const Options& options) {
    std::error_code error;
    if (!options.golden.empty() && !options.update_golden &&
        !std::filesystem::exists(options.golden / manifest_name, error))
        fail(Exit::usage, "--golden: {} has no capture; write it with --update-golden",
             options.golden.string());
}

/// Jenkins sets another variable than all others.
bool runs_in_ci() {
    const char* const ci = std::getenv("CI");
    const std::string_view value = ci == nullptr ? "" : ci;
    return (!value.empty() && value != "false" && value != "0") ||
           std::getenv("JENKINS_URL") != nullptr;
}

/// The golden is replaced on purpose only: a CI job that updates it would always pass.
void check_update(const CLI::App& app, const Options& options, const Words& words) {
    if (words.force && !options.update_golden)
        fail(Exit::usage, "--force: lets --update-golden run in CI; add --update-golden");
    if (!options.update_golden) return;
    for (const char* other : {"--out", "--junit"})
        if (app.count(other) > 0)
            fail(Exit::usage, "{}: --update-golden writes {} only; leave it out", other,
                 options.golden.string());
    if (runs_in_ci() && !words.force)
        fail(Exit::usage,
             "--update-golden: the variable CI or JENKINS_URL is set, and a job that updates its "
             "golden always "
             "passes; run it on your computer, or add --force");
}

/// The settings of a replay are those of its recording.
void take_replay(const CLI::App& app, Words& words, CommandLine& line) {
    for (const char* option : {"--method", "--rate", "--precision", "--damping", "--seed", "--from",
                               "--script", "--record", "--keys"})
        if (app.count(option) > 0)
            fail(Exit::usage, "{}: comes from the recording of --replay; leave it out", option);
    line.options.replay = read_recording(line.options.replay_file);
    const Stepping& stepping = line.options.replay->header.stepping;
    words.method = stepping.method->name;
    words.rate = static_cast<int>(stepping.rate.steps);
    words.precision = name_of(stepping.precision);
    words.damping = stepping.damping ? name_of(*stepping.damping) : "";
    words.seed = line.options.replay->header.seed;
    const Settings settings{.stepping = stepping, .seed = words.seed};
    if (line.options.what_if && !words.what_if.empty())
        line.options.what_if_settings = parse_what_if(words.what_if, stepping);
    require_same_game(line.options.replay->header,
                      header_of(line.about.name, settings, line.about.controls),
                      line.options.replay_anyway);
    line.options.controls = controls_of(line.options.replay->header, line.about.controls);
}

void take_keys(CommandLine& line) {
    const std::string file = line.options.keys.string();
    if (line.about.controls.empty())
        fail(Exit::usage, "--keys: {} has no actions to choose buttons for; leave it out",
             line.about.name);
    line.options.controls = std::make_shared<const std::vector<Control>>(
        parse_keys(read_text(line.options.keys), file, line.about.controls));
}

/// Settings that the command line does not give come from the manifest or from the game.
void fill_in(const CLI::App& app, Words& words, CommandLine& line) {
    const About& about = line.about;
    const std::optional<Manifest>& from = line.options.from;
    if (from && from->scene != about.name)
        fail(Exit::usage, "--from: the manifest is of {}, not of {}; run that program", from->scene,
             about.name);
    const auto fill = [&](const char* option, auto& word, auto of_manifest, auto of_about) {
        if (app.count(option) == 0 && !line.options.replay)
            word = from ? static_cast<std::decay_t<decltype(word)>>(of_manifest(*from))
                        : static_cast<std::decay_t<decltype(word)>>(of_about);
    };
    fill(
        "--method", words.method, [](const Manifest& m) { return m.method; }, about.method);
    fill(
        "--precision", words.precision, [](const Manifest& m) { return m.precision; },
        name_of(about.precision));
    fill(
        "--rate", words.rate, [](const Manifest& m) { return m.rate; }, about.rate);
    fill(
        "--damping", words.damping, [](const Manifest& m) { return m.damping; }, about.damping);
    fill(
        "--seed", words.seed, [](const Manifest& m) { return m.seed; }, std::uint64_t{0});
    if (!from) return;
    if (app.count("--fps") == 0) line.options.fps = from->fps;
    if (app.count("--frames") == 0) line.options.frames = from->planned_frames;
    if (app.count("--size") == 0)
        words.size = fmt::format("{}x{}", from->size.width, from->size.height);
}

Options collect(const CLI::App& app, Options options, const Words& words, const About& about) {
    check_conflicts(app, options, words);
    check_update(app, options, words);
    options.settings = {.stepping = {.method = &find_method(words.method),
                                     .rate = {words.rate},
                                     .precision = words.precision == "float" ? Precision::single
                                                                             : Precision::double_},
                        .seed = words.seed,
                        .threads = words.threads};
    if (!words.damping.empty())
        options.settings.stepping.damping =
            words.damping == "kick" ? Damping::in_kick : Damping::in_drift;
    options.size = parse_size(words.size);
    options.has_size = app.count("--size") > 0;
    if (words.surface == "osmesa") options.offscreen = Offscreen::osmesa;
    if (words.surface == "egl") options.offscreen = Offscreen::egl;
    if (app.count("--frames") > 0) options.frames = words.frames;
    if (app.count("--fps") > 0) options.fps = words.fps;
    if (app.count("--steps") > 0) options.steps = words.steps;
    if (app.count("--frame") > 0) options.frame = words.frame;
    options.has_png = words.png == "all";
    if (app.count("--out") == 0)
        options.out = options.update_golden ? folder_of_new_golden(options.golden)
                                            : std::filesystem::path("frames") / about.name;
    check_paths(app, options, words);
    check_golden(options);
    return options;
}

void declare_play(CLI::App& app, Options& options, Words& words) {
    const auto add_file = [&](const char* name, std::filesystem::path& path, const char* help) {
        app.add_option(name, path, help)->type_name("FILE");
    };
    add_file("--keys", options.keys,
             "take the buttons of actions from a TOML file: fire = [\"Space\", \"Pad south\"]");
    add_file("--script", options.script,
             "play the keys and the mouse of a text, with lines such as: 60 press Space; "
             "- for stdin");
    add_file("--record", options.record, "record what is played, for --replay");
    add_file("--replay", options.replay_file,
             "play a recording with its settings: exit 1 with the first step that differs");
    app.add_option("--what-if", words.what_if,
                   "play the recording of --replay with other settings and print what differs; "
                   "settings such as 30,rk4,velocity_verlet@120,float")
        ->type_name("[SETTINGS]")
        ->expected(0, 1);
    app.add_flag("--replay-anyway", options.replay_anyway,
                 "replay a recording of another version of Oiler, and play on where a changed game "
                 "differs")
        ->disable_flag_override();
}

void declare_scene(CLI::App& app, Words& words) {
    app.add_option("SCENE", words.scene,
                   "scene file in TOML, see assets/scenes/README.md; not needed with --from");
}

std::string footer(const std::string& program, std::span<const Control> controls) {
    const auto name_of_button = [](Button button) { return name_of(button); };
    std::string actions;
    for (const Control& control : controls)
        actions += fmt::format("{}{}: {}", actions.empty() ? "Actions: " : "; ", control.name,
                               buttons_of(control, name_of_button));
    return actions + (actions.empty() ? "" : ".\n") +
           "Keys in a window: " + list_of_loop_keys(loop_keys().size()) + ".\nExample: " + program +
           " --headless --frames 120 --size 640x360 --out frames";
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv, const About& about) {
    return parse_command_line(argc, argv, about, {});
}

CommandLine parse_command_line(int argc, char** argv, const About& about,
                               const AboutScene& about_scene) {
    check_controls(about.controls);
    const std::string name(about.name);
    CLI::App app(std::string(about.title), name);
    app.footer(footer(name + (about_scene ? " assets/scenes/cloth.toml" : ""), about.controls));
    app.set_version_flag("--version", name + " " + std::string(version()));
    CommandLine line{.options = {}, .text = {}, .about = about};
    Words words;
    const Defaults defaults = about_scene ? Defaults::of_scene() : Defaults(about);
    about_scene ? declare_scene(app, words) : declare_play(app, line.options, words);
    declare_drawing(app, line.options, words, defaults);
    declare_capture(app, line.options, words);
    declare_stepping(app, words, defaults);
    declare_output(app, line.options);
    line.text = parse(app, argc, argv);
    if (!line.text.empty()) return line;
    const CLI::Option* const what_if = app.get_option_no_throw("--what-if");
    line.options.what_if = what_if != nullptr && what_if->count() > 0;
    if (line.options.what_if) check_what_if(app, words);
    if (!words.from.empty()) line.options.from = read_manifest(words.from);
    if (about_scene) line.about = about_scene(words.scene, line.options.from);
    if (!line.options.replay_file.empty()) take_replay(app, words, line);
    if (!line.options.keys.empty()) take_keys(line);
    fill_in(app, words, line);
    line.options = collect(app, std::move(line.options), words, line.about);
    return line;
}

}  // namespace oiler
