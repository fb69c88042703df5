// SPDX-License-Identifier: MIT
#pragma once

#include <stb_truetype.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// A glyph's picture: where it goes, relative to the pen on the baseline, and where it is kept.
struct Glyph {
    int left = 0;    ///< pixels
    int bottom = 0;  ///< pixels, y up
    int width = 0;
    int height = 0;
    int atlas_x = 0;  ///< texels, of the lower left corner
    int atlas_y = 0;
};

/// A glyph placed in the frame, as the text shader takes it.
struct PlacedGlyph {
    std::int32_t box[4];    ///< left, bottom, width, height in pixels
    std::int32_t atlas[2];  ///< texels
    Colour colour;
};

/// The embedded font, DejaVu Sans, and the glyphs of it that have been asked for, rasterised at
/// four sub-pixel positions: text that moves by a quarter of a pixel moves smoothly, and none of it
/// is ever resampled.
class Glyphs {
public:
    static constexpr int atlas_width = 1024;

    Glyphs();

    /// Appends the glyphs of a line of UTF-8 text whose baseline starts, is centred or ends at
    /// `at` (pixels). The font's em is `em` pixels.
    void place(const Label& label, Point at, int em, std::vector<PlacedGlyph>& placed);

    /// Length of a line of text in pixels.
    [[nodiscard]] float measure(const std::string& text, int em) const;

    /// Rows of `atlas_width` bytes of coverage.
    [[nodiscard]] const std::vector<std::uint8_t>& atlas() const { return atlas_; }
    [[nodiscard]] int atlas_height() const;
    /// Changes with the atlas, so that whoever holds a copy knows when it is old.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }
    /// Forgets all glyphs when too many sizes have come and gone (a window being resized); to be
    /// called when nothing placed is waiting to be drawn.
    void tidy();

private:
    [[nodiscard]] float scale(int em) const;
    [[nodiscard]] float advance(int glyph, int next, float scale) const;
    const Glyph& find(int glyph, int em, int phase);
    Glyph rasterise(int glyph, int em, int phase);
    void reserve(Glyph& glyph);

    stbtt_fontinfo font_{};
    std::unordered_map<std::uint64_t, Glyph> known_;
    std::vector<std::uint8_t> atlas_;
    int shelf_x_ = 0;
    int shelf_y_ = 0;
    int shelf_height_ = 0;
    std::uint64_t revision_ = 0;
};

}  // namespace oiler
