// SPDX-License-Identifier: MIT
#include "oiler/plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/plot/ticks.hpp"

namespace oiler {
namespace {

constexpr float mark_radius = 2.6F;
constexpr float large_radius = 5.2F;
constexpr float outline = 1.1F;
constexpr float dash = 6;
constexpr float gap = 5;  // the round ends of the dashes narrow it by the line's width

/// A regular polygon as a mark. It looks as large as a disc.
struct Polygon {
    int corners;
    float radius;
    float first;  ///< direction of the first corner, in turns

    [[nodiscard]] Polyline scaled(float by, Point centre, Colour colour, float width) const {
        Polyline line{.width = width, .colour = colour, .space = Space::canvas};
        for (int i = 0; i <= corners; ++i) {
            const float turns =
                first + static_cast<float>(i % corners) / static_cast<float>(corners);
            const float angle = 2 * std::numbers::pi_v<float> * turns;
            line.points.push_back({centre.x + by * radius * std::cos(angle),
                                   centre.y + by * radius * std::sin(angle)});
        }
        return line;
    }
    /// Distance of the sides from the centre.
    [[nodiscard]] float inradius() const {
        return radius * std::cos(std::numbers::pi_v<float> / static_cast<float>(corners));
    }
};

Polygon polygon_of(Mark mark) {
    if (mark == Mark::square) return {.corners = 4, .radius = 3.2F, .first = 0.125F};
    if (mark == Mark::diamond) return {.corners = 4, .radius = 3.4F, .first = 0};
    return {.corners = 3, .radius = 3.8F, .first = 0.25F};
}

/// Fills the polygon with a wide outline at half its size: a filled polygon would be drawn below
/// all polylines of its layer.
void draw_filled(const Polygon& polygon, Point at, Colour colour, Picture& picture) {
    picture.polylines.push_back(polygon.scaled(0.5F, at, picture.background, polygon.inradius()));
    picture.polylines.push_back(polygon.scaled(1, at, colour, outline));
}

/// Draws a large outline above all other marks.
void draw_around(std::vector<Point> points, Colour colour, Picture& picture) {
    picture.polylines.push_back({.points = std::move(points),
                                 .width = 1.5F,
                                 .colour = colour,
                                 .space = Space::canvas,
                                 .layer = 1});
}

Point point_between(Point from, Point to, float part) {
    return {from.x + (to.x - from.x) * part, from.y + (to.y - from.y) * part};
}

void draw_dashes(const Polyline& whole, Picture& picture) {
    Polyline piece = whole;
    piece.key = {};
    piece.points.resize(1);
    bool is_gap = false;
    const auto turn = [&](Point at) {
        piece.points.push_back(at);
        if (!is_gap) picture.polylines.push_back(piece);
        piece.points = {at};
        is_gap = !is_gap;
    };
    float left = dash;
    for (std::size_t i = 1; i < whole.points.size(); ++i) {
        const Point from = whole.points[i - 1];
        const Point to = whole.points[i];
        const float length = std::hypot(to.x - from.x, to.y - from.y);
        float gone = 0;
        for (; gone + left < length; left = is_gap ? gap : dash)
            turn(point_between(from, to, (gone += left) / length));
        left -= length - gone;
        piece.points.push_back(to);
    }
    if (!is_gap) picture.polylines.push_back(piece);
}

/// Draws the series' mark on the canvas. It hides the curve below it.
void draw_mark(const Series& series, Point at, Picture& picture) {
    if (series.mark == Mark::none) return;
    if (series.mark == Mark::halo)
        return draw_around(circle(at, large_radius), series.colour, picture);
    if (series.mark == Mark::frame) {
        const float side = 2 * large_radius;
        std::vector<Point> corners = rectangle(at, {side, side});
        corners.push_back(corners.front());
        return draw_around(std::move(corners), series.colour, picture);
    }
    if (series.mark != Mark::disc && series.mark != Mark::ring)
        return draw_filled(polygon_of(series.mark), at, series.colour, picture);
    const auto disc = [&](float radius, Colour colour) {
        picture.discs.push_back(
            {.centre = at, .radius = radius, .colour = colour, .space = Space::canvas});
    };
    disc(mark_radius, series.colour);
    if (series.mark == Mark::ring) disc(mark_radius - 1, picture.background);
}

/// Draws a line of the series on the canvas: solid with its key, or dashed without a key.
void draw_line(const Series& series, const Polyline& whole, Picture& picture) {
    if (series.width <= 0) return;
    if (series.dashed) return draw_dashes(whole, picture);
    picture.polylines.push_back(whole);
}

constexpr float tick_size = 9;
constexpr float label_size = 10;
constexpr float title_size = 13;
constexpr float caption_line = 14;
constexpr float swatch = 16;
constexpr float legend_line = 13;
constexpr float note_line = 11;
constexpr float long_swatch = 28;  // three dashes; a mark hides only the middle one

Polyline line(Point from, Point to, Colour colour, float width) {
    return {.points = {from, to}, .width = width, .colour = colour, .space = Space::canvas};
}

Label text(Point at, std::string words, float size, Align align) {
    return {
        .at = at, .text = std::move(words), .size = size, .colour = palette::ink, .align = align};
}

float clamped(float low, double value, float high) {
    return static_cast<float>(std::clamp(value, double{low}, double{high}));
}

/// The part of a segment within the box (Liang and Barsky, 1984); empty if an end is not finite.
std::optional<std::pair<Point, Point>> clip(DataPoint a, DataPoint b, const Box& box) {
    for (const double number : {a.x, a.y, b.x, b.y})
        if (!std::isfinite(number)) return std::nullopt;
    double enter = 0;
    double leave = 1;
    const auto cut = [&](double from, double to, double low, double high) {
        const double d = to - from;
        if (d == 0) return from >= low && from <= high;
        enter = std::max(enter, std::min((low - from) / d, (high - from) / d));
        leave = std::min(leave, std::max((low - from) / d, (high - from) / d));
        return true;
    };
    if (!cut(a.x, b.x, box.low.x, box.high.x) || !cut(a.y, b.y, box.low.y, box.high.y) ||
        enter > leave)
        return std::nullopt;
    const auto at = [&](double s) {
        return Point{clamped(box.low.x, a.x + (b.x - a.x) * s, box.high.x),
                     clamped(box.low.y, a.y + (b.y - a.y) * s, box.high.y)};
    };
    return std::pair(at(enter), at(leave));
}

DataPoint on_canvas(const Plot& plot, DataPoint p) {
    const auto map = [](double value, Range range, Scale scale, float low, float high) {
        if (scale == Scale::logarithmic) {
            value = std::log10(value);
            range = {std::log10(range.low), std::log10(range.high)};
        }
        return low + (value - range.low) / (range.high - range.low) * (high - low);
    };
    return {map(p.x, plot.x, plot.x_scale, plot.box.low.x, plot.box.high.x),
            map(p.y, plot.y, plot.y_scale, plot.box.low.y, plot.box.high.y)};
}

void draw_lines(const Plot& plot, const std::vector<double>& xs, const std::vector<double>& ys,
                Colour colour, float width, Picture& picture) {
    const Box& box = plot.box;
    for (const double at : xs) {
        const float x = plot.to_canvas({at, plot.y.low}).x;
        picture.polylines.push_back(line({x, box.low.y}, {x, box.high.y}, colour, width));
    }
    for (const double at : ys) {
        const float y = plot.to_canvas({plot.x.low, at}).y;
        picture.polylines.push_back(line({box.low.x, y}, {box.high.x, y}, colour, width));
    }
}

void draw_grid(const Plot& plot, Picture& picture) {
    const Box& box = plot.box;
    const std::vector<double> xs = ticks(plot.x, plot.x_scale, plot.x_ticks);
    const std::vector<double> ys = ticks(plot.y, plot.y_scale, plot.y_ticks);
    draw_lines(plot, minor_ticks(plot.x, plot.x_scale), minor_ticks(plot.y, plot.y_scale),
               palette::faded(palette::pale, 128), 0.5F, picture);
    draw_lines(plot, xs, ys, palette::pale, 0.75F, picture);
    for (const double at : xs)
        picture.labels.push_back(text({plot.to_canvas({at, plot.y.low}).x, box.low.y - 11},
                                      tick_label(at, plot.x_scale), tick_size, Align::centre));
    for (const double at : ys)
        picture.labels.push_back(text({box.low.x - 4, plot.to_canvas({plot.x.low, at}).y - 3},
                                      tick_label(at, plot.y_scale), tick_size, Align::right));
    picture.polylines.push_back(line(box.low, {box.high.x, box.low.y}, palette::ink, 1));
    picture.polylines.push_back(line(box.low, {box.low.x, box.high.y}, palette::ink, 1));
}

/// Splits a text into words, but keeps "t = 3.65 s" and "40 %" together.
std::vector<std::string> unbreakable(const std::string& text) {
    const auto binds = [](char c) { return c == '=' || (c >= '0' && c <= '9'); };
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) {
        if (!parts.empty() && (binds(parts.back().back()) || binds(word.front())))
            parts.back() += ' ' + word;
        else
            parts.push_back(word);
    }
    return parts;
}

std::vector<std::string> lines_of(const std::vector<std::string>& parts, float size, float width) {
    std::vector<std::string> lines;
    for (const std::string& part : parts) {
        if (lines.empty() || text_width(lines.back() + ' ' + part, size) > width)
            lines.push_back(part);
        else
            lines.back() += ' ' + part;
    }
    return lines;
}

/// Wraps a text into the smallest number of lines, all about equally long.
std::vector<std::string> wrap(const std::string& text, float size, float width) {
    const std::vector<std::string> parts = unbreakable(text);
    std::vector<std::string> lines = lines_of(parts, size, width);
    for (int percent = 99; percent > 0; --percent) {
        std::vector<std::string> even =
            lines_of(parts, size, width * static_cast<float>(percent) / 100);
        if (even.size() > lines.size()) break;
        lines = std::move(even);
    }
    return lines;
}

void draw_labels(const Plot& plot, Picture& picture) {
    const Box& box = plot.box;
    const auto put = [&](Point at, const std::string& words, float size, Align align) -> Label& {
        return picture.labels.emplace_back(text(at, words, size, align));
    };
    put({box.low.x, box.high.y + 25}, plot.title, title_size, Align::left);
    put({box.high.x, box.high.y + 25}, plot.remark, label_size, Align::right).colour =
        readable(palette::grey);
    put({box.low.x, box.high.y + 6}, plot.y_label, label_size, Align::left);
    put({box.high.x, box.low.y - 23}, plot.x_label, label_size, Align::right);
    float y = box.low.y - 26;
    for (const std::string& words : wrap(plot.caption, label_size, box.high.x - box.low.x))
        put({box.low.x, y -= caption_line}, words, label_size, Align::left);
}

void draw_swatch(const Series& series, Point left, float width, Picture& picture) {
    const Point right{left.x + width, left.y};
    draw_line(series, line(left, right, series.colour, 2.5F), picture);
    draw_mark(series, {left.x + width / 2, left.y}, picture);
}

bool is_within(const Plot& plot, const DataPoint& at) {
    const auto is_in = [](double value, Range range) {
        return value >= range.low && value <= range.high;
    };
    return is_in(at.x, plot.x) && is_in(at.y, plot.y);
}

/// Whether a series has an entry in the legend: a name, and a point or a segment in the box.
bool is_named(const Plot& plot, const Series& series) {
    if (series.name.empty()) return false;
    const auto is_in = [&](const DataPoint& at) { return is_within(plot, at); };
    if (std::ranges::any_of(series.points, is_in)) return true;
    for (std::size_t i = 1; i < series.points.size(); ++i)
        if (clip(on_canvas(plot, series.points[i - 1]), on_canvas(plot, series.points[i]),
                 plot.box))
            return true;
    return false;
}

/// Draws names and swatches on the line of the y label, from its right end to the left.
void draw_legend_above(const Plot& plot, Picture& picture) {
    float right = plot.box.high.x;
    for (auto series = plot.series.rbegin(); series != plot.series.rend(); ++series) {
        if (!is_named(plot, *series)) continue;
        Label name = text({right, plot.box.high.y + 6}, series->name, label_size, Align::right);
        const float left = right - text_width(series->name, label_size) - 4;
        picture.labels.push_back(std::move(name));
        const float width = series->dashed ? long_swatch : swatch;
        draw_swatch(*series, {left - width, plot.box.high.y + 9.5F}, width, picture);
        right = left - width - 12;
    }
}

/// Draws names and swatches beside the box, from its top down, and the notes below them. Many names
/// are closer together.
void draw_legend_beside(const Plot& plot, Picture& picture) {
    const Box& box = plot.box;
    std::ptrdiff_t names = 0;
    for (const Series& series : plot.series)
        if (is_named(plot, series)) names += 1 + std::ranges::count(series.name, '\n');
    const float pitch = std::min(legend_line, (box.high.y - box.low.y) / static_cast<float>(names));
    float y = box.high.y - pitch / 2 - 3.5F;
    for (const Series& series : plot.series) {
        if (!is_named(plot, series)) continue;
        draw_swatch(series, {box.high.x + 10, y + 3.5F}, long_swatch, picture);
        std::istringstream lines(series.name);
        for (std::string words; std::getline(lines, words); y -= pitch)
            picture.labels.push_back(
                text({box.high.x + long_swatch + 16, y}, words, label_size, Align::left));
    }
    for (const std::string& words : plot.notes) {
        picture.labels.push_back(text({box.high.x + 10, y}, words, tick_size, Align::left));
        y -= note_line;
    }
}

void draw_legend(const Plot& plot, Picture& picture) {
    return plot.legend_beside ? draw_legend_beside(plot, picture)
                              : draw_legend_above(plot, picture);
}

void draw_curve(const Plot& plot, const Series& series, ElementKey key, Picture& picture) {
    Polyline run{
        .key = key, .width = series.width, .colour = series.colour, .space = Space::canvas};
    const auto finish = [&] {
        if (run.points.size() > 1) draw_line(series, run, picture);
        run.points.clear();
        run.key.object = 0;
    };
    for (std::size_t i = 1; i < series.points.size(); ++i) {
        const auto piece = clip(on_canvas(plot, series.points[i - 1]),
                                on_canvas(plot, series.points[i]), plot.box);
        if (!piece || (!run.points.empty() && run.points.back() != piece->first)) finish();
        if (!piece) continue;
        if (run.points.empty()) run.points.push_back(piece->first);
        run.points.push_back(piece->second);
    }
    finish();
}

void draw_marks(const Plot& plot, const Series& series, Picture& picture) {
    for (const DataPoint& at : series.points)
        if (is_within(plot, at)) draw_mark(series, plot.to_canvas(at), picture);
}

}  // namespace

void Plot::draw(Picture& picture, ElementKey key) const {
    draw_grid(*this, picture);
    draw_labels(*this, picture);
    draw_legend(*this, picture);
    for (const Series& curve : series) {
        ++key.part;
        draw_curve(*this, curve, key, picture);
    }
    // Above all curves. Discs always are.
    for (const Series& curve : series) draw_marks(*this, curve, picture);
}

Point Plot::to_canvas(DataPoint point) const {
    const DataPoint at = on_canvas(*this, point);
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

}  // namespace oiler
