// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "oiler/picture/picture.hpp"

namespace oiler::cli {

/// The places of cards on the canvas: those of games, below them those of scenes, as large as fits.
/// A card is a picture of 16:9 above a name.
class Gallery {
public:
    struct Card {
        Point low;
        Point high;
    };
    static constexpr float left = 14;  ///< units of the canvas

    Gallery(std::size_t games, std::size_t scenes);

    [[nodiscard]] Card card(std::size_t index) const;
    [[nodiscard]] std::optional<std::size_t> card_at(Point point) const;
    /// The nearest card in the row above or below; the same one if there is none.
    [[nodiscard]] std::size_t above(std::size_t index) const;
    [[nodiscard]] std::size_t below(std::size_t index) const;
    /// The height of the heading of the games or the scenes; empty if there are none.
    [[nodiscard]] std::optional<float> heading(bool of_scenes) const;
    [[nodiscard]] float width() const;
    [[nodiscard]] float picture_height() const;

private:
    struct Cell {
        std::size_t row;
        std::size_t column;
    };
    [[nodiscard]] Cell cell(std::size_t index) const;
    [[nodiscard]] std::size_t rows_of(std::size_t count) const;
    [[nodiscard]] std::size_t rows() const { return rows_of(games_) + rows_of(scenes_); }
    [[nodiscard]] float row_height() const;
    [[nodiscard]] float height() const;
    [[nodiscard]] std::size_t nearest_in_row(std::size_t row, std::size_t column) const;

    std::size_t games_;
    std::size_t scenes_;
    std::size_t columns_ = 4;
};

}  // namespace oiler::cli
