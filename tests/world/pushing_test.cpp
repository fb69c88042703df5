// SPDX-License-Identifier: MIT
// Bodies that moving obstacles push along, press against others, or stand beside.
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

/// The gap of a disc at x from a circle; `both` is the sum of their radii, m.
double gap_of(const Vec3& x, const Vec3& centre, double both) { return length(x - centre) - both; }

// The wall touches the ball after (3 − 0.3)/0.5 s and pushes it with its own velocity. Friction of
// the floor presses it onto the wall, so that it never leaves it.
TEST(MovingObstacles, PushABallAlongAFloorWithFriction) {
    for (const double friction : {0.0, 0.3, 1.0})
        for (const int rate : {20, 60, 240}) {
            World world = world_of("velocity_verlet", rate, 2, {0, -g});
            world.add_obstacle(
                {.shape = HalfSpaceShape{{0, 1}, 0}, .restitution = 0, .friction = friction});
            world.add_obstacle({.shape = BoxShape{{4, 0}, {2, 4}},
                                .restitution = 0,
                                .friction = friction,
                                .velocity = {-0.5, 0}});
            const Entity ball = world.spawn({.position = {0, 0.3}, .contact = Contact{0.3}});
            EXPECT_LE(count(world, 8 * rate), 3) << friction << ' ' << rate;
            EXPECT_NEAR(world.position(ball)[0], -1.3, 1e-12) << friction << ' ' << rate;
            EXPECT_NEAR(world.velocity(ball)[0], -0.5, 1e-12);
            EXPECT_NEAR(world.position(ball)[1], 0.3, 1e-14);
        }
}

// A ball at rest on a rough circle is pressed out of the wedge that another one closes. Its
// impacts have no end; it stays outside both, and what is pressed out leaves to the open side.
TEST(MovingObstacles, PressABallOutOfAWedge) {
    World world = world_of("semi_implicit_euler", 5, 2, {0, -200});
    const ObstacleHandle moving = world.add_obstacle({.shape = CircleShape{{-1.166, 1.239}, 0.748},
                                                      .restitution = 0.498,
                                                      .friction = 0.714,
                                                      .velocity = {0.596, -1.242}});
    world.add_obstacle(
        {.shape = CircleShape{{-0.318, -0.116}, 0.629}, .restitution = 0.712, .friction = 0.839});
    const Entity ball = world.spawn(
        {.position = {-0.255, 0.769}, .velocity = {0.863, 8.799}, .contact = Contact{0.026}});
    for (int i = 0; i < 3; ++i) {
        ASSERT_NO_THROW(world.step()) << i;
        const Vec3 x = world.position(ball);
        const Vec3 centre = std::get<CircleShape>(world.obstacle(moving).shape).centre;
        EXPECT_GE(gap_of(x, centre, 0.748 + 0.026), -1e-12) << i;
        EXPECT_GE(gap_of(x, {-0.318, -0.116}, 0.629 + 0.026), -1e-12) << i;
    }
    EXPECT_GT(world.position(ball)[0], -0.2);
}

// A ball falls onto the belt of a circle with friction 1, which carries it along the curve. It
// stays outside, and its impacts have an end.
TEST(MovingObstacles, CarryOnABeltRoundACurve) {
    for (const double radius : {0.03, 0.1, 0.3})
        for (const double x : {3.0, 4.0, 5.0, 5.7, 6.3}) {
            World world = world_of("velocity_verlet", 60, 2, {0, -10});
            world.add_obstacle({.shape = CircleShape{{6, 1}, 2}, .friction = 1, .belt = 3});
            const Entity ball = world.spawn({.position = {x, 5},
                                             .velocity = {x < 4 ? 4.0 : 0.0, -3},
                                             .contact = Contact{radius}});
            for (int i = 0; i < 180; ++i) {
                ASSERT_NO_THROW(world.step()) << radius << ' ' << x;
                ASSERT_GE(gap_of(world.position(ball), {6, 1}, 2 + radius), -1e-12);
            }
        }
}

// A step of order 1 ends in the circle, with a velocity that leaves it.
TEST(MovingObstacles, AreNotEnteredByLongStepsThatLeaveThem) {
    World world = world_of("semi_implicit_euler", 26, 2, {0, -200});
    const ObstacleHandle circle = world.add_obstacle(
        {.shape = CircleShape{{1.0336325310716745, -1.7387453004855502}, 0.42663724474980774},
         .restitution = 0.98,
         .velocity = {-1.61520903668027, 0.061903584236323805}});
    const Entity ball = world.spawn({.position = {1.0317732407659979, -1.2687193136891541},
                                     .velocity = {-8.5042002627532014, 1.3885381338263934},
                                     .contact = Contact{0.0398449}});
    for (int i = 0; i < 3; ++i) {
        world.step();
        const Vec3 centre = std::get<CircleShape>(world.obstacle(circle).shape).centre;
        EXPECT_GE(gap_of(world.position(ball), centre, 0.42663724474980774 + 0.0398449), -1e-14);
    }
}

