// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <thread>

#include "oiler/app/console.hpp"
#include "oiler/app/interrupt.hpp"
#include "oiler/app/loops.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler {
namespace {

using Clock = std::chrono::steady_clock;

std::chrono::nanoseconds now() { return Clock::now().time_since_epoch(); }

/// Factor of simulated time over real time: a power of two from 1/16 to 16.
class Pace {
public:
    void slower() { exponent_ = std::max(exponent_ - 1, -4); }
    void faster() { exponent_ = std::min(exponent_ + 1, 4); }
    [[nodiscard]] int numerator() const { return 1 << std::max(exponent_, 0); }
    [[nodiscard]] int denominator() const { return 1 << std::max(-exponent_, 0); }
    [[nodiscard]] std::string text() const {
        if (exponent_ == 0) return {};
        return exponent_ > 0 ? fmt::format("{}× (- slower)", numerator())
                             : fmt::format("1/{}× (= faster)", denominator());
    }

private:
    int exponent_ = 0;
};

/// Handles the keys of the loop. Returns whether the user quits.
bool control(const Input& input, StepClock& clock, Pace& pace) {
    if (input.pressed(Key::p)) clock.paused() ? clock.resume() : clock.pause();
    if (input.pressed(Key::period) && clock.paused()) clock.single_step();
    if (input.pressed(Key::minus)) pace.slower();
    if (input.pressed(Key::equals)) pace.faster();
    clock.set_time_scale(pace.numerator(), pace.denominator());
    return input.pressed(Key::q) || input.pressed(Key::escape);
}

void add_status(Picture& picture, const StepClock& clock, const Pace& pace) {
    std::string status = clock.paused() ? "paused: P resumes, . steps" : "";
    if (!pace.text().empty()) status += (status.empty() ? "" : "   ") + pace.text();
    if (status.empty()) return;
    picture.labels.push_back({.at = {canvas_width / 2, 4},
                              .text = std::move(status),
                              .size = 11,
                              .colour = palette::vermilion,
                              .align = Align::centre});
}

void show(const Picture& picture, Renderer& renderer, Window& window) {
    const Size size = window.size();
    if (size.width == 0 || size.height == 0) return;  // minimised
    renderer.draw(picture, size);
    renderer.blit();
    window.present();
}

/// Sleeps until the frame's period ends, unless the display has already waited.
void limit_frame_rate(std::chrono::nanoseconds frame_start, int fps) {
    const std::chrono::nanoseconds period = std::chrono::nanoseconds(std::chrono::seconds(1)) / fps;
    const std::chrono::nanoseconds spent = now() - frame_start;
    if (spent < period * 4 / 5) std::this_thread::sleep_for(period - spent);
}

}  // namespace

Played run_window(Playback& playback, const Options& options, const About& about) {
    const auto window = open_window(options.size, std::string(about.title));
    Renderer renderer([&](const char* name) { return window->procedure(name); });
    remark(options.quiet, "drawing with {} ({}): P pause, . step, - and = pace, Q quit",
           window->provider(), renderer.gl_renderer());

    StepClock clock(static_cast<int>(options.settings.stepping.rate.steps));
    Pace pace;
    Input keys;      // since the last frame
    Input for_step;  // since the last step
    const int fps = options.fps.value_or(window->refresh_rate());
    bool quit = false;
    for (std::int64_t frame = 0; !quit && !Interrupt::requested(); ++frame) {
        const std::chrono::nanoseconds start = now();
        keys.forget_presses();
        const Window::State state = window->poll(keys);
        if (state == Window::State::lost) return {Exit::no_display, clock.dropped_time()};
        quit = state == Window::State::closed || (options.frames && frame + 1 >= *options.frames);
        quit = control(keys, clock, pace) || quit;
        for_step.gather(keys);
        clock.advance(start);
        Picture picture = playback.show(clock.ticks(), clock.alpha(), for_step);
        add_status(picture, clock, pace);
        show(picture, renderer, *window);
        limit_frame_rate(start, fps);
    }
    return {.dropped = clock.dropped_time()};
}

}  // namespace oiler
