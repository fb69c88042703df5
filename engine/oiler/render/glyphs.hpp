// SPDX-License-Identifier: MIT
#pragma once

#include <stb_truetype.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// A rasterised glyph: its box relative to the pen on the baseline, and its place in the atlas.
struct Glyph {
    int left = 0;    ///< pixels
    int bottom = 0;  ///< pixels, y up
    int width = 0;
    int height = 0;
    int atlas_x = 0;  ///< lower left corner, texels
    int atlas_y = 0;
};

/// A glyph in the frame, as an instance of the text shader.
struct PlacedGlyph {
    std::int32_t box[4];    ///< left, bottom, width, height in pixels
    std::int32_t atlas[2];  ///< texels
    Colour colour;
};

/// The embedded font, DejaVu Sans, with a cache of its glyphs. Glyphs are rasterised at four
/// sub-pixel positions, so that moving text is smooth and never resampled.
class Glyphs {
public:
    static constexpr int atlas_width = 1024;

    Glyphs();

    /// Appends the glyphs of a line of UTF-8 text. Its baseline starts, is centred or ends at `at`
    /// (pixels). The font's em is `em` pixels.
    void place(const Label& label, Point at, int em, std::vector<PlacedGlyph>& placed);

    /// Length of a line of text in pixels.
    [[nodiscard]] float measure(const std::string& text, int em) const;

    /// Rows of `atlas_width` bytes of coverage.
    [[nodiscard]] const std::vector<std::uint8_t>& atlas() const { return atlas_; }
    [[nodiscard]] int atlas_height() const;
    /// Changes whenever the atlas changes, so that the holder of a copy knows when to update it.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }
    /// Empties the cache if the atlas is full, for example after many sizes of a window. Placed
    /// glyphs become invalid.
    void clear_if_full();

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
