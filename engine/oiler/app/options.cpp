// SPDX-License-Identifier: MIT
#include "oiler/app/options.hpp"

#include <cstdlib>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "oiler/app/loop_keys.hpp"
#include "oiler/capture/capture_folder.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/capture/video.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/version.hpp"
#include "oiler/overlay/help.hpp"
#include "oiler/play/keys.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/process/parse.hpp"
#include "oiler/process/parse_size.hpp"
#include "oiler/whatif/what_if.hpp"

namespace oiler {
namespace {

using Path = std::filesystem::path;

/// The options as the command line gives them.
struct Given : Options {
    Path scene;
    Path from_file;
    std::string surface = "auto";
    std::string size_words = "1280x720";
    std::string png = "all";
    std::string what_if_words;
    std::string method;
    std::string precision;
    std::string damping;
    std::int64_t rate = 0;
    std::uint64_t seed = 0;
    int threads = 1;
    bool force = false;
};

template <class Target, class Number = Target>
struct Whole {
    Target Given::*target;
    Number low;
    Number high;
};
using Count = Whole<std::optional<std::int64_t>, std::int64_t>;
/// The member that holds the value of an option.
using Target = std::variant<bool Given::*, std::string Given::*, Path Given::*,
                            std::optional<double> Given::*, Count, Whole<std::optional<int>, int>,
                            Whole<int>, Whole<std::int64_t>, Whole<std::uint64_t>>;

/// The meaning of an option for a run, and the options that it needs or excludes.
enum Trait : unsigned {
    game_only = 1U << 0U,
    scene_only = 1U << 1U,
    input = 1U << 2U,           ///< a file that is read
    drawn = 1U << 3U,           ///< excluded by --steps
    filmed = 1U << 4U,          ///< needs --headless
    several = 1U << 5U,         ///< of more frames than one: excluded by --frame
    no_panel = 1U << 6U,        ///< excludes --inspector
    compared = 1U << 7U,        ///< needs --golden
    not_updated = 1U << 8U,     ///< excluded by --update-golden
    recorded = 1U << 9U,        ///< a recording has it: excluded by --replay
    of_many_runs = 1U << 10U,   ///< allowed with --what-if
    keeps_setting = 1U << 11U,  ///< the setting of the run cannot be changed
    keeps_steps = 1U << 12U,    ///< needs each step as it was first taken; keeps the setting, too
    in_window = 1U << 13U,      ///< excluded by --headless and --steps
};

/// An option, in one place.
struct Row {
    const char* name;
    const char* help;  ///< see fill_in
    Target target;
    unsigned traits = 0;
    const char* shown = "";          ///< the default in --help, see fill_in
    const char* type = "";           ///< in --help, or the allowed words; one in [] is optional
    const FileKind* kind = nullptr;  ///< of a file that is written
};

/// In the order of --help.
const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"SCENE", "scene file in TOML, see assets/scenes/README.md; not needed with --from",
         &Given::scene, scene_only | input, "", "TEXT"},
        {"--keys",
         "take the buttons of actions from a TOML file: fire = [\"Space\", \"Pad south\"]",
         &Given::keys, game_only | input | recorded},
        {"--script",
         "play the keys and the mouse of a text, with lines such as: 60 press Space; - for stdin",
         &Given::script, game_only | input | recorded | keeps_steps},
        {"--record", "record what is played, for --replay", &Given::record,
         game_only | recorded | keeps_steps, "", "", &kinds::recording},
        {"--replay", "play a recording with its settings: exit 1 with the first step that differs",
         &Given::replay_file, game_only | input | keeps_steps | of_many_runs},
        {"--what-if",
         "play the recording of --replay with other settings and print what differs; settings such "
         "as 30,rk4,velocity_verlet@120,float",
         &Given::what_if_words, game_only | of_many_runs, "", "[SETTINGS]"},
        {"--replay-anyway",
         "replay a recording of another version of Oiler, and play on where a changed game differs",
         &Given::replay_anyway, game_only | of_many_runs},
        {"--headless", "draw frames into a folder, without a window", &Given::headless, drawn},
        {"--surface", "provider of OpenGL: a window, or without a window OSMesa or EGL",
         &Given::surface, drawn | of_many_runs, "auto", "auto|window|osmesa|egl"},
        {"--frames",
         "number of frames; if not given, a headless run draws {seconds}, or a whole longer script",
         Count{&Given::frames, 1, 1'000'000}, drawn | several},
        {"--fps",
         "frames per second, 60 if not given; in a window a limit, the display's if not given",
         Whole<std::optional<int>, int>{&Given::fps, 1, 1000}, drawn},
        {"--size", "size of frames or window in pixels; pictures are 16:9", &Given::size_words,
         drawn | of_many_runs, "1280x720", "WxH"},
        {"--out", "folder for headless frames", &Given::out, drawn | filmed | not_updated, "{out}",
         "DIR"},
        {"--steps", "take N steps as fast as possible and draw nothing",
         Count{&Given::steps, 0, 1'000'000'000'000}, no_panel},
        {"--png", "write PNG frames: all, or none for hashes only", &Given::png, filmed, "all",
         "all|none"},
        {"--keyframes", "write a PNG for every Nth frame only, hashes for all",
         Whole<std::int64_t>{&Given::keyframes, 1, 1'000'000}, filmed | several},
        {"--video", "write the frames as .mp4, .gif or .apng, too; needs ffmpeg", &Given::video,
         filmed | several, "", "", &kinds::video},
        {"--sheet", "write up to 12 frames of the run on one PNG", &Given::sheet,
         filmed | several | no_panel, "", "", &kinds::png},
        {"--golden", "compare the frames with those in DIR: exit 1 with the cause if they differ",
         &Given::golden, filmed | several | no_panel, "", "DIR"},
        {"--update-golden", "write the frames into the folder of --golden", &Given::update_golden,
         compared},
        {"--force", "let --update-golden run in CI", &Given::force},
        {"--junit", "write the comparison with --golden as JUnit XML", &Given::junit,
         compared | not_updated, "", "", &kinds::junit},
        {"--from", "take the settings of a capture from its manifest.json", &Given::from_file,
         input | filmed | recorded},
        {"--frame", "draw frame N only; with --from, compare it with the manifest",
         Count{&Given::frame, 0, 999'999}, filmed | no_panel},
        {"--method",
         "method of the step: semi_implicit_euler, velocity_verlet, rk4, blanes_moan_srkn6b, "
         "implicit_midpoint, exact, …; `oiler methods` lists all",
         &Given::method, recorded, "{method}"},
        {"--damping", help_of_damping, &Given::damping, recorded, "", "kick|drift"},
        {"--rate", "steps per second: dt = 1/N s", Whole<std::int64_t>{&Given::rate, 1, 1'000'000},
         recorded, "{rate}"},
        {"--precision", "precision of positions and velocities: float, double", &Given::precision,
         recorded, "{precision}", "float|double"},
        {"--threads", "number of threads; results do not depend on it",
         Whole<int>{&Given::threads, 1, 256}, of_many_runs, "1"},
        {"--seed", "seed of the game's random numbers",
         Whole<std::uint64_t>{&Given::seed, 0, ~std::uint64_t{0}}, recorded, "0"},
        {"--trace", "write each body after each step as CSV, - for stdout", &Given::trace,
         keeps_steps, "", "", &kinds::trace},
        {"--energy", "write energies after each step as CSV, - for stdout", &Given::energy,
         keeps_steps, "", "", &kinds::energy},
        {"--json", "write a summary of the run as JSON, - for stdout", &Given::json,
         of_many_runs | keeps_setting, "", "", &kinds::json},
        {"--inspector", "show what the timestep costs beside the picture, as F1 does in a window",
         &Given::inspector},
        {"--no-line", "show no line above the picture about the timestep, in a window for players",
         &Given::no_line, in_window},
        {"--profile", "write the times of all stages in Chrome's trace format", &Given::profile, 0,
         "", "", &kinds::json},
        {"--time-limit", help_of_time_limit, &Given::time_limit, of_many_runs, "", "S"},
        {"--quiet", "print no remarks and no progress on standard error", &Given::quiet,
         of_many_runs},
    };
    return all;
}

/// Puts the defaults of the game, or of any scene, into a text of --help.
std::string fill_in(const char* text, const About& about, bool is_scene) {
    const auto of_game = [&](const auto& value) {
        return is_scene ? std::string("the scene's") : fmt::format("{}", value);
    };
    return fmt::format(fmt::runtime(text), fmt::arg("method", of_game(about.method)),
                       fmt::arg("precision", of_game(name_of(about.precision))),
                       fmt::arg("rate", of_game(about.rate)),
                       fmt::arg("seconds", is_scene ? "the scene's duration"
                                                    : fmt::format("{:g} s", about.duration)),
                       fmt::arg("out", fmt::format("frames/{}", is_scene ? "SCENE" : about.name)));
}

void declare(CLI::App& app, Given& given, const Row& row, const About& about, bool is_scene) {
    const std::string help = fill_in(row.help, about, is_scene);
    const auto add = [&]<class To>(const To& target) -> CLI::Option* {
        if constexpr (requires { target.low; })
            return add_whole(app, row.name, given.*target.target, target.low, target.high, help);
        else if constexpr (std::is_same_v<To, bool Given::*>)
            return app.add_flag(row.name, given.*target, help)->disable_flag_override();
        else if constexpr (std::is_same_v<To, std::optional<double> Given::*>)
            return add_seconds(app, row.name, given.*target, help);
        else
            return app.add_option(row.name, given.*target, help)
                ->type_name(std::is_same_v<To, Path Given::*> ? "FILE" : "NAME");
    };
    CLI::Option* const option = std::visit(add, row.target);
    const std::string type = row.type;
    if (type.find('|') != type.npos)
        option->check(CLI::IsMember(CLI::detail::split(type, '|')));
    else if (!type.empty())
        option->type_name(type);
    if (type.starts_with('[')) option->expected(0, 1);
    if (*row.shown != '\0') option->default_str(fill_in(row.shown, about, is_scene));
}

bool is_given(const CLI::App& app, const char* name) {
    const CLI::Option* const option = app.get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
}

/// Refuses options with a trait. Their names stand between the two parts of the message.
void refuse_all(const CLI::App& app, Trait trait, std::string_view before, std::string_view after) {
    for (const Row& row : rows())
        if ((row.traits & trait) != 0 && is_given(app, row.name))
            fail(Exit::usage, "{}{}{}", before, row.name, after);
}

/// Checks that no path is empty, no output is an input, no two outputs are the same and none
/// replaces a file of another kind.
void check_paths(const CLI::App& app, const Given& given) {
    std::vector<NamedPath> inputs;
    std::vector<NamedPath> outputs;
    for (const Row& row : rows()) {
        const auto* const target = std::get_if<Path Given::*>(&row.target);
        if (!target) continue;
        const Path& path = given.*(*target);
        if (path.empty() && (row.traits & scene_only) == 0 && is_given(app, row.name))
            fail(Exit::usage, "{}: give a path", row.name);
        if (row.kind) outputs.push_back({.name = row.name, .path = path, .kind = row.kind});
        if ((row.traits & input) != 0 && !path.empty() && path != "-")
            inputs.push_back({row.name, path});
    }
    const NamedPath golden{"--golden", given.golden, is_capture_file};
    if (given.headless)
        outputs.push_back(given.update_golden ? golden
                                              : NamedPath{"--out", given.out, is_capture_file});
    if (!given.update_golden && !given.golden.empty()) inputs.push_back(golden);
    if (given.record == "-")
        fail(Exit::usage, "--record -: a recording is written to a file; give a name");
    require_distinct(inputs, outputs);
    for (const NamedPath& one : outputs) {
        require_replaceable(one.path, *one.kind);
        remove_abandoned_files(one);
    }
    if (!given.video.empty()) Video::require_format(given.video);
}

/// Refuses options that contradict each other.
void check_conflicts(const CLI::App& app, const Given& given) {
    const bool offscreen = given.surface == "osmesa" || given.surface == "egl";
    if (given.steps)
        refuse_all(app, drawn, "", ": draws, but --steps draws nothing; give one of them");
    if (given.headless || given.steps)
        refuse_all(app, in_window, "", ": is for a window, and this run opens none; leave it out");
    if (offscreen && !given.headless && !given.what_if)
        fail(Exit::usage, "--surface {}: draws without a window; add --headless", given.surface);
    if (given.surface == "window" && given.headless)
        fail(Exit::usage, "--surface window: opens a window; leave out --headless");
    if (!given.headless)
        refuse_all(app, filmed, "", ": needs a run without a window; add --headless");
    if (given.png == "none" && is_given(app, "--keyframes"))
        fail(Exit::usage,
             "--keyframes: chooses PNG frames, but --png none writes none; give one of them");
    if (given.golden.empty()) refuse_all(app, compared, "", ": needs a golden; add --golden DIR");
    if (given.inspector)
        refuse_all(app, no_panel, "--inspector: ", " has no place for it; leave one out");
    if (given.frame) refuse_all(app, several, "", ": draws more frames than --frame; give one");
}

/// Refuses options that mean nothing for many runs.
void check_what_if(const CLI::App& app, const Given& given) {
    for (const Row& row : rows())
        if ((row.traits & of_many_runs) == 0 && is_given(app, row.name))
            fail(Exit::usage, "{}: --what-if prints a table of many runs of a recording; {}",
                 row.name,
                 std::string_view(row.name) == "--script"
                     ? "record the script with --record FILE, then give --replay FILE"
                     : "leave one of them out");
    if (given.surface == "window")
        fail(Exit::usage, "--surface window: --what-if draws off screen; give osmesa or egl");
    if (!is_given(app, "--replay"))
        fail(Exit::usage, "--what-if: plays a recording; add --replay FILE");
}

/// Refuses a golden that is missing or not whole before the run.
void check_golden(const Options& options) {
    if (options.golden.empty() || options.update_golden) return;
    require_whole(options.golden);
    std::error_code error;
    if (!std::filesystem::exists(options.golden / manifest_name, error))
        fail(Exit::usage, "--golden: {} has no capture; write it with --update-golden",
             options.golden.string());
}

/// Jenkins sets JENKINS_URL, all others set CI.
bool runs_in_ci() {
    const char* const ci = std::getenv("CI");
    const std::string_view value = ci == nullptr ? "" : ci;
    return (!value.empty() && value != "false" && value != "0") ||
           std::getenv("JENKINS_URL") != nullptr;
}

/// Refuses --update-golden in CI, where a job that updates its golden always passes.
void check_update(const CLI::App& app, const Given& given) {
    if (given.force && !given.update_golden)
        fail(Exit::usage, "--force: lets --update-golden run in CI; add --update-golden");
    if (!given.update_golden) return;
    refuse_all(
        app, not_updated, "",
        fmt::format(": --update-golden writes {} only; leave it out", given.golden.string()));
    if (runs_in_ci() && !given.force)
        fail(Exit::usage,
             "--update-golden: the variable CI or JENKINS_URL is set, and a job that updates its "
             "golden always passes; run it on your computer, or add --force");
}

/// The settings of a replay are those of its recording.
void take_replay(const CLI::App& app, Given& given, const About& about) {
    refuse_all(app, recorded, "", ": comes from the recording of --replay; leave it out");
    given.replay = read_recording(given.replay_file);
    const RecordingHeader& header = given.replay->header;
    if (given.what_if && !given.what_if_words.empty())
        given.what_if_settings = parse_what_if(given.what_if_words, header.stepping);
    require_same_game(header, header_of(about.name, {header.stepping}, about.controls),
                      given.replay_anyway);
    given.controls = controls_of(header, about.controls);
}

void take_keys(Given& given, const About& about) {
    if (about.controls.empty())
        fail(Exit::usage, "--keys: {} has no actions to choose buttons for; leave it out",
             about.name);
    given.controls = std::make_shared<const std::vector<Control>>(
        parse_keys(read_text(given.keys), given.keys.string(), about.controls));
}

/// Settings that the command line does not give come from the manifest or from the game.
void take_defaults(const CLI::App& app, Given& given, const About& about) {
    const std::optional<Manifest>& from = given.from;
    if (from && from->scene != about.name)
        fail(Exit::usage, "--from: the manifest is of {}, not of {}; run that program", from->scene,
             about.name);
    const auto fill = [&]<class Word>(const char* option, Word& word, auto Manifest::*of_manifest,
                                      auto of_about) {
        if (!is_given(app, option)) word = from ? Word(*from.*of_manifest) : Word(of_about);
    };
    fill("--method", given.method, &Manifest::method, about.method);
    fill("--precision", given.precision, &Manifest::precision, name_of(about.precision));
    fill("--rate", given.rate, &Manifest::rate, about.rate);
    fill("--damping", given.damping, &Manifest::damping, about.damping);
    fill("--seed", given.seed, &Manifest::seed, 0);
    if (!from) return;
    if (!given.fps) given.fps = from->fps;
    if (!given.frames) given.frames = from->planned_frames;
    if (!is_given(app, "--size"))
        given.size_words = fmt::format("{}x{}", from->size.width, from->size.height);
}

/// The options of a run from words to which the defaults were added.
Options collect(const CLI::App& app, Given given, const About& about) {
    check_conflicts(app, given);
    check_update(app, given);
    given.settings = {
        .stepping = {.method = &find_method(given.method),
                     .rate = {given.rate},
                     .precision = find_precision(given.precision).value_or(Precision::double_),
                     .damping = find_damping(given.damping)},
        .seed = given.seed,
        .threads = given.threads};
    if (given.replay) {
        given.settings.stepping = given.replay->header.stepping;
        given.settings.seed = given.replay->header.seed;
    }
    given.size = parse_size(given.size_words);
    given.has_size = is_given(app, "--size");
    if (given.surface == "osmesa") given.offscreen = Offscreen::osmesa;
    if (given.surface == "egl") given.offscreen = Offscreen::egl;
    given.has_png = given.png == "all";
    if (!is_given(app, "--out"))
        given.out = given.update_golden ? folder_of_new(given.golden) : Path("frames") / about.name;
    check_paths(app, given);
    check_golden(given);
    return given;
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

/// The first option with a trait that names a file; empty: none does.
std::string_view given_file(const Options& options, Trait trait) {
    for (const Row& row : rows())
        if (const auto* const target = std::get_if<Path Given::*>(&row.target);
            target && (row.traits & trait) != 0 &&
            !(options.*static_cast<Path Options::*>(*target)).empty())
            return row.name;
    return "";
}

}  // namespace

std::string_view no_way_back(const Options& options) { return given_file(options, keeps_steps); }

std::string_view fixing_option(const Options& options) {
    const std::string_view option = given_file(options, keeps_setting);
    return option.empty() ? no_way_back(options) : option;
}

std::string why_fixed(const Options& options, const About& about) {
    if (!about.fixed_setting.empty()) return std::string(about.fixed_setting);
    const std::string_view option = fixing_option(options);
    return option.empty() ? "" : fmt::format("{} keeps this setting.", option);
}

CommandLine parse_command_line(int argc, char** argv, const About& about,
                               const AboutScene& about_scene) {
    check_controls(about.controls);
    const std::string name(about.name);
    CLI::App app(std::string(about.title), name);
    app.footer(footer(name + (about_scene ? " assets/scenes/cloth.toml" : ""), about.controls));
    app.set_version_flag("--version", name + " " + std::string(version()));
    Given given;
    const bool is_scene = about_scene != nullptr;
    for (const Row& row : rows())
        if ((row.traits & (is_scene ? game_only : scene_only)) == 0)
            declare(app, given, row, about, is_scene);
    CommandLine line{.options = {}, .text = parse(app, argc, argv), .about = about};
    if (!line.text.empty()) return line;
    if (given.time_limit) Interrupt::set_time_limit(*given.time_limit);
    given.what_if = is_given(app, "--what-if");
    if (given.what_if) check_what_if(app, given);
    if (!given.from_file.empty()) given.from = read_manifest(given.from_file);
    if (about_scene) line.about = about_scene(given.scene.string(), given.from);
    if (!given.replay_file.empty()) take_replay(app, given, line.about);
    if (!given.keys.empty()) take_keys(given, line.about);
    take_defaults(app, given, line.about);
    line.options = collect(app, std::move(given), line.about);
    return line;
}

}  // namespace oiler
