// SPDX-License-Identifier: MIT
// Shows the article's spring and damper: the position over the exact position, and the error below.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "oiler/app/run.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/plot/plot.hpp"

using namespace oiler;

namespace {

constexpr double stiffness = 15;  // N/m
constexpr double damping = 0.1;   // N·s/m
constexpr double start = 1000;    // m
constexpr double page = 20;       // s on the time axis
constexpr double spacing = 0.01;  // s between two points of a curve

struct Sample {
    double t, simulated, exact;
};

double exact_position(double t) {
    return damped_oscillator(1.0, stiffness, damping, {start, 0.0}, t).x;
}

/// The smallest 1, 2 or 5 times a power of ten that is ≥ `value`; 1 for 0.
double round_up(double value) {
    if (value == 0 || !std::isfinite(value)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= value) return factor * power;
    return 10 * power;
}

/// One digit behind the point, or three digits of a large number.
std::string metres(double x) {
    return std::abs(x) < 1e5 ? fmt::format("{:.1f} m", x) : fmt::format("{:.3g} m", x);
}

/// A `jump` for ElementKey: curves of different scales are not interpolated.
std::uint32_t scale_of(double scale) {
    return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(scale) >> 32U);
}

}  // namespace

struct SpringDamper {
    static constexpr About about{.name = "spring_damper", .title = "Spring and damper"};

    World world;
    Entity mass;
    std::vector<Sample> samples;  // of the current page
    double largest_error = 0;
    double largest_distance = start;  // from the position of rest, m

    explicit SpringDamper(const Settings& settings)
        : world(1, settings),
          mass(world.spawn(Body{.mass = 1, .position = {start}},
                           Spring{.stiffness = stiffness, .damping = damping})) {
        world.add(mass, Name{"mass"});
    }

    void update(const Input&) {
        const Sample now = sample();
        if (std::floor(now.t / page) != std::floor(samples.empty() ? 0 : samples.back().t / page))
            samples.clear();
        if (samples.empty() || now.t - samples.back().t >= spacing) samples.push_back(now);
        largest_error = std::max(largest_error, std::abs(now.simulated - now.exact));
        largest_distance = std::max(largest_distance, std::abs(now.simulated));
    }

    Sample sample() const {
        return {world.time(), world.position(mass)[0], exact_position(world.time())};
    }

    /// Half of the room for the motion, m. It grows with an unstable run.
    double reach() const {
        const double largest = std::max(largest_distance, std::abs(world.position(mass)[0]));
        return 1.1 * round_up(largest / 1.1);
    }

    Picture picture() const {
        // A camera has floats: beyond 1e37 m the mass leaves it.
        const auto height = static_cast<float>(1.7 * std::min(reach(), 1e37));
        Picture picture{.camera = {.centre = {0, -0.31F * height}, .height = height}};
        draw_spring(picture);
        draw_curves(picture);
        draw_labels(picture);
        return picture;
    }

    /// Draws the wall beyond the reach of the mass. The spring has no length of its own: only the
    /// distance from the position of rest, the pale line, pulls.
    void draw_spring(Picture& picture) const {
        const float radius = picture.camera.height / 30;
        const float wall = -0.7F * picture.camera.height;
        const Point at = to_point(world.position(mass));
        const ElementKey key = key_of(world, mass);
        const auto upright = [&](float x, float width, Colour colour) {
            picture.polylines.push_back({.points = {{x, -1.5F * radius}, {x, 1.5F * radius}},
                                         .width = width,
                                         .colour = colour});
        };
        upright(wall, 3, palette::ink);
        upright(0, 1, palette::pale);
        picture.polylines.push_back({.key = key,
                                     .points = coil({wall, 0}, at, 12, 0.75F * radius),
                                     .width = 1.5F,
                                     .colour = palette::grey});
        picture.discs.push_back(
            {.key = key, .centre = at, .radius = radius, .colour = palette::vermilion});
        picture.polylines.push_back(
            {.key = key_of(world, mass, 1),
             .points = circle({static_cast<float>(sample().exact), 0}, 1.25F * radius),
             .width = 2,
             .colour = palette::sky_blue});
    }

    void draw_curves(Picture& picture) const {
        std::vector<Sample> shown = samples;
        shown.push_back(sample());
        const double from = std::floor(shown.front().t / page) * page;
        const Range time{from, from + page};
        Series simulated{
            .name = "simulated", .colour = palette::vermilion, .points = {}, .width = 1.5F};
        Series error{.name = "", .colour = palette::vermilion, .points = {}, .width = 1.5F};
        Series exact{.name = "exact", .colour = palette::sky_blue, .points = {}, .width = 4};
        double largest = 0;
        for (const Sample& s : shown) {
            simulated.points.push_back({s.t, s.simulated});
            error.points.push_back({s.t, s.simulated - s.exact});
            largest = std::max(largest, std::abs(s.simulated - s.exact));
        }
        for (double t = from; t <= from + page; t += page / 1000)
            exact.points.push_back({t, exact_position(t)});
        const ElementKey key{.object = mass.id(), .part = 10, .jump = scale_of(from + reach())};
        Plot{.box = {{56, 152}, {624, 256}},
             .title = "",
             .x_label = "",
             .y_label = "position, m",
             .x = time,
             .y = {-reach(), reach()},
             .series = {exact, simulated}}
            .draw(picture, key);
        const double most = round_up(largest);
        Plot{.box = {{56, 36}, {624, 112}},
             .title = "",
             .x_label = "time, s",
             .y_label = "error: simulated − exact, m",
             .x = time,
             .y = {-most, most},
             .series = {error}}
            .draw(picture, {key.object, 20, scale_of(from + most)});
    }

    void draw_labels(Picture& picture) const {
        const Sample now = sample();
        add_text(picture, {16, 340}, caption(world.settings().stepping), 13, palette::ink);
        add_text(picture, {624, 340}, "k = 15 N/m, b = 0.1 N·s/m, m = 1 kg", 11, palette::grey,
                 Align::right);
        add_text(
            picture, {16, 324},
            fmt::format("t = {:.2f} s   x = {}   exact {}   largest error {}", now.t,
                        metres(now.simulated), metres(now.exact),
                        length_text(std::max(largest_error, std::abs(now.simulated - now.exact)))),
            11, palette::ink);
    }
};

int main(int argc, char** argv) { return run<SpringDamper>(argc, argv); }
