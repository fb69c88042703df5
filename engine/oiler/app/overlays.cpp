// SPDX-License-Identifier: MIT
#include "oiler/app/overlays.hpp"

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "oiler/app/help.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

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

}  // namespace

void add_status(Picture& picture, std::string status) {
    if (status.empty()) return;
    constexpr float size = 11;
    const float width = overlay_letter_width * size * static_cast<float>(status.size()) + 16;
    add_sheet(picture, {canvas_width - width / 2, 8}, {width, 16},
              palette::faded(palette::paper, 232));
    picture.labels.push_back({.at = {canvas_width - 8, 4},
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

void add_verdict(Picture& picture, const Verdict& verdict) {
    constexpr float height = 10;
    constexpr float left = 14;
    constexpr float largest_size = 7;
    constexpr float middle = canvas_height - height / 2;
    add_sheet(picture, {canvas_width / 2, middle}, {10 * canvas_width, height},
              palette::faded(palette::paper, 224));
    add_sheet(picture, {8, middle}, {6, 6}, colour_of(verdict.grade));
    constexpr float right = canvas_width - 8;
    constexpr std::string_view more = "F1: more  F2: keys";
    picture.labels.push_back({.at = {right, middle - 2.5F},
                              .text = std::string(more),
                              .size = largest_size,
                              .colour = palette::grey,
                              .align = Align::right,
                              .layer = overlay_layer});
    constexpr float room = right - left - overlay_letter_width * largest_size * (more.size() + 2);
    const auto letters = static_cast<float>(verdict.text.size() + 1);
    picture.labels.push_back(
        {.at = {left, middle - 2.5F},
         .text = verdict.text,
         .size = std::min(largest_size, room / (overlay_letter_width * letters)),
         .colour = palette::ink,
         .layer = overlay_layer});
}

void add_notice(Picture& picture, const std::string& text, const std::string& remedy) {
    constexpr float size = 10;
    constexpr float line_height = 14;
    std::vector<std::string> lines = wrapped(text, 100);
    lines.push_back(remedy);
    const float height = line_height * static_cast<float>(lines.size());
    add_sheet(picture, {canvas_width / 2, canvas_height / 2}, {10 * canvas_width, height + 16},
              palette::faded(palette::paper, 232));
    float y = (canvas_height + height) / 2 - size;
    for (std::string& line : lines) {
        const bool is_last = &line == &lines.back();
        picture.labels.push_back({.at = {canvas_width / 2, y},
                                  .text = std::move(line),
                                  .size = size,
                                  .colour = is_last ? palette::grey : palette::vermilion,
                                  .align = Align::centre,
                                  .layer = overlay_layer});
        y -= line_height;
    }
}

}  // namespace oiler
