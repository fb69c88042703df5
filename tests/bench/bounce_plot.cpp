// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "bench/bounces.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"

namespace oiler::bench {
namespace {

struct Curve {
    std::string_view row;
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
        if (find(report, free_bounces, curve.row))
            plot.series.push_back(series_of(find(report, section, curve.row), curve));
    return plot;
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

}  // namespace oiler::bench
