// SPDX-License-Identifier: MIT
#include "oiler/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "oiler/picture/palette.hpp"

namespace oiler {
namespace {

constexpr float tick_size = 9;
constexpr float label_size = 10;
constexpr float title_size = 13;
constexpr float caption_line = 14;
constexpr float mark_radius = 2.6F;

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

/// The part of a segment within the box, by Liang and Barsky (1984); none of one that has no end.
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
    const auto map = [](double value, Range range, float low, float high) {
        return low + (value - range.low) / (range.high - range.low) * (high - low);
    };
    return {map(p.x, plot.x, plot.box.low.x, plot.box.high.x),
            map(p.y, plot.y, plot.box.low.y, plot.box.high.y)};
}

void draw_grid(const Plot& plot, Picture& picture) {
    const Box& box = plot.box;
    for (const double at : ticks(plot.x, plot.x_ticks)) {
        const float x = plot.to_canvas({at, plot.y.low}).x;
        picture.polylines.push_back(line({x, box.low.y}, {x, box.high.y}, palette::pale, 0.75F));
        picture.labels.push_back(
            text({x, box.low.y - 11}, fmt::format("{:g}", at), tick_size, Align::centre));
    }
    for (const double at : ticks(plot.y, plot.y_ticks)) {
        const float y = plot.to_canvas({plot.x.low, at}).y;
        picture.polylines.push_back(line({box.low.x, y}, {box.high.x, y}, palette::pale, 0.75F));
        picture.labels.push_back(
            text({box.low.x - 4, y - 3}, fmt::format("{:g}", at), tick_size, Align::right));
    }
    picture.polylines.push_back(line(box.low, {box.high.x, box.low.y}, palette::ink, 1));
    picture.polylines.push_back(line(box.low, {box.low.x, box.high.y}, palette::ink, 1));
}

/// How wide a letter is, in ems: a picture does not know its font, so this is DejaVu Sans, rounded.
/// Bytes that continue a letter of UTF-8 have no width of their own.
float width_of(char letter) {
    const auto is_in = [&](std::string_view set) { return set.find(letter) != set.npos; };
    if ((letter & 0xC0) == 0x80) return 0;
    if (is_in("ijlI.,:;'!- ")) return 0.32F;
    if (is_in("frt()/")) return 0.4F;
    if (is_in("mMwW%")) return 1;
    if ((letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z')) return 0.66F;
    return 0.6F;
}

float width_of(std::string_view words, float size) {
    float width = 0;
    for (const char letter : words) width += size * width_of(letter);
    return width;
}

/// The words of a text, those together that a line's end must not part: "t = 3.65 s" and "40 %".
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
        if (lines.empty() || width_of(lines.back() + ' ' + part, size) > width)
            lines.push_back(part);
        else
            lines.back() += ' ' + part;
    }
    return lines;
}

/// As few lines as the width allows, and about equally long.
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

void draw_words(const Plot& plot, Picture& picture) {
    const Box& box = plot.box;
    const auto put = [&](Point at, const std::string& words, float size, Align align) -> Label& {
        return picture.labels.emplace_back(text(at, words, size, align));
    };
    put({box.low.x, box.high.y + 25}, plot.title, title_size, Align::left);
    put({box.high.x, box.high.y + 25}, plot.remark, label_size, Align::right).colour =
        palette::grey;
    put({box.low.x, box.high.y + 6}, plot.y_label, label_size, Align::left);
    put({box.high.x, box.low.y - 23}, plot.x_label, label_size, Align::right);
    float y = box.low.y - 26;
    for (const std::string& words : wrap(plot.caption, label_size, box.high.x - box.low.x))
        put({box.low.x, y -= caption_line}, words, label_size, Align::left);
}

void draw_mark(const Series& series, Point at, Picture& picture) {
    if (series.mark == Mark::none) return;
    const auto disc = [&](float radius, Colour colour) {
        picture.discs.push_back(
            {.centre = at, .radius = radius, .colour = colour, .space = Space::canvas});
    };
    disc(mark_radius, series.colour);
    if (series.mark == Mark::ring) disc(mark_radius - 1, picture.background);
}

/// Names beside their curves' colours, from the right end of the y label's line leftwards.
void draw_legend(const Plot& plot, Picture& picture) {
    float right = plot.box.high.x;
    for (auto series = plot.series.rbegin(); series != plot.series.rend(); ++series) {
        if (series->name.empty()) continue;
        Label name = text({right, plot.box.high.y + 6}, series->name, label_size, Align::right);
        const float left = right - width_of(series->name, label_size) - 4;
        picture.labels.push_back(std::move(name));
        picture.polylines.push_back(line({left - 16, plot.box.high.y + 9.5F},
                                         {left, plot.box.high.y + 9.5F}, series->colour, 2.5F));
        draw_mark(*series, {left - 8, plot.box.high.y + 9.5F}, picture);
        right = left - 28;
    }
}

void draw_curve(const Plot& plot, const Series& series, ElementKey key, Picture& picture) {
    Polyline run{
        .key = key, .width = series.width, .colour = series.colour, .space = Space::canvas};
    const auto finish = [&] {
        if (run.points.size() > 1) picture.polylines.push_back(run);
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
    const auto within = [](double value, Range range) {
        return value >= range.low && value <= range.high;
    };
    for (const DataPoint& at : series.points)
        if (within(at.x, plot.x) && within(at.y, plot.y))
            draw_mark(series, plot.to_canvas(at), picture);
}

}  // namespace

void Plot::draw(Picture& picture, ElementKey key) const {
    draw_grid(*this, picture);
    draw_words(*this, picture);
    draw_legend(*this, picture);
    for (const Series& curve : series) {
        ++key.part;
        draw_curve(*this, curve, key, picture);
        draw_marks(*this, curve, picture);
    }
}

Point Plot::to_canvas(DataPoint point) const {
    const DataPoint at = on_canvas(*this, point);
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

std::vector<double> ticks(Range range, int count) {
    const double rough = (range.high - range.low) / count;
    if (!(rough > 0) || !std::isfinite(rough)) return {};
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * power >= rough * 0.999) step = factor * power;
    std::vector<double> at;
    const double first = std::ceil(range.low / step - 1e-9);
    for (int i = 0; i <= 2 * count; ++i) {
        const double tick = (first + i) * step;
        if (tick > range.high + step * 1e-9) break;
        at.push_back(tick == 0 ? 0.0 : tick);
    }
    return at;
}

}  // namespace oiler
