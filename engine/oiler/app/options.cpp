// SPDX-License-Identifier: MIT
#include "oiler/app/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>

#include "oiler/core/error.hpp"
#include "oiler/core/version.hpp"

namespace oiler {
namespace {

constexpr int largest_side = 16384;

/// The options as the command line gives them.
struct Words {
    std::string surface = "auto";
    std::string size = "1280x720";
    std::string method;
    std::string precision;
    std::int64_t rate = 0;
    std::int64_t frames = 0;
    std::int64_t steps = 0;
    int fps = 60;
    std::uint64_t seed = 0;
};

Size parse_size(const std::string& words) {
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

void declare(CLI::App& app, Options& options, Words& words, const About& about) {
    words.method = about.method;
    words.precision = name_of(about.precision);
    words.rate = about.rate;
    app.add_flag("--headless", options.headless, "draw frames into a folder, without a window");
    app.add_option("--surface", words.surface, "who draws: a window, or without one OSMesa or EGL")
        ->check(CLI::IsMember({"auto", "window", "osmesa", "egl"}))
        ->capture_default_str();
    app.add_option("--frames", words.frames, "how many frames; headless: 4 s unless given")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}));
    app.add_option("--fps", words.fps, "frames per second; in a window: at most")
        ->check(CLI::Range(1, 1000))
        ->default_str("60, in a window the display's");
    app.add_option("--size", words.size, "of frames and window, in pixels")->capture_default_str();
    app.add_option("--out", options.out, "folder for headless frames")
        ->default_str("frames/" + std::string(about.name));
    app.add_option("--steps", words.steps, "take that many steps and draw nothing")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000'000}));
    app.add_option("--method", words.method, "how to step: " + method_names())
        ->capture_default_str();
    app.add_option("--rate", words.rate, "steps per second: dt = 1/RATE s")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}))
        ->capture_default_str();
    app.add_option("--precision", words.precision, "of positions and velocities")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
    app.add_option("--seed", words.seed, "of the game's random numbers")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--trace", options.trace, "write each body after each step to this CSV file");
    app.add_option("--energy", options.energy, "write energies after each step to this CSV file");
    app.add_option("--json", options.json, "write what the run was to this file, - for stdout");
    app.add_flag("--quiet", options.quiet, "no remarks and no progress on standard error");
}

/// Options that contradict each other.
void check_together(const CLI::App& app, const Options& options, const Words& words) {
    const auto refuse = [](std::string_view option, std::string_view why) {
        fail(Exit::usage, "{}: {}", option, why);
    };
    const bool offscreen = words.surface == "osmesa" || words.surface == "egl";
    if (app.count("--steps") > 0)
        for (const char* other :
             {"--headless", "--frames", "--fps", "--size", "--out", "--surface"})
            if (app.count(other) > 0) refuse(other, "draws, but --steps draws nothing; give one");
    if (offscreen && !options.headless)
        refuse("--surface " + words.surface, "draws without a window; add --headless");
    if (words.surface == "window" && options.headless)
        refuse("--surface window", "is a window; leave out --headless");
    if (app.count("--out") > 0 && !options.headless)
        refuse("--out", "frames are written without a window; add --headless");
}

Options collect(const CLI::App& app, Options options, const Words& words, const About& about) {
    check_together(app, options, words);
    options.settings = {
        .rate = {words.rate},
        .method = &find_method(words.method),
        .precision = words.precision == "float" ? Precision::single : Precision::double_,
        .seed = words.seed};
    options.size = parse_size(words.size);
    if (words.surface == "osmesa") options.offscreen = Offscreen::osmesa;
    if (words.surface == "egl") options.offscreen = Offscreen::egl;
    if (app.count("--frames") > 0) options.frames = words.frames;
    if (app.count("--fps") > 0) options.fps = words.fps;
    if (app.count("--steps") > 0) options.steps = words.steps;
    if (options.out.empty()) options.out = std::filesystem::path("frames") / about.name;
    return options;
}

}  // namespace

CommandLine parse_command_line(int argc, char** argv, const About& about) {
    const std::string name(about.name);
    CLI::App app(std::string(about.title), name);
    app.footer(
        "Keys in a window: P pause, . step, - and = slower and faster, Q or Escape quit.\n"
        "Example: " +
        name + " --headless --frames 120 --size 640x360 --out frames");
    app.set_version_flag("--version", name + " " + std::string(version()));
    CommandLine line;
    Words words;
    declare(app, line.options, words, about);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return {{}, app.help()};
    } catch (const CLI::CallForVersion&) {
        return {{}, app.version() + "\n"};
    } catch (const CLI::ParseError& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        fail(Exit::usage, "{} (see {} --help)", what, name);
    }
    line.options = collect(app, std::move(line.options), words, about);
    return line;
}

}  // namespace oiler
