// SPDX-License-Identifier: MIT
// One undamped spring, stepped by six methods beside the exact motion: which of them gain energy,
// which keep it, which lose it? One slider sets the rate of all.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "oiler/core/error.hpp"
#include "oiler/oiler.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/plot/plot.hpp"

using namespace oiler;

namespace {

constexpr Action slower{"lower rate", Key::left, Key::a, Pad::left};
constexpr Action faster{"higher rate", Key::right, Key::d, Pad::right};
constexpr Action grab{"drag the slider", Mouse::left};

constexpr std::array rates{10, 12, 15, 20, 24, 30, 40, 48, 60, 80, 120, 240};  // Hz
constexpr std::size_t first_rate = 8;
constexpr double omega = 2 * std::numbers::pi;  // rad/s: one oscillation per second
constexpr double stiffness = omega * omega;     // N/m, of a mass of 1 kg that starts at 1 m
constexpr double start_energy = stiffness / 2;  // J
constexpr int duration = 10;                    // s

struct Lane {
    std::string_view method;
    Colour colour;
};
constexpr std::array lanes{Lane{"explicit_euler", palette::vermilion},
                           Lane{"rk2_midpoint", palette::orange},
                           Lane{"semi_implicit_euler", palette::green},
                           Lane{"velocity_verlet", palette::blue},
                           Lane{"rk4", palette::purple},
                           Lane{"implicit_euler", palette::sky_blue}};

struct Sample {
    double t, x, v;
    [[nodiscard]] double energy() const { return (v * v + stiffness * x * x) / 2 / start_energy; }
};

/// A whole run of one method: a sample at each step.
struct Run {
    std::vector<Sample> samples;
    double growth;  ///< factor of the energy per oscillation
    double wobble;  ///< largest deviation of the energy from that of the start, relative

    /// As a display shows it: on the straight line between two samples.
    [[nodiscard]] Sample at(double t) const {
        const double step = t / duration * static_cast<double>(samples.size() - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(step), samples.size() - 2);
        const double part = step - static_cast<double>(i);
        const Sample &a = samples[i], &b = samples[i + 1];
        return {t, std::lerp(a.x, b.x, part), std::lerp(a.v, b.v, part)};
    }
};

Run simulate(std::string_view method, std::int64_t rate) {
    World world(1, Stepping{.method = &find_method(method), .rate = {rate}});
    const Entity mass = world.spawn(Body{.position = {1}}, Spring{.stiffness = stiffness});
    Run run{};
    for (; world.tick() <= duration * rate; world.step())
        run.samples.push_back({world.time(), world.position(mass)[0], world.velocity(mass)[0]});
    // A step multiplies all areas of the phase plane by one factor, and the energy by the same on
    // average.
    const auto area = [&](std::size_t i) {
        const Sample &a = run.samples[i], &b = run.samples[i + 1];
        return a.x * b.v - b.x * a.v;
    };
    run.growth = std::pow(area(1) / area(0), rate);
    for (const Sample& sample : run.samples)
        run.wobble = std::max(run.wobble, std::abs(sample.energy() - 1));
    return run;
}

/// The runs of all lanes at each rate.
using Runs = std::array<std::array<Run, lanes.size()>, rates.size()>;
const Runs& all_runs() {
    static const Runs runs = [] {
        Runs made;
        for (std::size_t r = 0; r < rates.size(); ++r)
            for (std::size_t i = 0; i < lanes.size(); ++i)
                made[r][i] = simulate(lanes[i].method, rates[r]);
        return made;
    }();
    return runs;
}

std::string describe(const Run& run) {
    constexpr double noticed = 1e-5;
    const double percent = 100 * std::abs(run.growth - 1);
    const std::string per = percent < 100 ? fmt::format("{:.2g} % per oscillation", percent)
                                          : fmt::format("{:.0f} % per oscillation", percent);
    if (run.growth > 1 + noticed) return "▲ gains " + per;
    if (run.growth < 1 - noticed) return "▼ loses " + per;
    if (run.wobble < 0.001) return "= keeps its energy";
    return fmt::format("= keeps its energy within {:.2g} %", 100 * run.wobble);
}

constexpr Box slider{{206, 28}, {612, 28}};
float place_of(std::size_t rate) {
    return std::lerp(slider.low.x, slider.high.x,
                     static_cast<float>(rate) / static_cast<float>(rates.size() - 1));
}

}  // namespace

