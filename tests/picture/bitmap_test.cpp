// SPDX-License-Identifier: MIT
#include "oiler/picture/bitmap.hpp"

#include <fstream>
#include <functional>

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Texels = std::vector<std::uint8_t>;

/// A PNG of 2 × 2 texels with alpha, written by Python's zlib.
constexpr std::array<unsigned char, 81> png{
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06, 0x00, 0x00,
    0x00, 0x72, 0xb6, 0x0d, 0x24, 0x00, 0x00, 0x00, 0x18, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xf0, 0x1f, 0x08, 0x1b, 0x18, 0x18, 0x99, 0x98, 0x59,
    0x58, 0xd9, 0xd8, 0x39, 0x00, 0x30, 0x5f, 0x03, 0xa2, 0x0b, 0xd4, 0x2c, 0x6f, 0x00,
    0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const Texels texels{255, 0, 0, 255, 0, 255, 0, 128,  // the top row
                    1,   2, 3, 4,   5, 6,   7, 8};

void write(const std::filesystem::path& path, std::size_t bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(bytes));
}

void expect_error(Exit exit, const std::string& words, const std::function<void()>& call) {
    try {
        call();
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), exit);
        EXPECT_TRUE(holds(error.what(), words));
    }
}

TEST(Bitmap, IsReadFromItsTopRowWithItsAlpha) {
    const Folder folder;
    write(folder / "ship.png", png.size());
    const auto bitmap = load_bitmap(folder / "ship.png");
    EXPECT_EQ(bitmap->size, (Size{2, 2}));
    EXPECT_EQ(bitmap->rgba, texels);
    EXPECT_EQ(bitmap->hash, make_bitmap({2, 2}, texels)->hash);
}

TEST(Bitmap, HasAHashOfItsSizeAndTexels) {
    Texels other = texels;
    other[15] = 9;
    const std::uint64_t hash = make_bitmap({2, 2}, texels)->hash;
    EXPECT_NE(make_bitmap({2, 2}, other)->hash, hash);
    EXPECT_NE(make_bitmap({4, 1}, texels)->hash, hash);
}

TEST(Bitmap, NamesWhatIsWrong) {
    const Folder folder;
    write(folder / "cut.png", 40);
    expect_error(Exit::usage, "cut.png: not a PNG or JPEG image",
                 [&] { (void)load_bitmap(folder / "cut.png"); });
    expect_error(Exit::usage, "missing.png: cannot read the image: No such file",
                 [&] { (void)load_bitmap(folder / "missing.png"); });
    expect_error(Exit::usage, "cannot read the image: Is a directory",
                 [&] { (void)load_bitmap(folder / ""); });
    expect_error(Exit::usage, "2x2 texels has 16 bytes, four per texel, not 12", [&] {
        (void)make_bitmap({2, 2}, Texels(12));
    });
    expect_error(Exit::usage, "sides of 1 to 8192 texels, not 8193x1", [&] {
        (void)make_bitmap({8193, 1}, Texels(std::size_t{4} * 8193));
    });
    expect_error(Exit::usage, "not 0x2", [&] { (void)make_bitmap({0, 2}, {}); });
}

}  // namespace
}  // namespace oiler::test
