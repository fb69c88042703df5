// SPDX-License-Identifier: MIT
#include "oiler/core/state_hash.hpp"
#include "oiler/core/handle_slots.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace std::string_view_literals;

std::uint64_t hash_of(std::string_view text) {
    StateHash hash;
    hash.add(std::as_bytes(std::span(text)));
    return hash.value();
}

template <class Number>
std::uint64_t hash_of_column(const std::vector<Number>& column) {
    StateHash hash;
    hash.add(std::span<const Number>(column));
    return hash.value();
}

// The XXH3_64bits of no bytes with seed 0, from xxHash's sanity checks.
TEST(StateHash, EmptyInputHashesAsPublished) {
    EXPECT_EQ(StateHash().value(), 0x2D06800538D394C2U);
    EXPECT_EQ(hash_of({}), 0x2D06800538D394C2U);
}

// Buffer, lengths and results are from xxHash's sanity checks (cli/xsum_sanity_check.c,
// XSUM_XXH3_testdata, seed 0), one for each of the algorithm's ranges of length.
TEST(StateHash, TheSanityBufferHashesAsPublished) {
    std::vector<std::byte> buffer(2367);
    std::uint64_t generator = 2654435761U;
    for (std::byte& byte : buffer) {
        byte = static_cast<std::byte>(generator >> 56);
        generator *= 11400714785074694797U;
    }
    const std::pair<std::size_t, std::uint64_t> published[] = {
        {1, 0xC44BDFF4074EECDB},   {6, 0x27B56A84CD2D7325},   {12, 0xA713DAF0DFBB77E7},
        {24, 0xA3FE70BF9D3510EB},  {48, 0x397DA259ECBA1F11},  {80, 0xBCDEFBBB2C47C90A},
        {195, 0xCD94217EE362EC3A}, {403, 0xCDEB804D65C6DEA4}, {512, 0x617E49599013CB6B},
        {2048, 0xDD59E2C3A5F038E0}};
    for (const auto& [length, expected] : published) {
        StateHash hash;
        hash.add(std::span<const std::byte>(buffer).first(length));
        EXPECT_EQ(hash.value(), expected) << length;
    }
}

TEST(StateHash, NumbersAreLittleEndianBytes) {
    StateHash number;
    number.add(std::uint64_t{0x0807060504030201});
    EXPECT_EQ(number.value(), hash_of("\x01\x02\x03\x04\x05\x06\x07\x08"));
    EXPECT_EQ(hash_of_column<float>({1.0F}), hash_of({"\x00\x00\x80\x3f", 4}));
    EXPECT_EQ(hash_of_column<double>({1.0}), hash_of({"\x00\x00\x00\x00\x00\x00\xf0\x3f", 8}));
}

enum class Mode : std::uint8_t { menu, play };
struct Tag {};
struct Player {
    std::uint32_t score = 0;
    double speed = 0;  // after a gap of four bytes
    void hash(StateHash& hash) const { hash.add(score, speed); }
};

TEST(StateHash, AddsValuesAsTheirBytes) {
    StateHash hash;
    const float half = 0.5F;
    std::vector<double> column{1.0};
    hash.add(true, -2, half, Mode::play, Tag{}, Player{3, 1.0}, std::span(column),
             std::string_view("ab"));
    const std::string_view bytes =
        "\1\0\0\0\0\0\0\0"
        "\xfe\xff\xff\xff\xff\xff\xff\xff"
        "\0\0\0\0\0\0\xe0\x3f"
        "\1"
        "\3\0\0\0\0\0\0\0"
        "\0\0\0\0\0\0\xf0\x3f"
        "\0\0\0\0\0\0\xf0\x3f"
        "\2\0\0\0\0\0\0\0"
        "ab"sv;
    EXPECT_EQ(hash.value(), hash_of(bytes));
    static_assert(!Hashed<const char*> && !Hashed<std::vector<int>>, "an address is no value");
    static_assert(!Hashed<std::pair<char, int>>, "its gap has any bytes");
}

TEST(StateHash, DependsOnOrder) {
    EXPECT_NE(hash_of_column<float>({1, 2}), hash_of_column<float>({2, 1}));
}

TEST(StateHash, DependsOnTheSignOfZero) {
    EXPECT_NE(hash_of_column<double>({0.0}), hash_of_column<double>({-0.0}));
    EXPECT_NE(hash_of_column<float>({0.0F}), hash_of_column<float>({-0.0F}));
}

TEST(StateHash, DoesNotDependOnChunks) {
    std::vector<double> column(1000);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = 0.1 * static_cast<double>(i);
    const std::uint64_t whole = hash_of_column(column);
    for (const std::size_t cut : {0, 1, 3, 31, 129, 999, 1000}) {
        StateHash hash;
        hash.add(std::span<const double>(column).first(cut));
        hash.add(std::span<const double>(column).subspan(cut));
        EXPECT_EQ(hash.value(), whole) << cut;
    }
}

TEST(StateHash, IsAValue) {
    StateHash hash;
    hash.add(std::uint64_t{1});
    StateHash copy = hash;
    const std::uint64_t before = hash.value();
    copy.add(std::uint64_t{2});
    EXPECT_EQ(hash.value(), before);
    EXPECT_NE(copy.value(), before);
    hash.add(std::uint64_t{2});
    EXPECT_EQ(hash.value(), copy.value());
}

TEST(HashText, HasSixteenDigits) {
    EXPECT_EQ(hash_text(0), "0000000000000000");
    EXPECT_EQ(hash_text(0x2D06800538D394C2), "2d06800538d394c2");
}

struct Handle {
    std::uint32_t slot;
    std::uint32_t generation;
};

TEST(HandleSlots, KnowWhatIsGone) {
    HandleSlots slots;
    const auto first = slots.take<Handle>();
    const auto second = slots.take<Handle>();
    EXPECT_NE(first.slot, second.slot);
    slots.release(first.slot);
    EXPECT_FALSE(slots.holds(first.slot, first.generation));
    EXPECT_TRUE(slots.holds(second.slot, second.generation));
    EXPECT_EQ(slots.used(), 1U);
    const auto third = slots.take<Handle>();
    EXPECT_EQ(third.slot, first.slot);
    EXPECT_TRUE(slots.holds(third.slot, third.generation));
    EXPECT_FALSE(slots.holds(first.slot, first.generation));
    EXPECT_FALSE(slots.holds(7, 1));
}

// While a slot is free, no handle matches, not even one that a copy gave out.
TEST(HandleSlots, OfACopyGiveHandlesOfTheirOwn) {
    HandleSlots slots;
    const auto first = slots.take<Handle>();
    for (int i = 0; i < 3; ++i) (void)slots.take<Handle>();
    HandleSlots copy = slots;
    slots.release(first.slot);
    EXPECT_TRUE(copy.holds(first.slot, first.generation));
    EXPECT_FALSE(slots.holds(first.slot, slots.generation(first.slot) - 1));
    EXPECT_EQ(slots.generation(first.slot) % 2, 0U);
}

}  // namespace
}  // namespace oiler::test
