// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "oiler/app/console.hpp"
#include "oiler/app/interrupt.hpp"
#include "oiler/app/loops.hpp"
#include "oiler/capture/capture.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/core/version.hpp"
#include "oiler/render/renderer.hpp"

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

Manifest describe(const Options& options, const About& about, int fps, const Surface& surface,
                  const Renderer& renderer) {
    return {.version = std::string(version()),
            .compiler = compiler(),
            .provider = std::string(surface.provider()),
            .gl_renderer = renderer.gl_renderer(),
            .gl_version = renderer.gl_version(),
            .size = options.size,
            .fps = fps,
            .rate = static_cast<int>(options.settings.stepping.rate.steps),
            .method = std::string(options.settings.stepping.method->name),
            .precision = std::string(name_of(options.settings.stepping.precision)),
            .scene = std::string(about.name),
            .seed = options.settings.seed,
            .frames = {}};
}

/// Finishes after an error, which matters more than a second one of the same disk.
void finish_ignoring_errors(const Capture& capture) {
    try {
        capture.finish();
    } catch (const Error&) {
    }
}

/// Draws frames into the folder. `header` is the manifest without frames.
void film(Playback& playback, Renderer& renderer, const Manifest& header, std::int64_t frames,
          const Options& options) {
    // Made with the first frame, so that a failure to draw leaves no folder.
    std::optional<Capture> capture;
    Progress progress(options.quiet, "frames", frames);
    Pixels pixels;
    Input no_input;
    try {
        for (std::int64_t frame = 0; frame < frames; ++frame) {
            const HeadlessFrame at = headless_frame(frame, header.rate, header.fps);
            const Picture picture = playback.show(at.step, at.alpha, no_input);
            if (Interrupt::requested()) break;
            renderer.draw(picture, header.size);
            renderer.read(pixels);
            if (!capture) capture.emplace(options.out, header);
            capture->add(at.step, at.alpha, playback.state_hash(), pixels.size, pixels.rgb);
            progress.show(frame + 1);
        }
    } catch (const Error&) {
        if (capture) finish_ignoring_errors(*capture);
        throw;
    }
    if (capture) capture->finish();
}

}  // namespace

void run_headless(Playback& playback, const Options& options, const About& about) {
    const auto surface = open_offscreen(options.offscreen);
    Renderer renderer([&](const char* name) { return surface->procedure(name); });
    remark(options.quiet, "drawing with {} ({})", surface->provider(), renderer.gl_renderer());
    const int fps = options.fps.value_or(default_fps);
    const std::int64_t frames = options.frames ? *options.frames : frames_in(about.duration, fps);
    film(playback, renderer, describe(options, about, fps, *surface, renderer), frames, options);
    if (!Interrupt::requested())
        remark(options.quiet, "frames and manifest.json are in {}", options.out.string());
}

}  // namespace oiler
