// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "oiler/certify/region.hpp"
#include "oiler/picture/palette.hpp"

namespace oiler::certify {
namespace {

constexpr int most_across = 7;
constexpr Point panel_size{89, 53};  // with the most across; fewer are larger
constexpr Point panel_margin{8, 8};  // left and below, for numbers
constexpr Point plane_size{78, 37};
constexpr float top = 327;
constexpr float title_size = 5.4F;
constexpr float number_size = 4.6F;

constexpr Colour stable = palette::sky_blue;
constexpr Colour differs = palette::vermilion;

/// Where panels lie on the canvas.
struct Layout {
    int across = most_across;

    [[nodiscard]] float scale() const {
        return static_cast<float>(most_across) / static_cast<float>(across);
    }
    /// Of texts and ticks, which grow less than panels.
    [[nodiscard]] float text_scale() const { return std::min(scale(), 1.8F); }
};

/// The largest panels above the legend.
Layout layout_of(std::size_t panels) {
    constexpr float most = 270;
    for (int across = 1; across < most_across; ++across) {
        const Layout layout{across};
        const auto rows = static_cast<float>((static_cast<int>(panels) + across - 1) / across);
        if (rows * panel_size.y * layout.scale() <= most) return layout;
    }
    return {};
}

/// The position of a panel's plane on the canvas.
struct Panel {
    Point origin;
    const StabilityGrid& grid;
    Layout layout;

