// SPDX-License-Identifier: MIT
#include "oiler/cli/gallery.hpp"

#include <algorithm>

namespace oiler::cli {
namespace {

// In units of the canvas.
constexpr float top = 332, bottom = 58, gap = 6, name_height = 14, heading_height = 17;
constexpr std::size_t most_columns = 24;

}  // namespace

Gallery::Gallery(std::size_t games, std::size_t scenes) : games_(games), scenes_(scenes) {
    while (height() > top - bottom && columns_ < most_columns) ++columns_;
}

std::size_t Gallery::rows_of(std::size_t count) const { return (count + columns_ - 1) / columns_; }

float Gallery::width() const {
    const auto columns = static_cast<float>(columns_);
    return (canvas_width - 2 * left - (columns - 1) * gap) / columns;
}
float Gallery::picture_height() const { return width() * canvas_height / canvas_width; }
float Gallery::row_height() const { return picture_height() + name_height; }

float Gallery::height() const {
    const int headings = (games_ > 0 ? 1 : 0) + (scenes_ > 0 ? 1 : 0);
    return static_cast<float>(rows()) * row_height() +
           static_cast<float>(headings) * heading_height;
}

Gallery::Cell Gallery::cell(std::size_t index) const {
    if (index < games_) return {index / columns_, index % columns_};
    const std::size_t scene = index - games_;
    return {rows_of(games_) + scene / columns_, scene % columns_};
}

Gallery::Card Gallery::card(std::size_t index) const {
    const Cell at = cell(index);
    const bool below_two = index >= games_ && games_ > 0;
    const Point high_left{
        left + static_cast<float>(at.column) * (width() + gap),
        top - static_cast<float>(at.row) * row_height() - (below_two ? 2 : 1) * heading_height};
    return {{high_left.x, high_left.y - row_height()}, {high_left.x + width(), high_left.y}};
}

std::optional<std::size_t> Gallery::card_at(Point point) const {
    for (std::size_t i = 0; i < games_ + scenes_; ++i) {
        const Card one = card(i);
        if (point.x >= one.low.x && point.x < one.high.x && point.y >= one.low.y &&
            point.y < one.high.y)
            return i;
    }
    return {};
}

std::size_t Gallery::nearest_in_row(std::size_t row, std::size_t column) const {
    const std::size_t of_games = rows_of(games_);
    const std::size_t first =
        row < of_games ? row * columns_ : games_ + (row - of_games) * columns_;
    const std::size_t end = row < of_games ? games_ : games_ + scenes_;
    return std::min({first + column, first + columns_ - 1, end - 1});
}

std::size_t Gallery::above(std::size_t index) const {
    const Cell at = cell(index);
    return at.row == 0 ? index : nearest_in_row(at.row - 1, at.column);
}
std::size_t Gallery::below(std::size_t index) const {
    const Cell at = cell(index);
    return at.row + 1 == rows() ? index : nearest_in_row(at.row + 1, at.column);
}

std::optional<float> Gallery::heading(bool of_scenes) const {
    if ((of_scenes ? scenes_ : games_) == 0) return {};
    return card(of_scenes ? games_ : 0).high.y + 4;
}

}  // namespace oiler::cli
