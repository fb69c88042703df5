// SPDX-License-Identifier: MIT
#include "oiler/overlay/help.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "oiler/overlay/legible.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/picture/theme.hpp"

namespace oiler {
namespace {

constexpr float line_height = 1.4F;   ///< of the size
constexpr float letter_width = 0.6F;  ///< of the size, of the font's usual letters
constexpr std::size_t longest_name = 20;
constexpr float letters_of_loop_keys = 29;
constexpr float least_letters_beside = 80;  ///< in an area with two columns

/// A sheet of paper over the whole area; little shines through.
Polygon sheet(const OverlayArea& area, Colour paper) {
    return {.points = {area.low, {area.high.x, area.low.y}, area.high, {area.low.x, area.high.y}},
            .colour = palette::faded(paper, 248),
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

/// A title in as many lines as it takes, smaller if those are many.
struct Title {
    static constexpr std::size_t most_lines = 2;

    Title(const std::string& text, float largest, float room) : size(largest) {
        constexpr float least = 1.0F / 16;  // of the largest; a window may be smaller than a letter
        while (!fits(text, room) && size > least * largest) size *= 0.95F;
    }
    [[nodiscard]] float height() const {
        return line_height * size * static_cast<float>(lines.size());
    }
    bool fits(const std::string& text, float room) {
        const auto most = static_cast<std::size_t>(std::max(1.0F, room / (letter_width * size)));
        lines = broken_at_spaces(text, most);
        return lines.size() <= most_lines && std::ranges::all_of(lines, [&](const auto& one) {
                   return wider_letters * text_width(one, size) <= room;
               });
    }

    std::vector<std::string> lines;
    float size;
};

/// Rows for the controls; a long list of buttons takes several rows, the first one with the name.
std::vector<HelpRow> rows_of(std::span<const Control> controls, const NameButton& name,
                             std::size_t letters) {
    std::vector<HelpRow> rows;
    for (const Control& control : controls) {
        std::string shown(control.name.substr(0, longest_name));
        if (shown.size() < control.name.size()) shown += "…";
        for (std::string& line : broken(buttons_of(control, name), letters))
            rows.push_back({std::exchange(shown, ""), std::move(line)});
    }
    if (rows.empty()) rows.push_back({"", "The game lists no keys of its own."});
    return rows;
}

/// Rows side by side in so many columns.
std::vector<HelpRow> in_columns(const std::vector<HelpRow>& rows, std::size_t columns) {
    std::vector<HelpRow> wide((rows.size() + columns - 1) / columns);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::string& text = wide[i % wide.size()].text;
        const std::string words = rows[i].name + " " + rows[i].text;
        text += text.empty() ? words : ",  " + words;
    }
    return wide;
}

/// A list whose first row is at a place.
struct List {
    Point at;
    float text_x;
    float size;

    void add(Picture& overlay, std::span<const HelpRow> rows) const {
        const Theme& theme = theme_of(overlay.background);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const float y = at.y - static_cast<float>(i) * line_height * size;
            overlay.labels.push_back(label({at.x, y}, rows[i].name, size, theme.faint));
            overlay.labels.push_back(label({text_x, y}, rows[i].text, size, theme.ink));
        }
    }
};

std::size_t longest_of(std::span<const Control> controls) {
    std::size_t longest = 0;
    for (const Control& control : controls)
        longest = std::max(longest, std::min(control.name.size(), longest_name) + 2);
    return longest;
}

}  // namespace

std::string buttons_of(const Control& control, const NameButton& name) {
    std::string text = names_of(control.positive, name);
    if (!control.negative.empty())
        text = names_of(control.negative, name) + (text.empty() ? "" : " and ") + text;
    const auto add = [&](std::string_view more) {
        text.append(text.empty() ? "" : ", ").append(more);
    };
    if (control.stick) add(describe(*control.stick));
    if (control.by_mouse == ByMouse::yes) add("mouse");
    return text.empty() ? "no button" : text;
}

void add_help(Picture& overlay, const OverlayArea& area, std::string_view title,
              std::span<const Control> controls, const NameButton& name,
              std::vector<HelpRow> loop_keys) {
    const Theme& theme = theme_of(overlay.background);
    overlay.polygons.push_back(sheet(area, theme.paper));
    const float largest = area.legible(11);
    const float letter = letter_width * largest;
    const float room = area.high.x - area.low.x;
    const bool is_wide = room > least_letters_beside * letter;
    const float margin = (is_wide ? 3 : 1) * largest;
    const float left = area.low.x + margin;
    const float top = area.high.y - 3 * largest;
    const Title heading(std::string(title), 1.35F * largest, area.high.x - margin - left);
    const float first_row = top - heading.height() - 0.11F * largest;
    const float text_x = left + letter * static_cast<float>(longest_of(controls));
    const float loop_x = area.high.x - letters_of_loop_keys * letter;
    const float end = is_wide ? loop_x : area.high.x - margin;
    const auto letters = static_cast<std::size_t>(std::max(8.0F, (end - text_x) / letter)) - 1;
    std::vector<HelpRow> rows = rows_of(controls, name, letters);
    if (!is_wide) {
        loop_keys = in_columns(loop_keys, 2);
        rows.push_back({});
    }
    const std::size_t count = rows.size() + (is_wide ? 0 : loop_keys.size());
    const float size = std::min(largest, (first_row - area.low.y - 2 * largest) / line_height /
                                             static_cast<float>(std::max<std::size_t>(count, 1)));
    for (float y = top; const std::string& line : heading.lines) {
        overlay.labels.push_back(label({left, y}, line, heading.size, theme.ink));
        y -= line_height * heading.size;
    }
    List{{left, first_row}, text_x, size}.add(overlay, rows);
    if (is_wide) {
        List{{loop_x, first_row}, loop_x + 8 * letter, largest}.add(overlay, loop_keys);
    } else {
        const float y = first_row - static_cast<float>(rows.size()) * line_height * size;
        List{{left, y}, left, size}.add(overlay, loop_keys);
    }
}

}  // namespace oiler
