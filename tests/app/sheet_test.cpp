// SPDX-License-Identifier: MIT
#include "oiler/app/film.hpp"

#include "oiler/capture/png.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/picture/palette.hpp"
#include "render/drawing.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

std::vector<std::int64_t> frames_of(std::int64_t frames) {
    const Sheet sheet(frames, {640, 360});
    std::vector<std::int64_t> wanted;
    for (std::int64_t i = -1; i <= frames; ++i)
        if (sheet.wants(i)) wanted.push_back(i);
    return wanted;
}

TEST(Sheet, ShowsUpToTwelveFramesFromTheFirstToTheLast) {
    using Frames = std::vector<std::int64_t>;
    EXPECT_EQ(frames_of(1), Frames{0});
    EXPECT_EQ(frames_of(2), (Frames{0, 1}));
    EXPECT_EQ(frames_of(12), (Frames{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
    EXPECT_EQ(frames_of(13), (Frames{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12}));
    EXPECT_EQ(frames_of(111), (Frames{0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110}));
    EXPECT_EQ(frames_of(1'000'000).back(), 999'999);
}

/// A picture of one colour.
Picture picture(int index) {
    return {.background = {static_cast<std::uint8_t>(20 * index), 100, 200}};
}

class SheetOfTiles : public testing::Test {
protected:
    void SetUp() override {
        studio = open_studio(Offscreen::automatic);
        if (!studio) GTEST_SKIP() << "no OpenGL without a screen";
    }
    /// Writes a sheet of `tiles` tiles out of `frames` frames, and reads it back.
    Image sheet(std::int64_t frames, int tiles, Size size) {
        Sheet sheet(frames, size);
        for (int i = 0; i < tiles; ++i) sheet.add(picture(i), 1.25 * i, studio->renderer);
        sheet.write(folder / "sheet.png");
        const std::string png = text_of(folder / "sheet.png");
        return decode_png(std::as_bytes(std::span(png)), "sheet.png");
    }
    /// The colour of a pixel; y counts from the top.
    static Colour colour(const Image& image, int x, int y) {
        const int row = image.size.height - 1 - y;
        const auto at = 3 * static_cast<std::size_t>(row * image.size.width + x);
        const auto& rgb = image.rgb_bottom_up;
        return {rgb.at(at), rgb.at(at + 1), rgb.at(at + 2)};
    }
    std::unique_ptr<Studio> studio;
    Folder folder;
};

// Tiles of 320 x 180 pixels with gaps of 2, in rows of four from the upper left.
TEST_F(SheetOfTiles, AreInRowsFromTheUpperLeft) {
    const Image image = sheet(12, 12, {640, 360});
    EXPECT_EQ(image.size, (Size{4 * 320 + 3 * 2, 3 * 180 + 2 * 2}));
    for (int i = 0; i < 12; ++i) {
        const int left = 322 * (i % 4);
        const int top = 182 * (i / 4);
        const Colour expected{static_cast<std::uint8_t>(20 * i), 100, 200};
        for (const auto& [x, y] : {std::pair{0, 0}, {319, 0}, {0, 179}, {160, 90}})
            EXPECT_EQ(colour(image, left + x, top + y), expected) << i << ": " << x << ' ' << y;
    }
    const std::uint8_t grey = palette::grey.r;
    for (const auto& [x, y] : {std::pair{320, 0}, {321, 90}, {0, 180}, {5, 181}, {965, 543}})
        EXPECT_EQ(colour(image, x, y), (Colour{grey, grey, grey})) << x << ' ' << y;
}

TEST_F(SheetOfTiles, OfFewFramesAreSmall) {
    EXPECT_EQ(sheet(1, 1, {640, 360}).size, (Size{320, 180}));
    EXPECT_EQ(sheet(3, 3, {100, 100}).size, (Size{3 * 320 + 2 * 2, 320}));
    EXPECT_EQ(sheet(5, 5, {640, 360}).size, (Size{4 * 320 + 3 * 2, 2 * 180 + 2}));
    EXPECT_EQ(sheet(12, 2, {640, 360}).size, (Size{2 * 320 + 2, 180})) << "an interrupted run";
    EXPECT_EQ(sheet(1, 1, {10'000, 1}).size, (Size{320, 1}));
    EXPECT_EQ(sheet(1, 1, {360, 640}).size, (Size{320, 569}));
    EXPECT_EQ(sheet(12, 12, {9, 500}).size, (Size{4 * 12 + 3 * 2, 3 * 640 + 2 * 2}));
}

// The time is in the lower right corner of the tile, and nowhere else.
TEST_F(SheetOfTiles, HaveTheirTimes) {
    const Image image = sheet(2, 2, {640, 360});
    const auto inked = [&](int left, int x0, int x1, int y0, int y1) {
        int count = 0;
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x)
                count += colour(image, left + x, y) == colour(image, left, 0) ? 0 : 1;
        return count;
    };
    for (const int left : {0, 322}) {
        EXPECT_GT(inked(left, 240, 320, 150, 180), 50);
        EXPECT_EQ(inked(left, 0, 240, 0, 180), 0);
        EXPECT_EQ(inked(left, 240, 320, 0, 150), 0);
    }
    Picture labelled = picture(1);
    add_status(labelled, OverlayArea({320, 180}), "1.25 s");
    const Pixels expected = studio->draw(labelled, {320, 180});
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) {
            const auto at = 3 * static_cast<std::size_t>((179 - y) * 320 + x);
            ASSERT_EQ(colour(image, 322 + x, y),
                      (Colour{expected.rgb[at], expected.rgb[at + 1], expected.rgb[at + 2]}));
        }
}

TEST_F(SheetOfTiles, OfNoFrameIsNotWritten) {
    Sheet(5, {640, 360}).write(folder / "sheet.png");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

}  // namespace
}  // namespace oiler::test
