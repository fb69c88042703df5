// SPDX-License-Identifier: MIT
#include "oiler/whatif/frame_share.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

using std::chrono::microseconds;

/// A display of 60 Hz, on which a frame comes one refresh late if it takes too long.
struct Display {
    FrameShare::Clock::time_point now{};
    FrameShare share{now};
    microseconds drawing;
    microseconds part{100};  ///< of the work

    /// Returns the mean time, in ms, that was spent in each of these frames, and how many were
    /// late.
    std::pair<double, int> show(int frames) {
        microseconds sum{0};
        int late = 0;
        for (int frame = 0; frame < frames; ++frame) {
            share.begin_frame(now);
            microseconds spent{0};
            for (; share.has_time(); spent += part) share.spend(part);
            const bool is_late = drawing + spent > microseconds(16'667);
            now += microseconds(is_late ? 33'333 : 16'667);
            late += is_late ? 1 : 0;
            sum += spent;
        }
        return {1e-3 * static_cast<double>(sum.count()) / frames, late};
    }
};

TEST(FrameShare, GrowsWhileFramesComeInTime) {
    Display display{.drawing = microseconds(2'000)};
    EXPECT_NEAR(display.show(30).first, 3, 0.1);
    (void)display.show(15 * 30);  // 3 * 1.05^15 > 6
    const auto [mean, late] = display.show(300);
    EXPECT_NEAR(mean, 6, 0.1);
    EXPECT_EQ(late, 0);
}

// From 3.7 ms on, a window of 30 frames is late: one of 14, because 2 * 1.05^13 > 3.7.
TEST(FrameShare, GivesWayWhenFramesComeLate) {
    Display display{.drawing = microseconds(13'000)};
    (void)display.show(600);
    const auto [mean, late] = display.show(14 * 30 * 3);
    EXPECT_GT(mean, 2);
    EXPECT_LT(mean, 3.7);
    EXPECT_GT(late, 0);
    EXPECT_LE(late, 30 * 3);
}

TEST(FrameShare, GrowsWhereFramesAreAsLateWithoutIt) {
    Display display{.drawing = microseconds(17'000)};
    (void)display.show(15 * 30);
    EXPECT_NEAR(display.show(300).first, 6, 0.1);
}

TEST(FrameShare, ALongPartTakesTheTimeOfLaterFrames) {
    Display display{.drawing = microseconds(2'000), .part = microseconds(10'000)};
    EXPECT_NEAR(display.show(29).first, 3, 0.4) << "10 ms in three of ten frames";
}

}  // namespace
}  // namespace oiler::test
