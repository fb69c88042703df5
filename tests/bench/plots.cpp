// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/plots.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::bench {
namespace {

/// A curve of a row, or of a column.
struct Curve {
    std::string_view of;
    std::string_view name;
    Colour colour;
    Mark mark;
    bool dashed = false;
};
constexpr std::array curves{
    Curve{"Bullet", "Bullet", palette::grey, Mark::diamond, true},
    Curve{"Box2D", "Box2D", palette::purple, Mark::triangle, true},
    Curve{"ODE", "ODE", palette::black, Mark::ring, true},
    // The curve of rk4 is the same to the width of a line.
    Curve{"velocity_verlet, at the end of a step", "Verlet, RK4, at the end", palette::vermilion,
          Mark::square, true},
    Curve{"semi_implicit_euler", "semi_implicit_euler", palette::sky_blue, Mark::disc},
    Curve{"velocity_verlet", "velocity_verlet", palette::blue, Mark::disc},
    Curve{"rk4", "rk4", palette::green, Mark::disc}};

constexpr std::array caption{
    "Solid lines: Oiler locates impacts within the step. Dashed lines: the same methods, bounced "
    "at the",
    "end of a step, and other libraries with their default settings. A line ends where the ball "
    "sticks to",
    "the floor. Errors below 1e-14 m are round-off."};

/// The smallest error that is drawn, m; half a unit of round-off of the apex.
constexpr double least_error = 5e-17;

/// Null if the report has no such row.
const Row* find(const Report& report, std::string_view title, std::string_view name) {
    for (const Section& section : report.sections())
        for (const Row& row : section.rows)
            if (section.title == title && row.name == name) return &row;
    return nullptr;
}

Series series_of(const Row* row, const Curve& curve) {
    Series series{.name = std::string(curve.name),
                  .colour = curve.colour,
                  .mark = curve.mark,
                  .dashed = curve.dashed};
    if (!row) return series;
    for (const int rate : bounce_rates)
        for (const auto& [column, error] : row->numbers)
            if (column == column_of(rate))
                series.points.push_back({double(rate), std::max(std::abs(error), least_error)});
    return series;
}

/// The legend has all curves that a report has without drag.
Plot panel(Box box, std::string title, const Report& report, std::string_view section) {
    Plot plot{.box = box,
              .title = std::move(title),
              .x_label = "rate, Hz",
              .y_label = "error of the tenth apex, m",
              .x = {17, 750},
              .y = {least_error, 10},
              .x_scale = Scale::logarithmic,
              .y_scale = Scale::logarithmic,
              .y_ticks = 8};
    for (const Curve& curve : curves)
        if (find(report, free_bounces, curve.of))
            plot.series.push_back(series_of(find(report, section, curve.of), curve));
    return plot;
}

constexpr int drawn_rate = 20;  // Hz
constexpr double drawn = 4;     // s, until it meets the wall

using Points = std::vector<DataPoint>;

DataPoint point_of(const World& world) {
    const Vec3 x = world.position(world.entity_of_row(0));
    return {x[0], x[1]};
}

World start(const Scene& scene) {
    return make_world(scene, {.stepping = {.method = &find_method("velocity_verlet"),
                                           .rate = {drawn_rate},
                                           .precision = Precision::double_}});
}

Points exact_path(const World& world) {
    constexpr int samples = 1000;  // per second
    const auto motions = lab::exact_motions(world.bodies(), drawn);
    Points path;
    for (int i = 0; motions && i <= drawn * samples; ++i) {
        const auto x = motions->front()(static_cast<long double>(i) / samples).x;
        path.push_back({static_cast<double>(x[0]), static_cast<double>(x[1])});
    }
    return path;
}

/// The positions after each step.
template <class Step>
Points path_of(World& world, Step step) {
    Points path{point_of(world)};
    while (world.time() < drawn) {
        step();
        path.push_back(point_of(world));
    }
    return path;
}

Points located_path(World world) {
    return path_of(world, [&] { world.step(); });
}

Points path_at_end(const Scene& scene) {
    World world = start(scene);
    world.clear_planes();
    return path_of(world, [&] {
        world.step();
        for (const ScenePlane& plane : scene.planes)
            bounce_at_end(world, world.entity_of_row(0), plane.plane,
                          scene.bodies.front().matter.contact.value_or(0));
    });
}

constexpr std::string_view costs = "Steps, ns per body and step";
constexpr std::array sizes{1000.0, 1e4, 1e5, 1e6, 4e6, 1e7};

constexpr std::array cost_curves{
    Curve{"sweep", "sweep", palette::black, Mark::none},
    Curve{"by hand", "hand-written loop", palette::sky_blue, Mark::ring},
    Curve{"one step", "Oiler", palette::blue, Mark::disc},
    Curve{"by hand, in registers", "hand-written, 256 per call", palette::orange, Mark::ring},
    Curve{"256 at once", "Oiler, 256 per call", palette::vermilion, Mark::disc}};

/// The curve of a column.
Series cost_series(const Report& report, const std::string& scene, const Curve& curve) {
    Series series{.name = std::string(curve.name), .colour = curve.colour, .mark = curve.mark};
    for (const double bodies : sizes)
        if (const Row* const row =
                find(report, costs,
                     scene + ", float, 3 axes, " + in_powers(static_cast<std::size_t>(bodies))))
            for (const auto& [column, value] : row->numbers)
                if (column == curve.of) series.points.push_back({bodies, value});
    return series;
}

/// The range of all points, with a margin.
void set_ranges(Plot& plot) {
    plot.x = {900, 1.1e6};
    plot.y = {INFINITY, 0};
    for (const Series& series : plot.series)
        for (const DataPoint& point : series.points) {
            plot.x.high = std::max(plot.x.high, 1.1 * point.x);
            plot.y = {std::min(plot.y.low, 0.8 * point.y), std::max(plot.y.high, 1.25 * point.y)};
        }
}

void draw_costs(const Report& report, const std::filesystem::path& folder) {
    for (const char* scene : {"projectiles", "springs"}) {
        Plot plot{
            .box = {{52, 72}, {628, 312}},
            .title = fmt::format("The cost of a step of {}", scene),
            .remark = "semi_implicit_euler, float, 3 axes",
            .caption =
                "The sweep reads and writes each body once, in place: the least time of one step "
                "per call. Hand-written loops serve this force and this method only. With 256 "
                "steps per call, bodies stay in registers.",
            .x_label = "bodies",
            .y_label = "ns per body and step",
            .x_scale = Scale::logarithmic,
            .y_scale = Scale::logarithmic};
        for (const Curve& curve : cost_curves)
            plot.series.push_back(cost_series(report, scene, curve));
        if (plot.series.front().points.empty()) continue;
        set_ranges(plot);
        Picture picture;
        plot.draw(picture, {});
        Stills({1280, 720}).write(picture, folder / fmt::format("cost_{}.png", scene));
    }
}

}  // namespace