struct IntegratorRace {
    static constexpr Control controls[] = {slower, faster, grab};
    static constexpr About about{.name = "integrator_race",
                                 .title = "Six methods: which gain energy, which lose it?",
                                 .rate = 240,
                                 .duration = duration,
                                 .controls = controls,
                                 .changes_in_play = false,
                                 .fixed_setting =
                                     "The slider in the picture sets the rate of all "
                                     "lanes; each has its own method."};

    World world;  // only its time counts: the lanes are runs of their own
    std::size_t rate = first_rate;
    bool is_grabbed = false;

    explicit IntegratorRace(const Settings& settings) : world(1, settings) {
        if (settings.stepping != Stepping{.rate = {about.rate}})
            fail(Exit::usage,
                 "each lane has its own method, and the slider sets the rate of all: no other "
                 "setting applies");
    }
    /// Adds what the world does not hold to the hash of a state.
    void hash(StateHash& hash) const { hash.add(rate, is_grabbed); }

    void update(const Input& input) {
        if (input.pressed(faster)) rate = std::min(rate + 1, rates.size() - 1);
        if (input.pressed(slower) && rate > 0) --rate;
        const std::optional<Point> mouse = input.pointer_canvas();
        if (input.pressed(grab)) is_grabbed = mouse && mouse->y < 56;
        if (!input.held(grab)) is_grabbed = false;
        if (!is_grabbed || !mouse) return;
        const float share = (mouse->x - slider.low.x) / (slider.high.x - slider.low.x);
        rate = static_cast<std::size_t>(
            std::lround(std::clamp(share, 0.0F, 1.0F) * static_cast<float>(rates.size() - 1)));
    }

    /// s, since the last start.
    double time() const { return std::fmod(world.time(), duration); }
    Sample exact(double t) const {
        const Motion<double> at = damped_oscillator(1.0, stiffness, 0.0, {1.0, 0.0}, t);
        return {t, at.x, at.v};
    }

    Picture picture() const {
        Picture picture;
        const auto& runs = all_runs()[rate];
        const Sample truth = exact(time());
        for (std::size_t i = 0; i < lanes.size(); ++i)
            draw_lane(picture, i, lanes[i], runs[i].at(time()), truth, describe(runs[i]));
        draw_lane(picture, lanes.size(), {"exact", palette::ink}, truth, truth,
                  "= keeps its energy");
        add_text(picture, {14, 338},
                 "One undamped spring, one oscillation per second. Rings show the exact motion.", 9,
                 palette::grey);
        draw_portrait(picture);
        draw_energies(picture);
        draw_slider(picture);
        return picture;
    }

    void draw_lane(Picture& picture, std::size_t index, const Lane& lane, const Sample& now,
                   const Sample& truth, const std::string& result) const {
        constexpr float left = 14, right = 366, metre = 60, reach = 2.5F, radius = 7;
        const float y = 322 - 38.5F * static_cast<float>(index);
        const float strip = y - 14, centre = (left + right) / 2;
        add_text(picture, {left, y}, std::string(lane.method), 10, lane.colour);
        add_text(picture, {right, y}, result, 10, palette::ink, Align::right);
        const auto place = [&](double x) {
            return Point{centre + metre * std::clamp(static_cast<float>(x), -reach, reach), strip};
        };
        const auto line = [&](std::vector<Point> points, float width, Colour colour,
                              ElementKey key = {}) {
            picture.polylines.push_back({.key = key,
                                         .points = std::move(points),
                                         .width = width,
                                         .colour = colour,
                                         .space = Space::canvas});
        };
        const auto part = static_cast<std::uint32_t>(index);
        const auto round = static_cast<std::uint32_t>(world.time() / duration);
        const ElementKey key{1, part, round}, ring{2, part, round};
        line({{left, strip}, {right, strip}}, 0.5F, palette::pale);
        for (const double x : {-1, 0, 1}) {
            const Point at = place(x);
            line({{at.x, strip - 5}, {at.x, strip + 5}}, 0.5F, palette::grey);
        }
        line({{left, strip - 9}, {left, strip + 9}}, 2, palette::ink);
        const bool is_out = std::abs(now.x) > reach;
        if (!is_out) line(coil({left, strip}, place(now.x), 12, 4), 1, palette::grey, key);
        line(circle(place(truth.x), radius + 2), 1, palette::ink, ring);
        picture.discs.push_back({.key = key,
                                 .centre = place(now.x),
                                 .radius = radius,
                                 .colour = lane.colour,
                                 .space = Space::canvas});
        if (!is_out) return;
        const double distance = std::abs(now.x);
        const std::string words = distance < 100   ? fmt::format("{:.1f} m", distance)
                                  : distance < 1e4 ? fmt::format("{:.0f} m", distance)
                                                   : fmt::format("{:.0f} km", distance / 1000);
        const Point disc = place(now.x);
        if (now.x > 0)
            add_text(picture, {disc.x - 11, strip - 3}, words + " ▶", 9, palette::ink,
                     Align::right);
        else
            add_text(picture, {disc.x + 11, strip - 3}, "◀ " + words, 9, palette::ink);
    }

