// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "oiler/app/film.hpp"
#include "oiler/app/run_game.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/core/version.hpp"
#include "oiler/overlay/game_inspector.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/render/renderer.hpp"
#include "oiler/whatif/live_what_if.hpp"

namespace oiler {
namespace {

constexpr int default_fps = 60;
constexpr std::int64_t most_frames = 1'000'000;

std::int64_t frames_in(double seconds, int fps) {
    const double frames = std::max(1.0, std::round(seconds * fps));
    if (frames > double{most_frames})
        fail(Exit::usage,
             "{} s at {} frames per second are {:.0f} frames; give fewer with --frames N", seconds,
             fps, frames);
    return static_cast<std::int64_t>(frames);
}

/// The length of a film: to the end of a recording, or of a script, s.
double duration_of(const GameRun& run) {
    const Rate& rate = run.options.settings.stepping.rate;
    return run.options.replay ? rate.time(run.options.replay->steps)
                              : std::max(run.about.duration, rate.time(run.script_steps));
}

Manifest describe(const GameRun& run, const Surface& surface, const Renderer& renderer) {
    const Options& options = run.options;
    const About& about = run.about;
    const Stepping& stepping = options.settings.stepping;
    const int fps = options.fps.value_or(default_fps);
    return {.version = std::string(version()),
            .compiler = compiler(),
            .provider = std::string(surface.provider()),
            .gl_renderer = renderer.gl_renderer(),
            .gl_version = renderer.gl_version(),
            .size = options.size,
            .fps = fps,
            .rate = static_cast<int>(stepping.rate.steps),
            .method = std::string(stepping.method->name),
            .damping = std::string(damping_name(stepping)),
            .precision = std::string(name_of(stepping.precision)),
            .scene = std::string(about.name),
            .scene_text = std::string(about.scene_text),
            .seed = options.settings.seed,
            .planned_frames = options.frames ? *options.frames : frames_in(duration_of(run), fps)};
}

GameInspector::Fixed fixed_in_film(const About& about) {
    const bool hides_setting = !about.fixed_setting.empty();
    return {
        .reason = std::string(hides_setting ? about.fixed_setting : "F1 in a window changes them."),
        .hides_setting = hides_setting};
}

/// The inspector of a headless run. It gets no mouse input and waits for the runs that play along.
class FilmedInspector {
public:
    explicit FilmedInspector(const GameRun& run)
        : what_if_({run.options.settings, run.options.controls}, run.make, LiveWhatIf::Pace::own),
          inputs_(run.inputs, what_if_),
          profile_(run.profile),
          inspector_(run.playback.game(), fixed_in_film(run.about), Renderer::font()) {
        what_if_.start(0);
    }

    /// The input of the game's steps.
    [[nodiscard]] InputSource& inputs() { return inputs_; }

