// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "oiler/certify/region.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/plot/plot.hpp"

namespace oiler::certify {
namespace {

constexpr Box panels_box{{16, 8}, {632, 328}};  // of all panels and the legend
constexpr float text_size = 8;
constexpr float numbers = text_size + 2;  // height of those below the lowest panels
constexpr Point margin{14, 4};            // of a panel: for its numbers on the left, for air below
constexpr float legend_line = 12;
constexpr int half_legend = 3;        // lines; two halves are beside or below each other
constexpr float legend_column = 200;  // width of a half

constexpr Colour stable = palette::sky_blue;
constexpr Colour differs = palette::vermilion;

/// Panels of one size in rows, the first row on top. The legend is in the empty places of the last
/// row if it fits there, or below all panels.
struct Layout {
    int panels;
    int across;
    Point cell{};                       ///< a panel with its margins and its title
    Point legend{panels_box.low.x, 0};  ///< upper left corner
    int legend_columns = 2;

    Layout(int count, int in_a_row) : panels(count), across(in_a_row) {
        const float width = (panels_box.high.x - panels_box.low.x) / static_cast<float>(across);
        float height =
            (panels_box.high.y - panels_box.low.y - numbers) / static_cast<float>(rows());
        const float empty = static_cast<float>(empty_places()) * width;
        constexpr float half = half_legend * legend_line;
        const bool is_column = empty < 2 * legend_column && height > 2 * half + text_size;
        const bool is_beside = empty >= (is_column ? 1 : 2) * legend_column;
        if (!is_beside) height -= (half + text_size) / static_cast<float>(rows());
        cell.y = std::min(height, 1.35F * width);
        cell.x = std::min(width, 2.2F * cell.y);
        legend.y = panels_box.low.y + half;
        if (!is_beside) return;
        legend.x += static_cast<float>(across - empty_places()) * cell.x + margin.x;
        if (!is_column) return;
        legend_columns = 1;
        legend.y += half;
    }
    [[nodiscard]] int rows() const { return (panels + across - 1) / across; }
    [[nodiscard]] int empty_places() const { return rows() * across - panels; }
    [[nodiscard]] bool has_legend_beside() const { return legend.x > panels_box.low.x; }
    [[nodiscard]] float title_size() const { return std::clamp(0.08F * cell.y, 7.5F, 12.0F); }
    [[nodiscard]] Box plane(int place) const {
        const auto column = static_cast<float>(place % across);
        const auto row = static_cast<float>(place / across);
        const Point corner{panels_box.low.x + column * cell.x, panels_box.high.y - row * cell.y};
        return {{corner.x + margin.x, corner.y - cell.y + margin.y},
                {corner.x + cell.x - 4, corner.y - 1.5F * title_size()}};
    }
    [[nodiscard]] bool is_first_in_row(int place) const { return place % across == 0; }
    [[nodiscard]] bool is_lowest(int place) const { return place + across >= panels; }
    /// The area of a plane, less for places that are wholly empty.
    [[nodiscard]] float worth() const {
        const auto [low, high] = plane(0);
        const float used = has_legend_beside()
                               ? 1
                               : static_cast<float>(panels) / static_cast<float>(rows() * across);
        return used * (high.x - low.x) * (high.y - low.y);
    }
};

/// The layout with the largest panels and the fewest empty places.
Layout layout_of(std::size_t regions) {
    constexpr int most_across = 7;
    const int panels = std::max(1, static_cast<int>(regions));
    Layout best(panels, 1);
    for (int across = 2; across <= std::max(most_across, panels / 6); ++across)
        if (const Layout other(panels, across); other.worth() > best.worth()) best = other;
    return best;
}

/// A region in its plane on the canvas.
struct Panel {
    Box plane;
    const StabilityRegion& region;
    const StabilityGrid& grid;

