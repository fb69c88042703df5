// SPDX-License-Identifier: MIT
#include "oiler/overlay/overlays.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

constexpr float least_font_pixels = 11;

constexpr float overlay_letter_width = 0.55F;  // of the size, of the font's usual letters

void add_sheet(Picture& picture, Point centre, Point size, Colour colour) {
    picture.polygons.push_back({.points = rectangle(centre, size),
                                .colour = colour,
                                .space = Space::canvas,
                                .layer = overlay_layer});
}

/// Lines of at most `most` bytes, broken at spaces.
std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
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

constexpr float least_game_pixels = 9;  // of a font of a game

/// The width that a label can take before the edge of an area cuts it, units of the canvas.
float room_of(const Label& label, const OverlayArea& area) {
    const float left = label.at.x - area.low.x;
    const float right = area.high.x - label.at.x;
    if (label.align == Align::left) return right;
    return label.align == Align::right ? left : 2 * std::min(left, right);
}

/// The lines of a verdict at the top of an area. The last one ends with a hint.
struct Band {
    static constexpr float margin = 8;
    static constexpr float usual_letters = 130;  ///< of a verdict
    static constexpr float most_lines = 4;
    static constexpr std::string_view hint = "F1: more  F2: keys";

    explicit Band(const OverlayArea& area)
        : size(area.legible(7)),
          left(area.low.x + margin + size),
          width(area.high.x - margin - left) {
        const float wanted = usual_letters + static_cast<float>(hint.size()) + 2;
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
        const float beside_hint = width - letter(size) * static_cast<float>(hint.size() + 2);
        std::vector<std::string> found = wrapped(text, most(lines > 1 ? width : beside_hint));
        if (found.size() == lines && lines > 1 && found.back().size() > most(beside_hint))
            found.emplace_back();  // one too many: the text does not fit
        return found;
    }

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

void add_status(Picture& overlay, const OverlayArea& area, std::string status) {
    if (status.empty()) return;
    const float room = area.high.x - area.low.x - 16;
    const auto letters = static_cast<float>(status.size());
    const float size = std::min(area.legible(11), room / (overlay_letter_width * letters));
    const float width = overlay_letter_width * size * letters + 16;
    add_sheet(overlay, {area.high.x - width / 2, area.low.y + 0.75F * size}, {width, 1.5F * size},
              palette::faded(palette::paper, 232));
    overlay.labels.push_back({.at = {area.high.x - 8, area.low.y + 0.4F * size},
                              .text = std::move(status),
                              .size = size,
                              .colour = palette::vermilion,
                              .align = Align::right,
                              .layer = overlay_layer});
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

void add_verdict(Picture& overlay, const OverlayArea& area, const Verdict& verdict) {
    const Band band(area);
    const float middle = area.high.y - band.height() / 2;
    add_sheet(overlay, {canvas_width / 2, middle}, {area.high.x - area.low.x, band.height()},
              palette::paper);
    const float mark = 0.85F * band.size;
    add_sheet(overlay, {area.low.x + 5 + mark / 2, area.high.y - band.line() / 2}, {mark, mark},
              colour_of(verdict.grade));
    const auto add_label = [&](Point at, std::string words, float size, Colour colour,
                               Align align) {
        overlay.labels.push_back({.at = at,
                                  .text = std::move(words),
                                  .size = size,
                                  .colour = colour,
                                  .align = align,
                                  .layer = overlay_layer});
    };
    add_label({area.high.x - Band::margin,
               area.high.y - band.height() + band.line() / 2 - 0.36F * band.size},
              std::string(Band::hint), band.size, palette::grey, Align::right);
    float size = band.size;
    std::vector<std::string> lines = band.broken(verdict.text, size);
    while (lines.size() > band.lines && size > band.size / 4)
        lines = band.broken(verdict.text, size *= 0.95F);
    float y = area.high.y - band.line() / 2 - 0.36F * size;
    for (std::string& line : lines) {
        add_label({band.left, y}, std::move(line), size, palette::ink, Align::left);
        y -= band.line();
    }
}

void add_notice(Picture& overlay, const OverlayArea& area, const std::string& text,
                const std::string& remedy) {
    const float size = area.legible(10);
    const float line_height = 1.4F * size;
    const float letters = (area.high.x - area.low.x - 16) / (overlay_letter_width * size);
    const auto most = static_cast<std::size_t>(std::clamp(letters, 10.0F, 100.0F));
    std::vector<std::string> lines = wrapped(text, most);
    const std::size_t last = lines.size();
    for (std::string& line : wrapped(remedy, most)) lines.push_back(std::move(line));
    const float height = line_height * static_cast<float>(lines.size());
    add_sheet(overlay, {canvas_width / 2, canvas_height / 2},
              {area.high.x - area.low.x, height + 1.6F * size},
              palette::faded(palette::paper, 232));
    float y = (canvas_height + height) / 2 - size;
    for (std::size_t i = 0; i < lines.size(); ++i, y -= line_height)
        overlay.labels.push_back({.at = {canvas_width / 2, y},
                                  .text = std::move(lines[i]),
                                  .size = size,
                                  .colour = i < last ? palette::vermilion : palette::grey,
                                  .align = Align::centre,
                                  .layer = overlay_layer});
}

void keep_legible(Picture& picture, const OverlayArea& area) {
    for (Label& label : picture.labels) {
        if (label.size_in != Space::canvas) continue;
        float most = std::min(2 * label.size, least_game_pixels / area.pixels);
        if (label.space == Space::canvas)
            most = std::min(most, room_of(label, area) / overlay_letter_width /
                                      static_cast<float>(label.text.size() + 1));
        label.size = std::max(label.size, most);
    }
}

}  // namespace oiler
