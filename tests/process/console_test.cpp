// SPDX-License-Identifier: MIT
#include "oiler/process/console.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

TEST(TimeLeft, IsInSecondsOrMinutes) {
    EXPECT_EQ(time_left(33, 0.25), ", 99 s left");
    EXPECT_EQ(time_left(60, 0.25), ", 3 min left");
    EXPECT_EQ(time_left(3600, 0.02), ", 49 h left");
    EXPECT_EQ(time_left(2, 0.8), "") << "half a second";
    EXPECT_EQ(time_left(0.5, 0.1), "") << "too early";
    EXPECT_EQ(time_left(10, 0.01), "") << "too early";
}

TEST(LongWork, IsAnnouncedOnceItIsSeenToBeLong) {
    EXPECT_EQ(describe_long_work("of the errors", 4, 0.1),
              "10 % of the errors, 36 s left; --time-limit S ends earlier");
    EXPECT_EQ(describe_long_work("measured", 3, 0.001),
              "0 % measured; --time-limit S ends earlier");
    EXPECT_EQ(describe_long_work("measured", 1.9, 0.001), "") << "too early";
    EXPECT_EQ(describe_long_work("measured", 4, 0.5), "") << "8 s in all";
}

// A terminal obeys control characters, a CI commands at the start of a line: see for_terminal().
TEST(Say, PrintsNamesOfOthersEscaped) {
    testing::internal::CaptureStderr();
    say("a \x1b[31mtitle\n::error::b");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "a \\x1b[31mtitle\n\\x3a:error::b\n");
}

TEST(RoughTime, HasTheUnitOfItsSize) {
    EXPECT_EQ(rough_time(12.4), "12 s");
    EXPECT_EQ(rough_time(240), "4 min");
    EXPECT_EQ(rough_time(3 * 3600), "3 h");
    EXPECT_EQ(rough_time(1e7), "116 days");
}

}  // namespace
}  // namespace oiler::test
