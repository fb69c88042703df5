// SPDX-License-Identifier: MIT
#include "oiler/platform/web_keys.hpp"

#include <set>
#include <string>

#include "support/test.hpp"

namespace oiler::test {
namespace {

// USB HID Usage Tables, page 7, and the W3C's table of codes, both read by hand.
TEST(WebKeys, HaveTheNumbersOfTheUsbStandard) {
    const std::pair<std::string_view, int> keys[]{
        {"KeyA", 0x04},        {"KeyZ", 0x1D},         {"Digit1", 0x1E},  {"Digit9", 0x26},
        {"Digit0", 0x27},      {"Enter", 0x28},        {"Space", 0x2C},   {"Minus", 0x2D},
        {"Backslash", 0x31},   {"Semicolon", 0x33},    {"Slash", 0x38},   {"F1", 0x3A},
        {"F12", 0x45},         {"Insert", 0x49},       {"Delete", 0x4C},  {"ArrowRight", 0x4F},
        {"ArrowUp", 0x52},     {"NumpadDivide", 0x54}, {"Numpad1", 0x59}, {"NumpadDecimal", 0x63},
        {"ControlLeft", 0xE0}, {"MetaRight", 0xE7}};
    for (const auto& [code, number] : keys) {
        const auto key = key_of_code(code);
        ASSERT_TRUE(key) << code;
        EXPECT_EQ(static_cast<int>(*key), number) << code;
    }
}

TEST(WebKeys, GiveEachKeyOneCode) {
    std::multiset<Key> found;
    for (char letter = 'A'; letter <= 'Z'; ++letter)
        found.insert(key_of_code(std::string("Key") + letter).value());
    for (char digit = '0'; digit <= '9'; ++digit)
        found.insert(key_of_code(std::string("Digit") + digit).value());
    for (const auto& [first, names] : key_codes)
        for (const std::string_view name : names)
            if (!name.empty()) found.insert(key_of_code(name).value());
    for (std::uint16_t id = 0; id < 256; ++id) {
        const auto button = Button::of_id(id);
        if (button) {
            EXPECT_EQ(found.count(static_cast<Key>(id)), 1U) << name_of(*button);
        }
    }
}

TEST(WebKeys, KnowNoOtherCodes) {
    for (const char* code : {"", "Key", "KeyAA", "Keya", "Digit", "Digit10", "NumpadEqual", "F13",
                             "Fn", "Unidentified"})
        EXPECT_FALSE(key_of_code(code)) << code;
}

}  // namespace
}  // namespace oiler::test
