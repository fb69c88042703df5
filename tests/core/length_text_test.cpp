// SPDX-License-Identifier: MIT
#include "oiler/core/length_text.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

TEST(LengthText, HasTheUnitOfItsSize) {
    EXPECT_EQ(length_text(0), "0 m");
    EXPECT_EQ(length_text(3e-13), "3e-13 m");
    EXPECT_EQ(length_text(1.06e-10), "0.11 nm");
    EXPECT_EQ(length_text(2.5e-8), "25 nm");
    EXPECT_EQ(length_text(4.9e-7), "0.49 µm");
    EXPECT_EQ(length_text(2.5e-6), "2.5 µm");
    EXPECT_EQ(length_text(1.3e-5), "13 µm");
    EXPECT_EQ(length_text(0.0025), "2.5 mm");
    EXPECT_EQ(length_text(0.075), "7.5 cm");
    EXPECT_EQ(length_text(9.8e-8), "98 nm");
    EXPECT_EQ(length_text(9.94e-5), "99 µm");
    EXPECT_EQ(length_text(0.0099), "9.9 mm");
    EXPECT_EQ(length_text(0.994), "99 cm");
    EXPECT_EQ(length_text(0.997), "0.997 m");
    EXPECT_EQ(length_text(3.14159), "3.14 m");
    EXPECT_EQ(length_text(999.7), "1000 m");
    EXPECT_EQ(length_text(12345.6), "12346 m");
    EXPECT_EQ(length_text(5e96), "5.0e+96 m");
}

}  // namespace
}  // namespace oiler::test
