// SPDX-License-Identifier: MIT
#include "oiler/overlay/overlays.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/picture/theme.hpp"

namespace oiler {
namespace {

constexpr float least_font_pixels = 11;
constexpr float usual_font = 7;  // units
constexpr float notice_font = 9;

constexpr float overlay_letter_width = 0.55F;  // of the size, of the font's usual letters
constexpr std::uint8_t opacity = 232;          // of sheets over a picture

void add_sheet(Picture& picture, Point centre, Point size, Colour colour) {
    picture.polygons.push_back({.points = rectangle(centre, size),
                                .colour = colour,
                                .space = Space::canvas,
                                .layer = overlay_layer});
}

void add_label(Picture& picture, Point at, std::string text, float size, Colour colour,
               Align align) {
    picture.labels.push_back({.at = at,
                              .text = std::move(text),
                              .size = size,
                              .colour = colour,
                              .align = align,
                              .layer = overlay_layer});
}

/// A square in a colour that need not have any contrast with the paper: its edge has.
void add_mark(Picture& picture, Point centre, float side, Colour colour) {
    add_sheet(picture, centre, {side, side}, colour);
    picture.polygons.back().outline = side / 12;
    picture.polygons.back().outline_colour = theme_of(picture.background).ink;
}

/// The lines of a verdict at the top of an area. The last one ends with a hint.
struct Band {
    static constexpr float margin = 8;
    static constexpr float usual_letters = 130;  ///< of a verdict
    static constexpr float most_lines = 4;
    static constexpr std::string_view keys = "F1: more  F2: keys";

    explicit Band(const OverlayArea& area, std::string shown = std::string(keys))
        : hint(std::move(shown)),
          size(area.legible(usual_font)),
          left(area.low.x + margin + size),
          width(area.high.x - margin - left) {
        const float wanted = usual_letters + static_cast<float>(keys.size()) + 2;
        lines = static_cast<std::size_t>(
            std::clamp(std::ceil(wanted * letter(size) / width), 1.0F, most_lines));
    }

    static float letter(float size) { return overlay_letter_width * size; }
    [[nodiscard]] float line() const { return 1.43F * size; }
    [[nodiscard]] float height() const { return static_cast<float>(lines) * line(); }
    /// Lines of text with room for the mark and, in the last line, for the hint.
    [[nodiscard]] std::vector<std::string> broken(const std::string& text, float text_size) const {
        const auto most = [&](float room) {
            return static_cast<std::size_t>(std::max(1.0F, room / letter(text_size)));
        };
        const float beside_hint = width - letter(text_size) * static_cast<float>(hint.size() + 2);
        std::vector<std::string> found =
            broken_at_spaces(text, most(lines > 1 ? width : beside_hint));
        if (found.size() == lines && lines > 1 && found.back().size() > most(beside_hint))
            found.emplace_back();  // one too many: the text does not fit
        return found;
    }

    std::string hint;  ///< or the state of the loop
    float size;
    float left;
    float width;
    std::size_t lines = 1;
};

}  // namespace

OverlayArea::OverlayArea(Size size)
    : pixels(std::max(0.01F, std::min(static_cast<float>(size.width) / canvas_width,
                                      static_cast<float>(size.height) / canvas_height))) {
    const Point half{static_cast<float>(size.width) / pixels / 2,
                     static_cast<float>(size.height) / pixels / 2};
    low = {canvas_width / 2 - half.x, canvas_height / 2 - half.y};
    high = {canvas_width / 2 + half.x, canvas_height / 2 + half.y};
}

float OverlayArea::legible(float size) const { return std::max(size, least_font_pixels / pixels); }

std::vector<std::string> broken_at_spaces(const std::string& text, std::size_t most) {
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.back().empty() && lines.back().size() + 1 + word.size() > most)
            lines.emplace_back();
        if (!lines.back().empty()) lines.back() += ' ';
        lines.back() += word;
    }
    return lines;
}

