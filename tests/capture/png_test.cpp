// SPDX-License-Identifier: MIT
#include "oiler/capture/png.hpp"

#include <png.h>

#include <cstdlib>
#include <random>

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Pixels = std::vector<std::uint8_t>;

/// Decodes a PNG with libpng, top row first.
Pixels decode(const std::vector<std::byte>& png, Size size) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&image, png.data(), png.size())) << image.message;
    EXPECT_EQ(image.width, static_cast<unsigned>(size.width));
    EXPECT_EQ(image.height, static_cast<unsigned>(size.height));
    EXPECT_EQ(image.format, static_cast<unsigned>(PNG_FORMAT_RGB));
    Pixels pixels(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) << image.message;
    return pixels;
}

Pixels noise(Size size) {
    std::mt19937 random(5);
    Pixels pixels(static_cast<std::size_t>(size.width) * size.height * 3);
    for (auto& value : pixels) value = static_cast<std::uint8_t>(random());
    return pixels;
}

Pixels upside_down(const Pixels& pixels, Size size) {
    Pixels turned;
    const int row = size.width * 3;
    for (int y = size.height - 1; y >= 0; --y)
        turned.insert(turned.end(), pixels.begin() + y * row, pixels.begin() + (y + 1) * row);
    return turned;
}

TEST(EncodePng, LibpngReadsTheSamePixels) {
    for (const Size size : {Size{1, 1}, {1, 9}, {9, 1}, {2, 2}, {333, 77}, {640, 480}}) {
        const Pixels pixels = noise(size);
        EXPECT_EQ(decode(encode_png(size, pixels), size), upside_down(pixels, size));
    }
}

TEST(EncodePng, TheTopLeftPixelStaysTopLeft) {
    const Pixels bottom_up = {1, 2, 3, 4, 5, 6, 255, 0, 0, 7, 8, 9};
    const Pixels read = decode(encode_png({2, 2}, bottom_up), {2, 2});
    EXPECT_EQ(read, (Pixels{255, 0, 0, 7, 8, 9, 1, 2, 3, 4, 5, 6}));
}

TEST(EncodePng, SamePixelsGiveSameBytes) {
    const Pixels pixels = noise({64, 64});
    EXPECT_EQ(encode_png({64, 64}, pixels), encode_png({64, 64}, pixels));
}

TEST(EncodePng, RefusesEmptyAndTooLargeFrames) {
    for (const Size size :
         {Size{0, 0}, {0, 5}, {5, 0}, {-1, 5}, {32768, 32768}, {1 << 30, 1 << 30}})
        try {
            static_cast<void>(encode_png(size, {}));
            ADD_FAILURE() << size.width << 'x' << size.height;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
        }
}

TEST(EncodePng, PassesPngcheck) {
    if (std::system("command -v pngcheck > /dev/null") != 0)
        GTEST_SKIP() << "pngcheck is not installed";
    const Folder folder;
    const auto png = encode_png({33, 17}, noise({33, 17}));
    put(folder / "a.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    EXPECT_EQ(std::system(("pngcheck -q " + (folder / "a.png").string()).c_str()), 0);
}

}  // namespace
}  // namespace oiler::test