    /// Draws the inspector's overlays over the picture and lays out the panel.
    void show(Picture& picture, const HeadlessFrame& at, std::int64_t steps,
              const Manifest& header) {
        {
            const Span span(profile_, "play along");
            what_if_.play_until(steps);
        }
        const Span span(profile_, "inspector");
        const double alpha = steps == at.step ? 1 : at.alpha;
        inspector_.add_overlays(picture, what_if_.ghosts(steps, alpha), alpha, 1);
        (void)inspector_.show(
            &what_if_.figures(), {}, header.size, Inspector::view(header.size),
            {.seconds = 1.0 / header.fps, .background = picture.background, .waits = true});
    }
    [[nodiscard]] const Overlay& overlay() const { return inspector_.overlay(); }

private:
    LiveWhatIf what_if_;
    InputTap inputs_;
    Profile* profile_;
    GameInspector inspector_;
};

/// Draws the frames in their order until the last one or an interrupt.
void draw_frames(Film& film, const GameRun& run, const Manifest& header,
                 FilmedInspector* inspector) {
    Playback& playback = run.playback;
    InputSource& inputs = inspector ? inspector->inputs() : run.inputs;
    Progress progress(run.options.quiet, "frames", header.planned_frames);
    for (std::int64_t frame = 0; frame < header.planned_frames; ++frame) {
        const HeadlessFrame at = headless_frame(frame, header.rate, header.fps);
        const Span span(run.profile, "frame");
        Picture& picture = playback.show(at.step, at.alpha, inputs);
        const bool ended = playback.loop().quits() && at.step > playback.steps();
        if (ended || Interrupt::requested()) return;
        if (inspector) inspector->show(picture, at, playback.steps(), header);
        film.add(picture, at, playback, inspector ? inspector->overlay() : Overlay{},
                 inspector ? Inspector::view(header.size) : header.size);
        progress.show(frame + 1);
    }
}

void film(const GameRun& run, Renderer& renderer, const Manifest& header) {
    const Options& options = run.options;
    std::optional<FilmedInspector> inspector;
    if (options.inspector) inspector.emplace(run);
    Film film(renderer, header, options, run.profile);
    try {
        draw_frames(film, run, header, inspector ? &*inspector : nullptr);
    } catch (const Error& error) {
        if (error.exit() == Exit::diverged)
            film.finish();
        else
            film.finish_capture_ignoring_errors();
        throw;
    }
    if (run.playback.loop().quits() && !Interrupt::requested()) film.end_here();
    film.finish();
    if (film.frames() == header.planned_frames)
        remark(options.quiet, "frames and manifest.json are in {}",
               (options.update_golden ? options.golden : options.out).string());
    else if (Interrupt::requested() && options.update_golden)
        remark(false, "{}: the frames in {} are as they were", Interrupt::reason(),
               options.golden.string());
    else
        remark(false, "{}: {} of {} frames are complete in {}",
               Interrupt::requested() ? Interrupt::reason() : "the game has quit", film.frames(),
               header.planned_frames,
               (options.update_golden ? options.golden : options.out).string());
}

/// Names the hashes that differ from those of the manifest; empty if none does.
std::string changes_of(const Manifest::Frame& expected, std::uint64_t state, std::uint64_t picture,
                       std::uint64_t pixels) {
    std::string changes;
    const auto add = [&](bool equal, std::string_view name) {
        if (!equal) changes.append(changes.empty() ? "" : ", ").append(name);
    };
    add(expected.state_hash == state, "state");
    add(expected.picture_hash == picture, "picture");
    add(expected.pixel_hash == pixels, "pixels");
    return changes;
}

/// Draws one frame, and compares it with that of the manifest, if there is one.
Exit draw_still(const GameRun& run, Renderer& renderer, const Manifest& header) {
    const Span whole(run.profile, "frame");
    const Options& options = run.options;
    const std::int64_t frame = *options.frame;
    const HeadlessFrame at = headless_frame(frame, header.rate, header.fps);
    const Picture& picture = run.playback.show(at.step, at.alpha, run.inputs);
    if (Interrupt::requested()) return Exit::interrupted;
    Pixels pixels;
    {
        const Span span(run.profile, "draw");
        renderer.draw(picture, header.size);
    }
    {
        const Span span(run.profile, "read");
        renderer.read(pixels);
    }
    const auto path = options.out / fmt::format("still_{:06}.png", frame);
    make_folder(options.out);
    const Span span(run.profile, "encode");
    write_file(path, encode_png(pixels.size, pixels.rgb), kinds::png, Links::replaced);
    remark(options.quiet, "frame {}, tick {}, {:.6g} s: {}", frame, at.step,
           static_cast<double>(frame) / header.fps, path.string());
    if (!options.from) return Exit::done;
    if (frame >= std::int64_t(options.from->frames.size())) {
        remark(options.quiet, "the manifest has {} frames: nothing to compare with",
               options.from->frames.size());
        return Exit::done;
    }
    const std::string changes =
        changes_of(options.from->frames[static_cast<std::size_t>(frame)], run.playback.state_hash(),
                   hash_of(picture), hash_top_down(pixels.size, pixels.rgb));
    remark(options.quiet && changes.empty(), "{}",
           changes.empty() ? "state, picture and pixels are those of the manifest"
                           : "differs from the manifest: " + changes);
    return changes.empty() ? Exit::done : Exit::comparison_failed;
}

}  // namespace

Exit run_headless(GameRun& run) {
    const Options& options = run.options;
    const auto surface = open_offscreen(options.offscreen);
    Renderer renderer([&](const char* name) { return surface->procedure(name); });
    remark(options.quiet, "drawing with {} ({})", surface->provider(), renderer.gl_renderer());
    const Manifest header = describe(run, *surface, renderer);
    if (options.frame) return draw_still(run, renderer, header);
    film(run, renderer, header);
    return Interrupt::requested() ? Exit::interrupted : Exit::done;
}

}  // namespace oiler
