// SPDX-License-Identifier: MIT
#include "oiler/capture/frame_record.hpp"

#include <cstdlib>
#include <random>

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

}  // namespace
}  // namespace oiler::test
