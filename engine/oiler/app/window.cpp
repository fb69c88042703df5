// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

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
        return exponent_ > 0 ? fmt::format("{}× (F7 slower)", numerator())
                             : fmt::format("1/{}× (F8 faster)", denominator());
    }

private:
    int exponent_ = 0;
};

void control(Key key, StepClock& clock, Pace& pace, Playback& playback, InputQueue& queue) {
    switch (key) {
        case Key::f3:
            return clock.paused() ? clock.resume() : clock.pause();
        case Key::f5:
            if (clock.paused()) clock.single_step();
            return;
        case Key::f7:
            return pace.slower();
        case Key::f8:
            return pace.faster();
        case Key::f9:
            clock.resume();
            return playback.takes_input() ? queue.restart() : playback.restart();
        default:
            return;
    }
}

/// Escape quits a game that has no use for it.
bool uses_escape(const About& about) {
    const auto has_it = [](const Buttons& buttons) {
        return std::find(buttons.begin(), buttons.end(), Button(Key::escape)) != buttons.end();
    };
    return std::any_of(about.controls.begin(), about.controls.end(), [&](const Control& one) {
        return has_it(one.positive) || has_it(one.negative);
    });
}

void add_status(Picture& picture, const StepClock& clock, const Pace& pace) {
    std::string status = clock.paused() ? "paused: F3 resumes, F5 steps" : "";
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

Played run_window(Playback& playback, LiveInput& live, InputSource& inputs, const Options& options,
                  const About& about) {
    const auto window = open_window(options.size, std::string(about.title));
    Renderer renderer([&](const char* name) { return window->procedure(name); });
    remark(options.quiet, "drawing with {} ({}): F3 pause, F5 step, F7 and F8 pace, F9 restart{}",
           window->provider(), renderer.gl_renderer(), uses_escape(about) ? "" : ", Escape quits");

    StepClock clock(static_cast<int>(options.settings.stepping.rate.steps));
    Pace pace;
    std::vector<Key> loop_keys;
    const int fps = options.fps.value_or(window->refresh_rate());
    for (std::int64_t frame = 0; !Interrupt::requested(); ++frame) {
        const std::chrono::nanoseconds start = now();
        loop_keys.clear();
        const Window::State state = window->poll(live.queue, loop_keys);
        if (state == Window::State::lost) return {Exit::no_display, clock.dropped_time()};
        for (const Key key : loop_keys) control(key, clock, pace, playback, live.queue);
        clock.set_time_scale(pace.numerator(), pace.denominator());
        live.queue.set_paused(clock.paused());
        clock.advance(start);
        Picture picture = playback.show(clock.ticks(), clock.alpha(), inputs);
        window->take_text(playback.loop().takes_text());
        live.shown = picture.camera;
        add_status(picture, clock, pace);
        show(picture, renderer, *window);
        const bool escaped =
            !uses_escape(about) && std::ranges::find(loop_keys, Key::escape) != loop_keys.end();
        const bool last = (options.frames && frame + 1 >= *options.frames) ||
                          (options.replay && playback.steps() >= options.replay->steps);
        if (state == Window::State::closed || escaped || last || playback.loop().quits()) break;
        limit_frame_rate(start, fps);
    }
    return {.dropped = clock.dropped_time()};
}

}  // namespace oiler