void draw_bounce_errors(const Report& report, const std::filesystem::path& folder) {
    Picture picture;
    Plot left = panel({{44, 88}, {228, 316}}, "Ten bounces, no drag", report, free_bounces);
    for (Series& series : left.series) series.name.clear();
    left.draw(picture, {});
    Plot right =
        panel({{276, 88}, {460, 316}}, "With a linear drag of 0.3/s", report, dragged_bounces);
    right.legend_beside = true;
    right.draw(picture, {});
    float y = 46;
    for (const char* line : caption) {
        picture.labels.push_back({.at = {44, y}, .text = line, .size = 10, .colour = palette::ink});
        y -= 14;
    }
    Stills({1280, 720}).write(picture, folder / "bounces.png");
}

void draw_ball_path(const std::filesystem::path& folder) {
    const Scene scene = read_scene(OILER_SOURCE "/assets/scenes/bouncing_ball.toml");
    const World world = start(scene);
    const Plot plot{
        .box = {{36, 56}, {628, 320}},
        .title = fmt::format("A bouncing ball at {} steps per second", drawn_rate),
        .remark = "velocity_verlet",
        .caption = "A mark for the centre of the ball after each step; its radius is 0.2 m.",
        .x_label = "x, m",
        .y_label = "y, m",
        .x = {0, 9},
        .y = {0, 4.2},
        .series = {{.name = "exact", .colour = palette::grey, .points = exact_path(world)},
                   {.name = "bounces at the end of a step",
                    .colour = palette::vermilion,
                    .points = path_at_end(scene),
                    .width = 1,
                    .mark = Mark::ring},
                   {.name = "bounces within the step",
                    .colour = palette::blue,
                    .points = located_path(world),
                    .width = 0,
                    .mark = Mark::disc}}};
    Picture picture;
    plot.draw(picture, {});
    Stills({1280, 720}).write(picture, folder / "bouncing_ball.png");
}

void draw_plots(const Report& report, const std::filesystem::path& folder) {
    make_folder(folder);
    draw_costs(report, folder);
    if (std::ranges::find(report.sections(), free_bounces, &Section::title) ==
        report.sections().end())
        return;
    draw_bounce_errors(report, folder);
    draw_ball_path(folder);
}

}  // namespace oiler::bench