// The end of a moving segment, off which a disc slides: nearer than an eighth of its radius to its
// place in finer steps. Curves are followed with order 2.
TEST(MovingObstacles, AreLeftAtTheirEnds) {
    const auto left = [](int rate) {
        World world = world_of("velocity_verlet", rate, 2, {0, -200});
        world.add_obstacle({.shape = SegmentShape{{1.6460670991977631, -0.32199206859224028},
                                                  {2.4019102223878317, -0.36604189131225684}},
                            .restitution = 0.346754,
                            .velocity = {1.0437512908565849, 1.9464614897622745}});
        const Entity ball = world.spawn({.position = {1.6599107703853115, -0.29194994443084649},
                                         .velocity = {0.46857104268876915, 1.979982450906848},
                                         .contact = Contact{0.0307967}});
        world.step(rate / 12);
        return world.position(ball);
    };
    const Vec3 fine = left(36 * 64);
    const double coarse = length(left(36 * 4) - fine);
    EXPECT_LT(coarse, 0.0307967 / 8);
    EXPECT_LT(length(left(36 * 16) - fine), coarse / 8);
}

// A ball that is placed in a standing obstacle is lifted out of it, wherever others move.
TEST(MovingObstacles, DoNotKeepABodyInStandingOnes) {
    for (const Vec3& velocity : {Vec3{0, 1e-3}, Vec3{1e-3, 0}}) {
        World world = world_of("velocity_verlet", 60);
        world.add_obstacle({.shape = HalfSpaceShape{{0, 1}, -1000}, .velocity = velocity});
        world.add_obstacle({.shape = BoxShape{{}, {2, 2}}});
        const Entity ball = world.spawn({.position = {0.3, 0.06}, .contact = Contact{0.5}});
        const auto met = impacts(world, 2);
        ASSERT_EQ(met.size(), 1U);
        EXPECT_EQ(met[0].kind, Meeting::lifted);
        EXPECT_EQ(world.position(ball), (Vec3{1.5, 0.06}));
    }
}

// The rider of a lift that swings stays on it for two minutes, also if it is met from above only:
// its place has round-off of a few units of its amplitude, at all times.
TEST(OneWayObstacles, CarryOnASwingForMinutes) {
    for (const int rate : {60, 120}) {
        World world = world_of("velocity_verlet", rate, 2, {0, -30});
        const ObstacleHandle lift = world.add_obstacle({.shape = BoxShape{{}, {4, 0.25}},
                                                        .restitution = 0,
                                                        .swing = Swing{{0, 1}, 7},
                                                        .one_way = Vec3{0, 1}});
        const Entity rider = world.spawn({.position = {0, 0.425}, .contact = Contact{0.3}});
        for (int i = 0; i < 120 * rate; ++i) {
            world.step();
            const double top = std::get<BoxShape>(world.obstacle(lift).shape).centre[1] + 0.125;
            ASSERT_NEAR(world.position(rider)[1], top + 0.3, 32 * epsilon) << i;
            ASSERT_TRUE(world.ground(rider)) << i;
        }
    }
}

// Without a pull, the ball goes on as if the half-space were not there.
TEST(OneWayObstacles, ThatAreHalfSpacesArePassedFromInside) {
    for (const char* const method : contact_methods)
        for (const double radius : {0.0, 0.25}) {
            World world = world_of(method, 20);
            world.add_obstacle(
                {.shape = HalfSpaceShape{{0, 1}, 0}, .restitution = 1, .one_way = Vec3{0, -1}});
            const Entity ball =
                world.spawn({.position = {0, 1}, .velocity = {0, -3}, .contact = Contact{radius}});
            EXPECT_EQ(count(world, 20), 0) << method;
            EXPECT_NEAR(world.position(ball)[1], -2, 1e-13) << method;
        }
}

TEST(ObstacleHandles, KnowWhereObstaclesCameToStand) {
    const auto place_of = [](const World& world, ObstacleHandle box) {
        return std::get<BoxShape>(world.obstacle(box).shape).centre[1];
    };
    World world = world_of("velocity_verlet", 60);
    const ObstacleHandle moved = world.add_obstacle({.shape = BoxShape{{0, -0.5}, {4, 1}}});
    const ObstacleHandle stopped =
        world.add_obstacle({.shape = BoxShape{{9, 0}, {1, 1}}, .velocity = {0, 6}});
    world.move_obstacle(moved, {0, -0.7});
    world.step(5);
    world.set_obstacle_velocity(stopped, {});
    world.step(5);
    EXPECT_EQ(place_of(world, moved), -0.7);
    EXPECT_NEAR(place_of(world, stopped), 0.5, 4 * epsilon);
}

TEST(Chains, ThatCannotBeAddedLeaveNothing) {
    World world = world_of("velocity_verlet", 60);
    const std::vector<Vec3> points{{0, 0}, {1, 0}, {1, 0}, {2, 0}};
    EXPECT_THROW(world.add_chain(points, false, {}), Error);
    EXPECT_THROW(world.add_chain(std::span(points).first(1), false, {}), Error);
    EXPECT_THROW(world.add_chain(std::span(points).first(2), true, {}), Error);
    EXPECT_FALSE(world.raycast({0.5, 1}, {0.5, -1}));
}

}  // namespace
}  // namespace oiler::test
