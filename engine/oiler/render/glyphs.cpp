// SPDX-License-Identifier: MIT
// Static, because Dear ImGui brings functions of the same names.
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include "oiler/render/glyphs.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "oiler/core/utf8.hpp"
#include "oiler/render/embedded.hpp"

namespace oiler {
namespace {

constexpr int phases = 4;
// Rows. GL 3.3 guarantees textures of 1024 rows; all tested drivers have at least 8192.
constexpr int full_atlas = 2048;

std::vector<int> glyph_numbers(const stbtt_fontinfo& font, const std::string& text) {
    std::vector<int> numbers;
    for (const char32_t code : decode_utf8(text))
        numbers.push_back(stbtt_FindGlyphIndex(&font, static_cast<int>(code)));
    return numbers;
}

float share_before(Align align) {
    return align == Align::left ? 0.0F : align == Align::centre ? 0.5F : 1.0F;
}

}  // namespace

Glyphs::Glyphs() {
    const auto* data = reinterpret_cast<const unsigned char*>(embedded::font().data());
    [[maybe_unused]] const int understood = stbtt_InitFont(&font_, data, 0);
    assert(understood != 0);
}

float Glyphs::scale(int em) const {
    return stbtt_ScaleForMappingEmToPixels(&font_, static_cast<float>(em));
}

float Glyphs::advance(int glyph, int next, float scale) const {
    int width = 0;
    int bearing = 0;
    stbtt_GetGlyphHMetrics(&font_, glyph, &width, &bearing);
    const int kerning = next < 0 ? 0 : stbtt_GetGlyphKernAdvance(&font_, glyph, next);
    return scale * static_cast<float>(width + kerning);
}

float Glyphs::measure(const std::string& text, int em) const {
    const std::vector<int> numbers = glyph_numbers(font_, text);
    float length = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        length += advance(numbers[i], i + 1 < numbers.size() ? numbers[i + 1] : -1, scale(em));
    return length;
}

void Glyphs::place(const Label& label, Point at, int em, std::vector<PlacedGlyph>& placed) {
    const std::vector<int> numbers = glyph_numbers(font_, label.text);
    const int baseline = static_cast<int>(std::lround(at.y));
    float pen = at.x - share_before(label.align) * measure(label.text, em);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto quarters = static_cast<int>(std::lround(pen * phases));
        const Glyph& glyph = find(numbers[i], em, quarters & (phases - 1));
        if (glyph.width > 0) {
            placed.push_back(
                {{(quarters >> 2) + glyph.left, baseline + glyph.bottom, glyph.width, glyph.height},
                 {glyph.atlas_x, glyph.atlas_y},
                 label.colour});
        }
        pen += advance(numbers[i], i + 1 < numbers.size() ? numbers[i + 1] : -1, scale(em));
    }
}

const Glyph& Glyphs::find(int glyph, int em, int phase) {
    const std::uint64_t key = (static_cast<std::uint64_t>(em) << 32U) |
                              (static_cast<std::uint64_t>(glyph) << 2U) |
                              static_cast<std::uint64_t>(phase);
    const auto [entry, fresh] = known_.try_emplace(key);
    if (fresh) entry->second = rasterise(glyph, em, phase);
    return entry->second;
}

Glyph Glyphs::rasterise(int glyph, int em, int phase) {
    const float factor = scale(em);
    const float shift = static_cast<float>(phase) / phases;
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&font_, glyph, factor, factor, shift, 0, &left, &top, &right,
                                    &bottom);
    Glyph picture{left, -bottom, right - left, bottom - top, 0, 0};
    if (picture.width <= 0 || picture.height <= 0 || picture.width > atlas_width) {
        return {};
    }
    reserve(picture);
    // stb writes the top row first; a frame starts with its bottom row.
    std::vector<std::uint8_t> rows(static_cast<std::size_t>(picture.width) * picture.height);
    stbtt_MakeGlyphBitmapSubpixel(&font_, rows.data(), picture.width, picture.height, picture.width,
                                  factor, factor, shift, 0, glyph);
    for (int y = 0; y < picture.height; ++y) {
        const auto row = rows.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
        const int target = picture.atlas_y + picture.height - 1 - y;
        std::copy_n(
            row, picture.width,
            atlas_.begin() + static_cast<std::ptrdiff_t>(target) * atlas_width + picture.atlas_x);
    }
    return picture;
}

/// Reserves space on the current shelf of the atlas, or on a new shelf above it.
void Glyphs::reserve(Glyph& glyph) {
    if (shelf_x_ + glyph.width > atlas_width) {
        shelf_x_ = 0;
        shelf_y_ += shelf_height_;
        shelf_height_ = 0;
    }
    glyph.atlas_x = shelf_x_;
    glyph.atlas_y = shelf_y_;
    shelf_x_ += glyph.width;
    shelf_height_ = std::max(shelf_height_, glyph.height);
    const auto needed = static_cast<std::size_t>(shelf_y_ + shelf_height_) * atlas_width;
    atlas_.resize(std::max(atlas_.size(), needed));
    ++revision_;
}

int Glyphs::atlas_height() const { return static_cast<int>(atlas_.size() / atlas_width); }

void Glyphs::clear_if_full() {
    if (atlas_height() <= full_atlas) return;
    known_.clear();
    atlas_.clear();
    shelf_x_ = shelf_y_ = shelf_height_ = 0;
    ++revision_;
}

}  // namespace oiler
