// SPDX-License-Identifier: MIT
// The view on a body. The positions are worked out by hand: the canvas is 640 × 360 units, the
// camera is 36 m high, so that a unit is 0.1 m, and the canvas point (320, 180) is its centre.
#include "oiler/overlay/follower.hpp"

#include "oiler/game/look.hpp"
#include "oiler/input/input.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Point middle{320, 180};
constexpr Point at_right{420, 180};  // the world's (10, 0)

/// Two bodies that are drawn at (-10, 0) and (10, 0), m, as the game sees them.
struct Watched {
    World world{2};
    Entity left = world.spawn({});
    Entity right = world.spawn({});
    Point left_at{-10, 0};
    Point right_at{10, 0};
    float height = 36;
    Camera shown{{0, 0}, height};
    InputQueue queue;
    Follower follower;

    [[nodiscard]] Picture picture() const {
        return {.camera = {{0, 0}, height},
                .discs = {{.key = key_of(world, left), .centre = left_at},
                          {.key = key_of(world, right), .centre = right_at}}};
    }
    /// A frame at `time`, s. Returns its camera.
    Camera frame(double time) {
        Picture shown_next = picture();
        follower.look(queue.take(shown), shown, shown_next, world, time);
        follower.move(shown_next);
        return shown = shown_next.camera;
    }
    Camera click(Point canvas, double time) {
        queue.point_at(canvas);
        queue.set(Mouse::left, true);
        queue.set(Mouse::left, false);
        return frame(time);
    }
    Camera double_click(Point canvas, double time) {
        click(canvas, time);
        return click(canvas, time + 0.2);
    }
};

TEST(Follower, FollowsADoubleClickedBody) {
    Watched watched;
    EXPECT_EQ(watched.frame(0).centre, Point{}) << "the game's camera";
    EXPECT_EQ(watched.click(at_right, 1).centre, Point{}) << "one click is the game's";
    EXPECT_FALSE(watched.follower.followed());
    EXPECT_EQ(watched.click(at_right, 1.2).centre, (Point{10, 0}));
    EXPECT_EQ(watched.follower.followed(), watched.right);
    watched.right_at = {-3, 4};
    EXPECT_EQ(watched.frame(2).centre, (Point{-3, 4}));
    watched.height = 18;
    EXPECT_EQ(watched.frame(3), (Camera{{-3, 4}, 18})) << "the game zooms";
}

TEST(Follower, EndsWithADoubleClickOnTheBodyOrBesideAll) {
    for (const Point canvas : {middle, Point{320, 60}}) {
        Watched watched;
        watched.double_click(at_right, 1);
        ASSERT_EQ(watched.follower.followed(), watched.right);
        // In the followed view the body is in the middle, and nothing is 12 m above it.
        EXPECT_EQ(watched.double_click(canvas, 2).centre, Point{});
        EXPECT_FALSE(watched.follower.followed());
    }
}

TEST(Follower, TakesTheNearestBodyWithinReach) {
    Watched watched;
    // 6 % of the height are 21.6 canvas units.
    watched.double_click({420, 180 + 23}, 1);
    EXPECT_FALSE(watched.follower.followed());
    watched.double_click({420, 180 + 20}, 2);
    EXPECT_EQ(watched.follower.followed(), watched.right);
    watched.left_at = {11, 0};
    EXPECT_EQ(watched.double_click({320 + 6, 180}, 3).centre, (Point{11, 0})) << "of the two";
    EXPECT_EQ(watched.follower.followed(), watched.left);
}

TEST(Follower, TakesAnotherBodyFromTheFollowedView) {
    Watched watched;
    watched.double_click(at_right, 1);
    // The left body is 20 m, 200 canvas units, to the left of the followed one.
    EXPECT_EQ(watched.double_click({320 - 200, 180}, 2).centre, (Point{-10, 0}));
    EXPECT_EQ(watched.follower.followed(), watched.left);
}

TEST(Follower, NeedsTwoClicksInOnePlaceWithinTheTime) {
    Watched watched;
    watched.click(at_right, 1);
    watched.click(at_right, 1.41);
    EXPECT_FALSE(watched.follower.followed()) << "too late";
    watched.click({420 + 7, 180}, 1.5);
    EXPECT_FALSE(watched.follower.followed()) << "7 units aside";
    watched.click({420 + 7, 180 + 5}, 1.6);
    EXPECT_EQ(watched.follower.followed(), watched.right) << "5 units aside";
    watched.click({420 + 7, 180 + 5}, 1.7);
    EXPECT_TRUE(watched.follower.followed()) << "a third click begins another double click";
    watched.click({420 + 7, 180 + 5}, 1.8);
    EXPECT_FALSE(watched.follower.followed());
}

TEST(Follower, TakesABodyThatMovesAwayBetweenTheClicks) {
    Watched watched;
    watched.click(at_right, 1);
    watched.right_at = {14, 0};
    EXPECT_EQ(watched.click(at_right, 1.2).centre, (Point{14, 0}));
    EXPECT_EQ(watched.follower.followed(), watched.right);
}

TEST(Follower, TakesABodyThatComesBetweenTheClicks) {
    Watched watched;
    watched.click(middle, 1);
    watched.left_at = {0, 0};
    watched.click(middle, 1.2);
    EXPECT_EQ(watched.follower.followed(), watched.left);
}

TEST(Follower, TheRightButtonMovesTheFollowedView) {
    Watched watched;
    watched.double_click(at_right, 1);
    watched.queue.point_at(Point{300, 200});
    watched.queue.set(Mouse::right, true);
    EXPECT_EQ(watched.frame(2).centre, (Point{10, 0}));
    watched.queue.point_at(Point{340, 190});
    // The picture goes 40 units, 4 m, to the right and 1 m down, and the camera the other way.
    EXPECT_EQ(watched.frame(2.1).centre, (Point{6, 1}));
    EXPECT_EQ(watched.frame(2.2).centre, (Point{6, 1})) << "the mouse rests";
    watched.queue.set(Mouse::right, false);
    watched.frame(2.3);
    watched.queue.point_at(Point{100, 100});
    EXPECT_EQ(watched.frame(2.4).centre, (Point{6, 1})) << "the button is up";
    watched.right_at = {20, 5};
    EXPECT_EQ(watched.frame(3).centre, (Point{16, 6})) << "aside as before";
    watched.double_click({320 + 40, 180 - 10}, 4);
    EXPECT_FALSE(watched.follower.followed());
    // In the game's view the body is at (20, 5) m.
    EXPECT_EQ(watched.double_click({320 + 200, 180 + 50}, 5).centre, (Point{20, 5}))
        << "from the middle again";
}

TEST(Follower, EndsWithItsBody) {
    Watched watched;
    watched.double_click(at_right, 1);
    watched.world.destroy(watched.right);
    EXPECT_EQ(watched.frame(2).centre, Point{});
    EXPECT_FALSE(watched.follower.followed());
}

}  // namespace
}  // namespace oiler::test
