// SPDX-License-Identifier: MIT
#include "oiler/core/read_number.hpp"

#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The standard library of this compiler reads floating-point numbers itself: it is the reference.
template <class Number>
void expect_as_from_chars(const std::string& text) {
    const char* const last = text.data() + text.size();
    Number expected = -7;
    Number number = -7;
    const auto reference = std::from_chars(text.data(), last, expected);
    const auto read = detail::read_by_strtod(text.data(), last, number);
    EXPECT_EQ(read.ec, reference.ec) << text;
    EXPECT_EQ(read.ptr - text.data(), reference.ptr - text.data()) << text;
    const bool is_same = std::memcmp(&number, &expected, sizeof(Number)) == 0;
    EXPECT_TRUE(is_same || (std::isnan(number) && std::isnan(expected))) << text;
}

TEST(ReadNumber, IsStdFromCharsWithoutIt) {
    for (const char* text : {"1",
                             "-0",
                             "0.1",
                             ".5",
                             "5.",
                             "1e3",
                             "1E-3",
                             "1e",
                             "1e+",
                             "1e5x",
                             "+1",
                             " 1",
                             "\t1",
                             "",
                             "-",
                             ".",
                             "e5",
                             "0x10",
                             "0x1p3",
                             "1,5",
                             "1 2",
                             "inf",
                             "-inf",
                             "infinity",
                             "INF",
                             "nan",
                             "-nan",
                             "nanx",
                             "infant",
                             "1e999",
                             "-1e999",
                             "1e-999",
                             "0e999",
                             "4.9e-324",
                             "2.5e-324",
                             "1.7976931348623157e308",
                             "1.8e308",
                             "3.4028235e38",
                             "3.5e38",
                             "1e-46",
                             "--1",
                             "1-2",
                             "1e5e5",
                             "0.0000e-999",
                             "12345678901234567890123456789012345678901234567890"}) {
        expect_as_from_chars<double>(text);
        expect_as_from_chars<float>(text);
    }
}

TEST(ReadNumber, IsStdFromCharsForRandomTexts) {
    constexpr std::string_view letters = "0123456789.+-eEinfatx ,";
    std::mt19937 random(1);
    for (int i = 0; i < 100'000; ++i) {
        std::string text;
        const auto length = random() % 12;
        for (unsigned k = 0; k < length; ++k) text += letters[random() % letters.size()];
        expect_as_from_chars<double>(text);
        if (HasFailure()) break;
    }
}

}  // namespace
}  // namespace oiler::test
