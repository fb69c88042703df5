// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler::bench {
namespace {

constexpr std::size_t elements = 10'000;

/// A disc for each body, as a game's `picture()` makes them.
Picture picture_of(const Bodies& bodies) {
    Picture picture;
    picture.discs.reserve(bodies.size());
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const Vec3 at = bodies.position(row);
        picture.discs.push_back({.key = {.object = row + 1},
                                 .centre = {static_cast<float>(at[0]), static_cast<float>(at[1])},
                                 .radius = 0.05F,
                                 .colour = palette::blue});
    }
    return picture;
}

Work clock_work(StepClock& clock, std::chrono::nanoseconds& now) {
    return [&](long times) {
        for (long i = 0; i < times; ++i)
            keep(clock.advance(now += std::chrono::microseconds(16667)));
    };
}

/// Frames are 1280 × 720.
void measure_frames(Bench& bench, const Picture& picture, std::size_t discs) {
    const std::unique_ptr<Surface> surface = open_offscreen(Offscreen::automatic);
    Renderer renderer([&](const char* name) { return surface->procedure(name); });
    constexpr Size size{1280, 720};
    Pixels pixels;
    const auto draw = [&](long times) {
        for (long i = 0; i < times; ++i) {
            renderer.draw(picture, size);
            renderer.read(pixels);
        }
    };
    const auto encode = [&](long times) {
        for (long i = 0; i < times; ++i) keep(encode_png(pixels.size, pixels.rgb));
    };
    draw(1);
    const std::vector<double> seconds = race({draw, encode}, bench.effort);
    bench.report.add("Frames of 1280 × 720 a second",
                     {fmt::format("{} discs, {}", in_powers(discs), surface->provider()),
                      {{"drawn and read back", 1 / seconds[0]},
                       {"encoded as PNG", 1 / seconds[1]},
                       {"both", 1 / (seconds[0] + seconds[1])}}});
}

}  // namespace

void bench_loop(Bench& bench) {
    if (!bench.wants("loop")) return;
    Bodies bodies = make_bodies(Scene::projectiles, 2, elements, Precision::single);
    const Picture before = picture_of(bodies);
    bodies.step(find_method("semi_implicit_euler"), {.rate = rate});
    const Picture after = picture_of(bodies);
    StepClock clock(60);
    std::chrono::nanoseconds now{0};
    const auto snapshot = [&](long times) {
        for (long i = 0; i < times; ++i) keep(picture_of(bodies));
    };
    const auto interpolate = [&](long times) {
        for (long i = 0; i < times; ++i) keep(between(before, after, 0.5F));
    };
    const std::vector<double> seconds =
        race({clock_work(clock, now), snapshot, interpolate}, bench.effort);
    const std::string title = "The loop around the step, ns";
    bench.report.add(title, {"StepClock::advance, a frame", {{"ns", Bench::ns(seconds[0], 1)}}});
    bench.report.add(title, {"picture, an element", {{"ns", Bench::ns(seconds[1], elements)}}});
    bench.report.add(title, {"between, an element", {{"ns", Bench::ns(seconds[2], elements)}}});
}

void bench_frames(Bench& bench) {
    if (!bench.wants("frames")) return;
    try {
        for (const std::size_t discs :
             {std::size_t{1000}, bench.full ? std::size_t{100'000} : std::size_t{10'000}}) {
            Picture picture =
                picture_of(make_bodies(Scene::projectiles, 2, discs, Precision::single));
            picture.camera = {.centre = {1.5F, -1.5F}, .height = 1.5F};
            measure_frames(bench, picture, discs);
        }
    } catch (const Error& error) {
        bench.report.missing(fmt::format("frames: {}", error.what()));
    }
}

}  // namespace oiler::bench