void add_note(Picture& overlay, Point at, std::string text, float size, Align align) {
    const Theme& theme = theme_of(overlay.background);
    const float width = overlay_letter_width * size * static_cast<float>(text.size());
    const float middle = at.x + (align == Align::left ? width : -width) / 2;
    add_sheet(overlay, {middle, at.y + 0.36F * size}, {width + 0.8F * size, 1.5F * size},
              palette::faded(theme.paper, opacity));
    add_label(overlay, at, std::move(text), size, theme.ink, align);
}

void add_status(Picture& overlay, const OverlayArea& area, std::string status) {
    if (status.empty()) return;
    const float room = area.high.x - area.low.x - 16;
    const auto letters = static_cast<float>(status.size());
    const float size = std::min(area.legible(usual_font), room / (overlay_letter_width * letters));
    add_note(overlay, {area.high.x - 8, area.low.y + 0.5F * size}, std::move(status), size,
             Align::right);
}

Colour colour_of(Verdict::Grade grade) {
    constexpr Colour colours[] = {palette::grey, palette::green, palette::orange,
                                  palette::vermilion};
    return colours[static_cast<std::size_t>(grade)];
}

int verdict_height(const OverlayArea& area) {
    const Band band(area);
    return static_cast<int>(std::lround(band.height() * area.pixels));
}

void add_verdict(Picture& overlay, const OverlayArea& area, const Verdict& verdict,
                 const std::string& status) {
    const Theme& theme = theme_of(overlay.background);
    const Band band = status.empty() ? Band(area) : Band(area, status);
    const float middle = area.high.y - band.height() / 2;
    add_sheet(overlay, {canvas_width / 2, middle}, {area.high.x - area.low.x, band.height()},
              theme.paper);
    const float mark = 0.85F * band.size;
    add_mark(overlay, {area.low.x + 5 + mark / 2, area.high.y - band.line() / 2}, mark,
             colour_of(verdict.grade));
    float size = band.size;
    std::vector<std::string> lines = band.broken(verdict.text, size);
    while (lines.size() > band.lines && size > band.size / 4)
        lines = band.broken(verdict.text, size *= 0.95F);
    float y = area.high.y - band.line() / 2 - 0.36F * size;
    add_label(overlay,
              {area.high.x - Band::margin, y - static_cast<float>(band.lines - 1) * band.line()},
              band.hint, size, status.empty() ? theme.faint : theme.ink, Align::right);
    for (std::string& line : lines) {
        add_label(overlay, {band.left, y}, std::move(line), size, theme.ink, Align::left);
        y -= band.line();
    }
}

void add_notice(Picture& overlay, const OverlayArea& area, const Notice& notice) {
    const Theme& theme = theme_of(overlay.background);
    const float size = area.legible(notice_font);
    const float room = area.high.x - area.low.x - 16;
    struct Line {
        std::string text;
        float size;
        Colour colour;
    };
    std::vector<Line> lines;
    const auto add = [&](const std::string& text, float of_line, Colour colour) {
        if (text.empty()) return;
        const float letters = std::clamp(room / (overlay_letter_width * of_line), 10.0F, 100.0F);
        for (std::string& line : broken_at_spaces(text, static_cast<std::size_t>(letters)))
            lines.push_back({std::move(line), of_line, colour});
    };
    add(notice.heading, 1.3F * size, theme.ink);
    add(notice.text, size, theme.ink);
    add(notice.remedy, size, theme.faint);
    constexpr float leading = 1.4F;
    float height = 0;
    for (const Line& line : lines) height += leading * line.size;
    add_sheet(overlay, {canvas_width / 2, canvas_height / 2},
              {area.high.x - area.low.x, height + 1.6F * size},
              palette::faded(theme.paper, opacity));
    add_sheet(overlay, {area.low.x + 2, canvas_height / 2}, {4, height + 1.6F * size},
              palette::vermilion);
    float y = (canvas_height + height) / 2;
    for (Line& line : lines) {
        add_label(overlay, {canvas_width / 2, y - line.size}, std::move(line.text), line.size,
                  line.colour, Align::centre);
        y -= leading * line.size;
    }
}

}  // namespace oiler
