// SPDX-License-Identifier: MIT
// Tests frames at their edges, at their largest size, and after a change of size.
#include <cstdio>

#include "render/drawing.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

class Frame : public testing::Test {
protected:
    void SetUp() override {
        if (!studio_) GTEST_SKIP() << "neither OSMesa nor EGL is installed";
    }
    Pixels draw(const Picture& picture, Size size = {640, 360}) {
        return studio_->draw(picture, size);
    }

    std::unique_ptr<Studio> studio_ = open_studio(Offscreen::automatic);
};

/// Area of the part of a disc beyond a line at a distance from its centre.
double segment(double radius, double distance) {
    return radius * radius * std::acos(distance / radius) -
           distance * std::sqrt(radius * radius - distance * distance);
}

// The rim within the frame is 42 pixels long. Each of its pixels samples a ramp at its centre and
// is rounded to 1/255.
TEST_F(Frame, ShowsTheRimOfADiscWhoseCentreIsOutside) {
    const double area = segment(20, 10);
    for (const Point centre : {Point{-10, 180}, {650, 180}, {320, -10}, {320, 370}})
        EXPECT_NEAR(total_coverage(draw(of_disc(centre, 20))), area, 1)
            << centre.x << ", " << centre.y;
    EXPECT_EQ(red(draw(of_disc({-10, 180.5F}, 20)), 8, 180), 0);
}

// A corner is 10·√2 = 14.1 pixels from the centre: the rim reaches 5.9 pixels into the frame.
TEST_F(Frame, ShowsTheRimOfADiscBeyondACorner) {
    for (const Point centre : {Point{-10, -10}, {650, -10}, {-10, 370}, {650, 370}})
        EXPECT_GT(total_coverage(draw(of_disc(centre, 20))), 20) << centre.x << ", " << centre.y;
}

TEST_F(Frame, DoesNotShowADiscOutside) {
    for (const Point centre : {Point{-21, 180}, {661, 180}, {320, -21}, {320, 381}})
        EXPECT_EQ(total_coverage(draw(of_disc(centre, 20))), 0) << centre.x << ", " << centre.y;
}

/// A disc that covers a frame of any size.
const Picture black = of_disc({320, 180}, 1e5F);

TEST_F(Frame, HasItsSizeAfterAChangeOfOneSide) {
    for (const Size size :
         {Size{320, 180}, {320, 200}, {320, 90}, {300, 90}, {400, 90}, {400, 91}}) {
        const Pixels pixels = draw(black, size);
        EXPECT_EQ(pixels.size, size);
        ASSERT_EQ(pixels.rgb.size(), std::size_t{3} * size.width * size.height);
        EXPECT_EQ(total_coverage(pixels), size.width * size.height)
            << size.width << 'x' << size.height;
    }
}

/// The largest size, from the message for a larger one: "… choose a --size from 1x1 to WxH".
Size largest_frame(Studio& studio) {
    try {
        (void)studio.draw({}, {1 << 20, 1});
    } catch (const Error& error) {
        const std::string line = error.what();
        Size size;
        const std::string size_named = line.substr(line.rfind(' ') + 1);
        if (std::sscanf(size_named.c_str(), "%dx%d", &size.width, &size.height) == 2) return size;
    }
    ADD_FAILURE() << "the message names no largest size";
    return {1, 1};
}

TEST_F(Frame, HasTheLargestSizeThatTheMessageNames) {
    const Size largest = largest_frame(*studio_);
    EXPECT_EQ(draw({}, {largest.width, 1}).size.width, largest.width);
    EXPECT_EQ(draw({}, {1, largest.height}).size.height, largest.height);
    EXPECT_THROW((void)draw({}, {largest.width + 1, 1}), Error);
    EXPECT_THROW((void)draw({}, {1, largest.height + 1}), Error);
}

TEST_F(Frame, IsDrawnAnewInTheSameSize) {
    EXPECT_EQ(total_coverage(draw(black)), 640 * 360);
    EXPECT_EQ(total_coverage(draw(Picture{})), 0);
}

}  // namespace
}  // namespace oiler::test