    [[nodiscard]] Point corner(int column, int row) const {
        return {origin.x + width() * static_cast<float>(column) / static_cast<float>(grid.columns),
                origin.y + plane_size.y * layout.scale() * static_cast<float>(row) /
                               static_cast<float>(grid.rows)};
    }
    [[nodiscard]] float width() const { return plane_size.x * layout.scale(); }
};

Panel panel_at(int place, const StabilityGrid& grid, Layout layout) {
    const auto across = static_cast<float>(place % layout.across);
    const auto down = static_cast<float>(place / layout.across);
    const float scale = layout.scale();
    return {{8 + (panel_size.x * across + panel_margin.x) * scale,
             top - (panel_size.y * (down + 1) - panel_margin.y) * scale},
            grid,
            layout};
}

void add_line(Picture& picture, Point from, Point to, Colour colour, float width) {
    picture.polylines.push_back(
        {.points = {from, to}, .width = width, .colour = colour, .space = Space::canvas});
}

void add_text(Picture& picture, Point at, std::string text, float size, Align align) {
    picture.labels.push_back(
        {.at = at, .text = std::move(text), .size = size, .colour = palette::ink, .align = align});
}

/// Fills the cells of a column for which `is` holds, one bar per run of cells.
template <class Is>
void fill_column(Picture& picture, const Panel& panel, int column, Colour colour, Is is) {
    const float width = panel.width() / static_cast<float>(panel.grid.columns);
    for (int row = 0; row < panel.grid.rows; ++row) {
        if (!is(row)) continue;
        const int first = row;
        while (row < panel.grid.rows && is(row)) ++row;
        const float x = panel.corner(column, 0).x + width / 2;
        add_line(picture, {x, panel.corner(column, first).y}, {x, panel.corner(column, row).y},
                 colour, width * 1.4F);
    }
}

/// Draws the edge of the region by theory: between a stable and an unstable cell.
void draw_edge(Picture& picture, const Panel& panel, const StabilityRegion& region) {
    const StabilityGrid& grid = panel.grid;
    const auto is = [&](int column, int row) { return region.stable[grid.index(column, row)]; };
    for (int column = 0; column < grid.columns; ++column)
        for (int row = 0; row < grid.rows; ++row) {
            if (column > 0 && is(column, row) != is(column - 1, row))
                add_line(picture, panel.corner(column, row), panel.corner(column, row + 1),
                         palette::ink, 0.5F);
            if (row > 0 && is(column, row) != is(column, row - 1))
                add_line(picture, panel.corner(column, row), panel.corner(column + 1, row),
                         palette::ink, 0.5F);
        }
}

void draw_axes(Picture& picture, const Panel& panel) {
    const Point low = panel.corner(0, 0);
    const Point high = panel.corner(panel.grid.columns, panel.grid.rows);
    const float scale = panel.layout.text_scale();
    add_line(picture, low, {high.x, low.y}, palette::ink, 0.6F);
    add_line(picture, low, {low.x, high.y}, palette::ink, 0.6F);
    for (int i = 0; i <= 3; ++i) {
        const float x = low.x + (high.x - low.x) * static_cast<float>(i) / 3;
        add_line(picture, {x, low.y}, {x, low.y - 1.2F * scale}, palette::ink, 0.5F);
        add_text(picture, {x, low.y - 6 * scale}, fmt::format("{:g}", panel.grid.omega_dt * i / 3),
                 number_size * scale, Align::centre);
    }
    for (int i = 0; i <= 2; ++i) {
        const float y = low.y + (high.y - low.y) * static_cast<float>(i) / 2;
        add_line(picture, {low.x, y}, {low.x - 1.2F * scale, y}, palette::ink, 0.5F);
        add_text(picture, {low.x - 2 * scale, y - 1.6F * scale},
                 fmt::format("{:g}", panel.grid.zeta * i / 2), number_size * scale, Align::right);
    }
}

void draw_panel(Picture& picture, const Panel& panel, const StabilityRegion& region) {
    const StabilityGrid& grid = panel.grid;
    for (int column = 0; column < grid.columns; ++column) {
        const auto at = [&](const std::vector<bool>& cells) {
            return [&, column](int row) { return bool{cells[grid.index(column, row)]}; };
        };
        const auto in_double = at(region.bounded_double);
        const auto in_float = at(region.bounded_float);
        fill_column(picture, panel, column, stable, in_double);
        fill_column(picture, panel, column, differs,
                    [&](int row) { return in_double(row) != in_float(row); });
    }
    draw_edge(picture, panel, region);
    draw_axes(picture, panel);
    const float y = panel.corner(0, grid.rows).y + 2 * panel.layout.text_scale();
    add_text(picture, {panel.origin.x, y}, std::string(region.method->name),
             title_size * panel.layout.text_scale(), Align::left);
}

/// Draws the legend in two columns, with the upper left corner at `at`.
void draw_legend(Picture& picture, Point at) {
    constexpr float size = 6.4F;
    constexpr float spacing = 11;
    const auto entry = [&](int line, Colour colour, float width, const char* words) {
        const float y = at.y - spacing * static_cast<float>(line);
        add_line(picture, {at.x + 4, y}, {at.x + 10, y}, colour, width);
        add_text(picture, {at.x + 18, y - 2.4F}, words, size, Align::left);
    };
    entry(0, stable, 6, "bounded when stepped in double");
    entry(1, palette::ink, 0.8F, "edge by theory: the step matrix's spectral radius is 1");
    entry(2, differs, 6, "float and double differ");
    float y = at.y;
    for (const char* words : {"To the right: stiffer springs or longer steps, ω = √(k/m).",
                              "Upwards: more damping, ζ = b/(2·√(k·m)); critical at 1.",
                              "White: the spring is unstable."}) {
        add_text(picture, {at.x + 222, y - 2.4F}, words, size, Align::left);
        y -= spacing;
    }
}

}  // namespace

Picture atlas(const std::vector<StabilityRegion>& regions, const StabilityGrid& grid) {
    Picture picture;
    add_text(picture, {16, 346}, "Where a damped spring stays bounded, by method", 12, Align::left);
    add_text(picture, {16, 335}, "across: ω·dt    up: damping ratio ζ", 7, Align::left);
    const Layout layout = layout_of(regions.size());
    int place = 0;
    for (const StabilityRegion& region : regions)
        draw_panel(picture, panel_at(place++, grid, layout), region);
    draw_legend(picture, {200, 40});
    return picture;
}

}  // namespace oiler::certify
