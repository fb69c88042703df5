// SPDX-License-Identifier: MIT
#include "oiler/render/glyphs.hpp"

#include "oiler/render/layout.hpp"
#include "render/drawing.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Rows. The atlas is full above this height.
constexpr int full = 2048;
/// Largest number of rows that one picture of the letters below adds.
constexpr int tallest = 600;

using Placed = std::vector<PlacedGlyph>;

Placed place(Glyphs& glyphs, const std::string& text, int em) {
    Placed placed;
    glyphs.place({.text = text}, {0, 0}, em, placed);
    return placed;
}

/// The pixels of a glyph in the atlas, row by row.
std::vector<std::uint8_t> picture_of(const Glyphs& glyphs, const PlacedGlyph& glyph) {
    std::vector<std::uint8_t> picture;
    for (int y = 0; y < glyph.box[3]; ++y)
        for (int x = 0; x < glyph.box[2]; ++x)
            picture.push_back(glyphs.atlas().at(static_cast<std::size_t>(
                (glyph.atlas[1] + y) * Glyphs::atlas_width + glyph.atlas[0] + x)));
    return picture;
}

/// Compares the glyphs with the same letters in a new atlas.
void expect_own_pictures(const Glyphs& glyphs, const Placed& placed, const std::string& text,
                         int em) {
    Glyphs alone;
    const Placed expected = place(alone, text, em);
    ASSERT_EQ(placed.size(), expected.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_EQ(std::to_array(placed[i].box), std::to_array(expected[i].box)) << text << em;
        EXPECT_EQ(picture_of(glyphs, placed[i]), picture_of(alone, expected[i])) << text << em;
    }
}

/// Places letters of increasing sizes until the atlas is full, as a resized window does. 50 sizes
/// of two letters, at most four to a shelf of 150 rows, are enough.
void fill(Glyphs& glyphs) {
    for (int em = 200; em < 250 && glyphs.atlas_height() <= full; ++em)
        (void)place(glyphs, "WM", em);
    EXPECT_GT(glyphs.atlas_height(), full);
}

TEST(Glyphs, AreKeptUntilTheAtlasIsFull) {
    Glyphs glyphs;
    const Placed placed = place(glyphs, "oiler", 40);
    const std::uint64_t revision = glyphs.revision();
    glyphs.clear_if_full();
    EXPECT_EQ(glyphs.revision(), revision);
    expect_own_pictures(glyphs, placed, "oiler", 40);
    (void)place(glyphs, "oiler", 40);
    EXPECT_EQ(glyphs.revision(), revision) << "no letter is rasterised twice";
}

// A picture may need more rows than a full atlas has. No letter may overwrite another.
TEST(Glyphs, AllFitIntoTheAtlasForOnePicture) {
    Glyphs glyphs;
    const std::string text = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const Placed placed = place(glyphs, text, 500);
    EXPECT_GT(glyphs.atlas_height(), full);
    expect_own_pictures(glyphs, placed, text, 500);
}

TEST(Glyphs, AreForgottenWhenTheAtlasIsFull) {
    Glyphs glyphs;
    const Placed before = place(glyphs, "oiler", 40);
    fill(glyphs);
    expect_own_pictures(glyphs, before, "oiler", 40);
    const std::uint64_t revision = glyphs.revision();
    glyphs.clear_if_full();
    EXPECT_NE(glyphs.revision(), revision);
    EXPECT_EQ(glyphs.atlas_height(), 0);
    expect_own_pictures(glyphs, place(glyphs, "oiler", 40), "oiler", 40);
    EXPECT_LE(glyphs.atlas_height(), 40) << "the first rows are used again";
}

// The renderer uploads the atlas if the revision changes. A repeated revision would leave old
// letters in the texture.
TEST(Glyphs, NeverRepeatARevision) {
    Glyphs glyphs;
    std::set<std::uint64_t> revisions{glyphs.revision()};
    for (int round = 0; round < 3; ++round) {
        fill(glyphs);
        EXPECT_TRUE(revisions.insert(glyphs.revision()).second);
        glyphs.clear_if_full();
        EXPECT_TRUE(revisions.insert(glyphs.revision()).second);
    }
}

Picture of_letters(float size) { return of_text("WM", {0, 20}, size); }

TEST(Atlas, IsUploadedAnewAfterItWasFull) {
    const auto studio = open_studio(Offscreen::automatic);
    if (!studio) GTEST_SKIP() << "neither OSMesa nor EGL is installed";
    const Picture picture = of_text("oiler", {100, 100}, 40);
    const Pixels first = studio->draw(picture);
    for (float size = 200; size < 260; ++size) (void)studio->draw(of_letters(size));
    EXPECT_EQ(studio->draw(picture).rgb, first.rgb);
}

TEST(Atlas, IsClearedIfFullBeforeEachPicture) {
    Glyphs glyphs;
    Layout layout;
    int largest = 0;
    for (float size = 200; size < 260; ++size) {
        lay_out(of_letters(size), 0, {640, 360}, glyphs, layout);
        largest = std::max(largest, glyphs.atlas_height());
    }
    EXPECT_GT(largest, full) << "the atlas was never full";
    EXPECT_LE(largest, full + tallest);
}

}  // namespace
}  // namespace oiler::test