    void draw_portrait(Picture& picture) const {
        Plot plot{.box = {{456, 190}, {584, 318}},
                  .x_label = "position, m",
                  .y_label = "velocity, m/s: the last second",
                  .x = {-2, 2},
                  .y = {-2 * omega, 2 * omega},
                  .x_ticks = 4};
        Series circle{.colour = palette::pale, .width = 5};
        for (int i = 0; i <= 100; ++i) {
            const Sample at = exact(i / 100.0);
            circle.points.push_back({at.x, at.v});
        }
        plot.series.push_back(circle);
        for (std::size_t i = 0; i < lanes.size(); ++i) {
            const Run& run = all_runs()[rate][i];
            Series trail{.colour = lanes[i].colour};
            for (const Sample& sample : run.samples)
                if (sample.t > time() - 1 && sample.t < time())
                    trail.points.push_back({sample.x, sample.v});
            const Sample now = run.at(time());
            trail.points.push_back({now.x, now.v});
            plot.series.push_back(trail);
            plot.series.push_back(
                {.colour = lanes[i].colour, .points = {{now.x, now.v}}, .mark = Mark::disc});
        }
        plot.draw(picture, {});
    }

    void draw_energies(Picture& picture) const {
        Plot plot{.box = {{416, 76}, {624, 150}},
                  .x_label = "time, s",
                  .y_label = "energy / energy at the start",
                  .x = {0, duration},
                  .y = {0.01, 100},
                  .y_scale = Scale::logarithmic,
                  .x_ticks = 5};
        plot.series.push_back(
            {.colour = palette::pale, .points = {{0, 1}, {duration, 1}}, .width = 5});
        for (std::size_t i = 0; i < lanes.size(); ++i) {
            const Run& run = all_runs()[rate][i];
            Series curve{.colour = lanes[i].colour};
            for (const Sample& sample : run.samples)
                curve.points.push_back({sample.t, sample.energy()});
            plot.series.push_back(curve);
        }
        plot.series.push_back({.colour = palette::ink,
                               .points = {{time(), plot.y.low}, {time(), plot.y.high}},
                               .width = 0.75F});
        plot.draw(picture, {});
    }

    void draw_slider(Picture& picture) const {
        add_text(picture, {14, 22}, fmt::format("{} Hz", rates[rate]), 22, palette::ink);
        add_text(picture, {112, 36}, "Drag the slider,", 9, palette::grey);
        add_text(picture, {112, 22}, "or press ← →", 9, palette::grey);
        picture.polylines.push_back({.points = {slider.low, slider.high},
                                     .width = 3,
                                     .colour = palette::pale,
                                     .space = Space::canvas});
        for (std::size_t i = 0; i < rates.size(); ++i)
            add_text(picture, {place_of(i), 10}, fmt::format("{}", rates[i]), 9,
                     i == rate ? palette::ink : palette::grey, Align::centre);
        picture.discs.push_back({.centre = {place_of(rate), slider.low.y},
                                 .radius = 8,
                                 .colour = palette::ink,
                                 .space = Space::canvas});
    }
};

int main(int argc, char** argv) { return run<IntegratorRace>(argc, argv); }
