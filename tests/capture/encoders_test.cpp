// SPDX-License-Identifier: MIT
#include <png.h>

#include <cstdlib>
#include <random>

#include "oiler/capture/frame_record.hpp"
#include "oiler/capture/png.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Bytes = std::vector<std::byte>;

std::string random_text(std::size_t size, unsigned letters) {
    std::mt19937 random(size);
    std::string text(size, '\0');
    for (char& letter : text) letter = static_cast<char>(random() % letters);
    return text;
}

/// Texts that gzip shrinks and that it does not, below and above the reader's first buffer.
std::vector<std::string> texts() {
    return {"",
            "a",
            random_text(100, 256),
            random_text(70'000, 2),
            random_text(300'000, 256),
            std::string(3'000'000, 'x')};
}

std::string joined(const std::vector<std::string>& parts) {
    std::string whole;
    for (const std::string& part : parts) whole += part;
    return whole;
}

Bytes members_of(const std::vector<std::string>& parts) {
    Bytes bytes;
    for (const std::string& part : parts) {
        const Bytes member = gzip(part);
        bytes.insert(bytes.end(), member.begin(), member.end());
    }
    return bytes;
}

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

std::string text_of_bytes(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Gzip, ZcatJoinsTheMembers) {
    const Folder folder;
    put(folder / "a.gz", text_of_bytes(members_of(texts())));
    const std::string at = folder.path().string();
    ASSERT_EQ(std::system(("zcat " + at + "/a.gz > " + at + "/a").c_str()), 0);
    EXPECT_TRUE(text_of(folder / "a") == joined(texts()));
}

TEST(Gunzip, ReadsWhatGzipWrote) {
    const Folder folder;
    const std::string at = folder.path().string();
    for (const std::string& text : texts()) {
        put(folder / "part", text);
        for (const std::string level : {"-1", "-9"}) {
            const std::string command = "gzip -c " + level + " " + at + "/part >> " + at + "/all";
            ASSERT_EQ(std::system(command.c_str()), 0);
        }
    }
    std::string twice;
    for (const std::string& text : texts()) twice += text + text;
    EXPECT_TRUE(gunzip(bytes_of(text_of(folder / "all")), "") == twice);
    EXPECT_EQ(gunzip({}, ""), "");
}

TEST(Gzip, TheSameTextGivesTheSameBytes) {
    for (const std::string& text : texts()) EXPECT_EQ(gzip(text), gzip(text));
}

void expect_refused(std::span<const std::byte> bytes) {
    EXPECT_EQ(line_of_error(Exit::usage, [&] { (void)gunzip(bytes, "some/file.gz"); }),
              "some/file.gz: damaged gzip file; capture again");
}

TEST(Gunzip, RefusesTruncatedMembers) {
    const Bytes whole = members_of({"first", random_text(200, 256)});
    const std::size_t first = gzip("first").size();
    for (std::size_t end = 1; end < whole.size(); ++end)
        if (end != first) expect_refused(std::span(whole).first(end));
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    expect_refused(longer);
}

// The header has time, flags and system, which no reader checks, and blocks end with bits that fill
// a byte. All else is checked by a sum.
TEST(Gunzip, NoFlippedBitOfTheDataChangesTheText) {
    constexpr std::size_t header = 10;
    const std::string text = random_text(60, 256);
    const Bytes whole = gzip(text);
    int refused = 0;
    for (std::size_t bit = 8 * header; bit < 8 * whole.size(); ++bit) {
        Bytes damaged = whole;
        damaged[bit / 8] ^= std::byte{1} << (bit % 8);
        try {
            EXPECT_EQ(gunzip(damaged, "some/file.gz"), text) << bit;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
            ++refused;
        }
    }
    EXPECT_GE(refused, 8 * 60) << "at least each bit of the text";
}

// Else a small file could fill the memory.
TEST(Gunzip, RefusesAMemberAboveItsLimit) {
    const Folder folder;
    const std::string file = (folder / "zeros.gz").string();
    ASSERT_EQ(std::system(("head -c 268435457 /dev/zero | gzip -1 > " + file).c_str()), 0);
    expect_refused(bytes_of(text_of(file)));
}

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
        line_of_error(Exit::usage, [&] { (void)encode_png(size, {}); });
}

/// The PNG of a black frame whose header says another size. Checksums are not read.
Bytes with_other_size(Size frame, Size said) {
    const auto count = std::size_t{3} * static_cast<std::size_t>(frame.width) *
                       static_cast<std::size_t>(frame.height);
    Bytes png = encode_png(frame, Pixels(count));
    constexpr std::size_t place_of_width = 16;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t shift = 8 * (3 - i);
        png[place_of_width + i] = static_cast<std::byte>(said.width >> shift & 0xFF);
        png[place_of_width + 4 + i] = static_cast<std::byte>(said.height >> shift & 0xFF);
    }
    return png;
}

// Data with more bytes than the pixels of the header need: 35 kB would become 36 MB, and larger
// ones would fill the memory. The sizes of a header of more than 1 GiB are refused, too.
TEST(DecodePng, TakesNoMoreMemoryThanAFrameNeeds) {
    const Size size{64, 36};
    EXPECT_EQ(decode_png(with_other_size(size, size), "a.png").rgb_bottom_up,
              Pixels(std::size_t{64} * 36 * 3));
    const auto refusal = [&](const Bytes& png) {
        return line_of_error(Exit::usage, [&] { (void)decode_png(png, "a.png"); });
    };
    EXPECT_EQ(size_of_png(with_other_size(size, {16384, 16384}), "a.png"), (Size{16384, 16384}));
    (void)refusal(with_other_size(size, {32768, 32768}));
    EXPECT_EQ(refusal(with_other_size({4000, 3000}, size)),
              "a.png: not a valid PNG (outofmem); capture again");
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
