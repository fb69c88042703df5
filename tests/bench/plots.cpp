// SPDX-License-Identifier: MIT
#include "bench/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/bounces.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"

namespace oiler::bench {
namespace {

constexpr Box box{{52, 72}, {628, 312}};
constexpr std::array sizes{1000.0, 1e4, 1e5, 1e6, 4e6, 1e7};

struct Curve {
    std::string_view column;
    std::string_view name;
    Colour colour;
    Mark mark;
};
constexpr std::array curves{
    Curve{"sweep", "sweep", palette::black, Mark::none},
    Curve{"by hand", "hand-written loop", palette::sky_blue, Mark::ring},
    Curve{"one step", "Oiler", palette::blue, Mark::disc},
    Curve{"by hand, in registers", "hand-written, 256 per call", palette::orange, Mark::ring},
    Curve{"256 at once", "Oiler, 256 per call", palette::vermilion, Mark::disc}};

/// The curve of a column, in decades on both axes.
Series series_of(const Section& section, const std::string& scene, const Curve& curve) {
    Series series{.name = std::string(curve.name), .colour = curve.colour, .mark = curve.mark};
    for (const double bodies : sizes) {
        const std::string name =
            scene + ", float, 3 axes, " + in_powers(static_cast<std::size_t>(bodies));
        const auto row = std::ranges::find(section.rows, name, &Row::name);
        if (row == section.rows.end()) continue;
        for (const auto& [column, value] : row->numbers)
            if (column == curve.column)
                series.points.push_back({std::log10(bodies), std::log10(value)});
    }
    return series;
}

void add_line(Picture& picture, Point from, Point to) {
    picture.polylines.push_back(
        {.points = {from, to}, .width = 0.75F, .colour = palette::pale, .space = Space::canvas});
}

void add_number(Picture& picture, Point at, std::string words, Align align) {
    picture.labels.push_back(
        {.at = at, .text = std::move(words), .size = 9, .colour = palette::ink, .align = align});
}

/// Draws grid lines and numbers, because the plot's own axes are linear: at powers of ten across,
/// at 1, 2 and 5 times these upwards.
void draw_grid(Picture& picture, const Plot& plot) {
    for (double power = std::ceil(plot.x.low); power <= plot.x.high; ++power) {
        const float x = plot.to_canvas({power, plot.y.low}).x;
        add_line(picture, {x, box.low.y}, {x, box.high.y});
        add_number(picture, {x, box.low.y - 11},
                   in_powers(static_cast<std::size_t>(std::llround(std::pow(10, power)))),
                   Align::centre);
    }
    for (const double value : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
        const double at = std::log10(value);
        if (at < plot.y.low || at > plot.y.high) continue;
        const float y = plot.to_canvas({plot.x.low, at}).y;
        add_line(picture, {box.low.x, y}, {box.high.x, y});
        add_number(picture, {box.low.x - 4, y - 3}, fmt::format("{:g}", value), Align::right);
    }
}

/// The range of all points, with a margin.
void set_ranges(Plot& plot) {
    plot.x = {3, 6};
    plot.y = {INFINITY, -INFINITY};
    for (const Series& series : plot.series)
        for (const DataPoint& point : series.points) {
            plot.x.high = std::max(plot.x.high, point.x);
            plot.y = {std::min(plot.y.low, point.y), std::max(plot.y.high, point.y)};
        }
    plot.x = {plot.x.low - 0.05, plot.x.high + 0.05};
    plot.y = {plot.y.low - 0.1, plot.y.high + 0.1};
}

Picture picture_of(const Section& section, const std::string& scene) {
    Plot plot{.box = box,
              .title = fmt::format("The cost of a step of {}", scene),
              .remark = "semi_implicit_euler, float, 3 axes",
              .caption =
                  "The sweep reads and writes each body once, in place: the least time of one step "
                  "per call. Hand-written loops serve this force and this method only. With 256 "
                  "steps per call, bodies stay in registers.",
              .x_label = "bodies",
              .y_label = "ns per body and step",
              .x_ticks = 0,
              .y_ticks = 0};
    for (const Curve& curve : curves) plot.series.push_back(series_of(section, scene, curve));
    set_ranges(plot);
    Picture picture;
    if (plot.series.front().points.empty()) return picture;
    draw_grid(picture, plot);
    plot.draw(picture, {});
    return picture;
}

void draw_costs(const Report& report, const std::filesystem::path& folder) {
    const auto section =
        std::ranges::find(report.sections(), "Steps, ns per body and step", &Section::title);
    if (section == report.sections().end()) return;
    Stills stills({1280, 720});
    for (const char* scene : {"projectiles", "springs"}) {
        const Picture picture = picture_of(*section, scene);
        if (!picture.labels.empty())
            stills.write(picture, folder / fmt::format("cost_{}.png", scene));
    }
}

}  // namespace

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