    [[nodiscard]] Point corner(int column, int row) const {
        const auto along = [](float low, float high, int at, int count) {
            return low + (high - low) * static_cast<float>(at) / static_cast<float>(count);
        };
        return {along(plane.low.x, plane.high.x, column, grid.columns),
                along(plane.low.y, plane.high.y, row, grid.rows)};
    }
};

void add_line(Picture& picture, Point from, Point to, Colour colour, float width) {
    picture.polylines.push_back(
        {.points = {from, to}, .width = width, .colour = colour, .space = Space::canvas});
}

/// Adds an image with a texel for each cell.
void draw_cells(Picture& picture, const Panel& panel) {
    const auto& [plane, region, grid] = panel;
    std::vector<std::uint8_t> rgba;
    for (int row = grid.rows - 1; row >= 0; --row)
        for (int column = 0; column < grid.columns; ++column) {
            const std::size_t at = grid.index(column, row);
            const bool is_stable = region.bounded_double[at];
            const Colour colour = is_stable != region.bounded_float[at] ? differs
                                  : is_stable                           ? stable
                                                                        : picture.background;
            rgba.insert(rgba.end(), {colour.r, colour.g, colour.b, colour.a});
        }
    picture.sprites.push_back(
        {.centre = {(plane.low.x + plane.high.x) / 2, (plane.low.y + plane.high.y) / 2},
         .size = {plane.high.x - plane.low.x, plane.high.y - plane.low.y},
         .bitmap = make_bitmap({grid.columns, grid.rows}, std::move(rgba)),
         .space = Space::canvas,
         .is_smooth = false});
}

/// Draws the edge of the region by theory: between a stable and an unstable cell.
void draw_edge(Picture& picture, const Panel& panel) {
    const StabilityGrid& grid = panel.grid;
    const auto is = [&](int column, int row) {
        return panel.region.stable[grid.index(column, row)];
    };
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

/// Draws axes and ticks. Panels of a row share the numbers of its first, panels of a column those
/// of its lowest.
void draw_axes(Picture& picture, const Panel& panel, bool has_omegas, bool has_zetas) {
    const auto& [low, high] = panel.plane;
    add_line(picture, low, {high.x, low.y}, palette::ink, 0.6F);
    add_line(picture, low, {low.x, high.y}, palette::ink, 0.6F);
    for (int i = 0; i <= 3; ++i) {
        const float x = low.x + (high.x - low.x) * static_cast<float>(i) / 3;
        add_line(picture, {x, low.y}, {x, low.y - 1.5F}, palette::ink, 0.5F);
        if (has_omegas)
            add_text(picture, {x, low.y - text_size - 1},
                     fmt::format("{:g}", panel.grid.omega_dt * i / 3), text_size, palette::ink,
                     Align::centre);
    }
    for (int i = 0; i <= 2; ++i) {
        const float y = low.y + (high.y - low.y) * static_cast<float>(i) / 2;
        add_line(picture, {low.x, y}, {low.x - 1.5F, y}, palette::ink, 0.5F);
        if (has_zetas)
            add_text(picture, {low.x - 3, y - 0.36F * text_size},
                     fmt::format("{:g}", panel.grid.zeta * i / 2), text_size, palette::ink,
                     Align::right);
    }
}

/// Writes the method's name above the panel. A long name is smaller.
void draw_title(Picture& picture, const Panel& panel, const Layout& layout) {
    const std::string name(panel.region.method->name);
    const Point corner{panel.plane.low.x, panel.plane.high.y};
    const float size = layout.title_size();
    const float fitting = (layout.cell.x - 8) / text_width(name, 1);
    add_text(picture, {corner.x, corner.y + 0.38F * size}, name, std::min(size, fitting),
             palette::ink);
}

void draw_legend(Picture& picture, const Layout& layout, bool has_differences) {
    Point at{layout.legend.x, layout.legend.y - text_size};
    const auto entry = [&](Colour colour, float width, const char* words) {
        add_line(picture, {at.x + 4, at.y + 3}, {at.x + 10, at.y + 3}, colour, width);
        add_text(picture, {at.x + 18, at.y}, words, text_size, palette::ink);
        at.y -= legend_line;
    };
    entry(stable, 6, "bounded, stepped in double");
    entry(palette::ink, 0.8F, "edge by theory: spectral radius 1");
    if (has_differences) entry(differs, 6, "float and double differ");
    if (layout.legend_columns == 2) at = {at.x + 180, layout.legend.y - text_size};
    for (const char* words :
         {"right: stiffer springs or longer steps, ω = √(k/m)",
          "up: more damping, ζ = b/(2·√(k·m)), critical at 1", "white: the spring is unstable"}) {
        add_text(picture, at, words, text_size, palette::ink);
        at.y -= legend_line;
    }
}

}  // namespace

Picture atlas(const std::vector<StabilityRegion>& regions, const StabilityGrid& grid) {
    Picture picture;
    add_text(picture, {16, 344}, "Where a damped spring stays bounded, by method", 12,
             palette::ink);
    add_text(picture, {16, 332}, "across: ω·dt, rad    up: damping ratio ζ", text_size,
             palette::ink);
    const Layout layout = layout_of(regions.size());
    for (int place = 0; const StabilityRegion& region : regions) {
        const Panel panel{layout.plane(place), region, grid};
        draw_cells(picture, panel);
        draw_edge(picture, panel);
        draw_axes(picture, panel, layout.is_lowest(place), layout.is_first_in_row(place));
        draw_title(picture, panel, layout);
        ++place;
    }
    draw_legend(picture, layout, std::ranges::any_of(regions, [](const StabilityRegion& region) {
                    return region.bounded_double != region.bounded_float;
                }));
    return picture;
}

}  // namespace oiler::certify
