// SPDX-License-Identifier: MIT
#include "oiler/app/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"

namespace oiler {
namespace {

constexpr float left_margin = 32;
constexpr float loop_keys_left = 456;
constexpr float first_row = 296;
constexpr float bottom = 40;
constexpr float largest_size = 11;    ///< of the font
constexpr float line_height = 1.4F;   ///< of the size
constexpr float letter_width = 0.6F;  ///< of the size, of the font's usual letters
constexpr std::size_t longest_name = 20;

struct Row {
    std::string name;
    std::string text;
};

/// A sheet of paper over the whole frame, whatever its shape is; an eighth shines through.
Polygon sheet() {
    return {.points = rectangle({canvas_width / 2, canvas_height / 2},
                                {10 * canvas_width, 10 * canvas_height}),
            .colour = palette::faded(palette::paper, 224),
            .space = Space::canvas,
            .layer = overlay_layer};
}

Label label(Point at, std::string text, float size, Colour colour) {
    return {
        .at = at, .text = std::move(text), .size = size, .colour = colour, .layer = overlay_layer};
}

std::string names_of(const Buttons& buttons, const NameButton& name) {
    std::vector<std::string> names;
    for (const Button button : buttons) names.push_back(name(button));
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Lines of at most `most` letters, broken after commas.
std::vector<std::string> broken(std::string text, std::size_t most) {
    std::vector<std::string> lines;
    while (text.size() > most) {
        const std::size_t comma = text.rfind(", ", most - 1);
        if (comma == std::string::npos) break;
        lines.push_back(text.substr(0, comma + 1));
        text.erase(0, comma + 2);
    }
    lines.push_back(std::move(text));
    return lines;
}

/// Rows for the controls; a long list of buttons takes several rows, the first one with the name.
std::vector<Row> rows_of(std::span<const Control> controls, const NameButton& name,
                         std::size_t letters) {
    std::vector<Row> rows;
    for (const Control& control : controls) {
        std::string shown(control.name.substr(0, longest_name));
        if (shown.size() < control.name.size()) shown += "…";
        for (std::string& line : broken(buttons_of(control, name), letters))
            rows.push_back({std::exchange(shown, ""), std::move(line)});
    }
    if (rows.empty()) rows.push_back({"", "The game does not list its keys."});
    return rows;
}

std::vector<Row> loop_keys(bool escape_quits) {
    std::vector<Row> rows{{"F1", "inspector"},   {"F2", "close this help"}, {"F3", "pause, resume"},
                          {"F4", "go back"},     {"F5", "step in a pause"}, {"F6", "errors ×10"},
                          {"F7", "slower"},      {"F8", "faster"},          {"F9", "restart"},
                          {"F11", "full screen"}};
    if (escape_quits) rows.push_back({"Escape", "quit"});
    return rows;
}

void add_rows(Picture& picture, std::span<const Row> rows, float x, float text_x, float size) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const float y = first_row - static_cast<float>(i) * line_height * size;
        picture.labels.push_back(label({x, y}, rows[i].name, size, palette::blue));
        picture.labels.push_back(label({text_x, y}, rows[i].text, size, palette::ink));
    }
}

}  // namespace

std::string buttons_of(const Control& control, const NameButton& name) {
    std::string text = names_of(control.positive, name);
    if (!control.negative.empty())
        text = names_of(control.negative, name) + (text.empty() ? "" : " and ") + text;
    if (control.stick)
        text.append(text.empty() ? "stick " : ", stick ").append(name_of(*control.stick));
    return text.empty() ? "no button" : text;
}

void add_help(Picture& picture, std::string_view title, std::span<const Control> controls,
              const NameButton& name, bool escape_quits) {
    picture.polygons.push_back(sheet());
    std::size_t longest = 0;
    for (const Control& control : controls)
        longest = std::max(longest, std::min(control.name.size(), longest_name) + 2);
    const float letter = letter_width * largest_size;
    const float text_x = left_margin + letter * static_cast<float>(longest);
    const auto letters = static_cast<std::size_t>((loop_keys_left - text_x) / letter) - 1;
    const std::vector<Row> rows = rows_of(controls, name, letters);
    const float size = std::min(
        largest_size, (first_row - bottom) / line_height / static_cast<float>(rows.size()));
    picture.labels.push_back(label({left_margin, 324}, std::string(title), 15, palette::ink));
    add_rows(picture, rows, left_margin, text_x, size);
    add_rows(picture, loop_keys(escape_quits), loop_keys_left, loop_keys_left + 48, largest_size);
}

}  // namespace oiler
