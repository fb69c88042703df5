// SPDX-License-Identifier: MIT
// Bodies between obstacles that close in on them, on belts, and on joints of boxes.
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

// A press comes down onto a ball that lies on a floor, and stays there. There is no room, so that
// the press passes: it is listed once, and the floor bears the ball as before.
TEST(Presses, ThatStayClosedLeaveTheBallOnItsFloor) {
    for (const int floor : {0, 1, 2})
        for (const double end : {-0.3, 0.0, 0.1})
            for (const double x : {-2.8, -0.3, 0.0, 1.3, 2.6})
                for (const bool has_walls : {false, true}) {
                    World world = world_of("velocity_verlet", 60, 2, {0, -g});
                    if (floor == 0) world.add_plane({.normal = {0, 1}});
                    if (floor == 1) world.add_obstacle({.shape = BoxShape{{0, -1}, {20, 2}}});
                    if (floor == 2)
                        world.add_chain(std::vector<Vec3>{{-10, 0}, {-3, 0}, {3, 0}, {10, 0}},
                                        false, {});
                    if (has_walls)
                        for (const double side : {1.0, -1.0})
                            world.add_plane({.normal = {side, 0}, .offset = -3});
                    const ObstacleHandle press =
                        world.add_obstacle({.shape = BoxShape{{0, 2.5}, {5.9, 1}}});
                    const Entity ball =
                        world.spawn({.position = {x, 0.3}, .contact = Contact{0.3}});
                    int crushed = 0;
                    for (int tick = 1; tick <= 240; ++tick) {
                        world.move_obstacle(press, {0, std::max(end + 0.5, 2.5 - tick / 60.0)});
                        ASSERT_NO_THROW(crushed += count(world, 1, Meeting::crushed));
                        ASSERT_NEAR(world.position(ball)[1], 0.3, 1e-14) << floor << end << x;
                    }
                    EXPECT_EQ(crushed, std::abs(x) < 2.9 ? 1 : 0) << floor << end << x;
                }
}

// Two walls of friction μ jam a ball if the wedge that they close is narrower than 2·atan(μ):
// with slips outwards, no pushes of both then push it out. A wider one lets it out, with the speed
// of the closing wall over the tangent of the angle.
TEST(Presses, JamABallInANarrowWedge) {
    for (const char* method : contact_methods)
        for (const double friction : {0.0, 0.2, 0.6})
            for (const double angle : {0.05, 0.35, 0.45, 1.0, 1.15}) {
                World world = world_of(method, 30, 2, {0, -10});
                world.add_plane({.normal = {0, 1}});
                world.add_plane({.normal = {1, 0}, .offset = -1.5, .friction = friction});
                world.add_obstacle(
                    {.shape = HalfSpaceShape{{-std::cos(angle), std::sin(angle)}, -1},
                     .friction = friction,
                     .velocity = {-3, 0}});
                const Entity ball = world.spawn({.position = {0, 0.3}, .contact = Contact{0.3}});
                int crushed = 0;
                double fastest = 0;
                for (int tick = 0; tick < 60; ++tick) {
                    crushed += count(world, 1, Meeting::crushed);
                    fastest = std::max(fastest, length(world.velocity(ball)));
                }
                const bool jams = angle < 2 * std::atan(friction);
                EXPECT_EQ(crushed > 0, jams) << method << ' ' << friction << ' ' << angle;
                // Bounces off the closing wall are up to twice as fast as it is.
                EXPECT_LE(fastest, jams ? 6.0 : std::max(6.0, 3.01 / std::tan(angle))) << angle;
            }
}

// A box that the game moves to a new place for each step lists what one with a velocity does: the
// ball that it pushes is met once and stays on it.
TEST(Presses, MovedEvenlyByTheGameListNoBounces) {
    for (const Precision precision : {Precision::double_, Precision::single})
        for (const int rate : {60, 240, 1000}) {
            World world = world_of("velocity_verlet", rate, 2, {-2.474, -9.689}, {}, precision);
            world.add_plane({.normal = {0, 1}, .friction = 0.3});
            const ObstacleHandle box = world.add_obstacle(
                {.shape = BoxShape{{1.3, 1.2}, {1, 2.38}}, .restitution = 0, .friction = 0.3});
            const Entity ball = world.spawn({.position = {0, 0.3}, .contact = Contact{0.3}});
            std::size_t met = 0;
            for (int tick = 1; tick <= 4 * rate; ++tick) {
                world.move_obstacle(box, {1.3 - 3.0 * tick / rate, 1.2});
                world.step();
                met += world.impacts().size();
            }
            EXPECT_LE(met, 6U) << rate;
            EXPECT_NEAR(world.position(ball)[0], -11.5, 1e-3) << rate;
        }
}

// The belt of a round obstacle carries a ball by its speed v on a circle of radius R, until the
// pull along it, g·sin(a), is as large as friction, μ·(g·cos(a) − v²/R), holds.
TEST(Belts, CarryRoundACurve) {
    constexpr double R = 2.3;
    constexpr double v = 1.5;
    constexpr double friction = 1;
    double held = 0;
    for (double step = 0.5; step > 1e-16; step /= 2)
        if (g * std::sin(held + step) < friction * (g * std::cos(held + step) - v * v / R))
            held += step;
    for (const char* method : contact_methods)
        for (const int rate : {20, 60, 240})
            for (const double side : {1.0, -1.0}) {
                World world = world_of(method, rate, 2, {0, -g});
                world.add_obstacle(
                    {.shape = CircleShape{{1, -2}, 2}, .friction = friction, .belt = side * v});
                const Entity ball = world.spawn(
                    {.position = {1, R - 2}, .velocity = {side * v, 0}, .contact = Contact{R - 2}});
                const auto steps = static_cast<int>(held * R / v * rate);
                world.step(steps);
                const double angle = v / R * steps / rate;
                const Vec3 right{1 + side * R * std::sin(angle), R * std::cos(angle) - 2};
                EXPECT_NEAR(length(world.position(ball) - right), 0, 1e-12) << method << rate;
                EXPECT_NEAR(length(world.velocity(ball)), v, 1e-13);
                // Then it slips, faster and faster.
                world.step(rate / 4);
                EXPECT_GT(length(world.velocity(ball)), v + 0.05) << method << rate;
            }
}

// A belt carries a ball over the edge of a box, from where it flies: with a speed v above √(g·r) at
// once, at the instant when its centre is above the edge.
TEST(Belts, EndAtTheEdge) {
    constexpr double v = 3;
    for (const int rate : {30, 100})
        for (const double from : {0.31, 0.5, 0.77}) {
            World world = world_of("velocity_verlet", rate, 2, {0, -g});
            world.add_obstacle({.shape = BoxShape{{-5, -0.5}, {10, 1}}, .friction = 1, .belt = v});
            const Entity ball = world.spawn(
                {.position = {-from, 0.1}, .velocity = {v, 0}, .contact = Contact{0.1}});
            world.step(rate / 2);
            const double t = (rate / 2) / static_cast<double>(rate);
            const double fall = t - from / v;
            const Vec3 right{v * t - from, 0.1 - g * fall * fall / 2};
            EXPECT_NEAR(length(world.position(ball) - right), 0, 1e-13) << rate << ' ' << from;
        }
}

// A circle crushes a ball in the corner of a floor and a wall, passes it and goes on. The corner
// holds the ball, and the crush is listed once.
TEST(Presses, LeaveABallInItsCorner) {
    for (const bool boxes : {false, true})
        for (const int rate : {30, 60, 240}) {
            World world = world_of("velocity_verlet", rate, 2, {0, -g});
            if (boxes) {
                world.add_obstacle({.shape = BoxShape{{0, -1}, {20, 2}}});
                world.add_obstacle({.shape = BoxShape{{-1, 5}, {2, 10}}});
            } else {
                world.add_plane({.normal = {0, 1}});
                world.add_plane({.normal = {1, 0}});
            }
            world.add_obstacle({.shape = CircleShape{{2, 2}, 0.5}, .velocity = {-1, -0.9}});
            const Entity ball = world.spawn({.position = {0.25, 0.25}, .contact = Contact{0.25}});
            EXPECT_EQ(count(world, 4 * rate, Meeting::crushed), 1) << boxes << rate;
            EXPECT_NEAR(length(world.position(ball) - Vec3{0.25, 0.25}), 0, 1e-14) << boxes << rate;
        }
}

// Boxes side by side are one floor to a point, also where it falls exactly onto a joint.
TEST(Joints, BearPoints) {
    for (const char* method : exact_flights)
        for (const double angle : {0.0, 0.3})
            for (const double along : {0.0, 1.0, -0.1})
                for (const double height : {0.0, 1.0})
                    for (const double x : {-1.0, -0.5, 0.0}) {
                        const Vec3 right{std::cos(angle), std::sin(angle)};
                        const Vec3 up{-right[1], right[0]};
                        World world = world_of(method, 60, 2, up * -g);
                        for (int i = -4; i < 4; ++i)
                            world.add_obstacle(
                                {.shape = BoxShape{right * (i + 0.5) - up * 0.5, {1, 1}, angle},
                                 .restitution = 0.3});
                        const Entity point = world.spawn({.position = right * x + up * height,
                                                          .velocity = right * along,
                                                          .contact = Contact{}});
                        world.step(120);
                        const Vec3 end = right * (x + 2 * along);
                        EXPECT_NEAR(length(world.position(point) - end), 0, 1e-12)
                            << method << angle << along << height << x;
                    }
}

// A ball deep in a moving half-space, which passes it, is moved out of a standing one that is added
// around it.
TEST(Presses, AHalfSpaceThatIsAddedAroundAPassedBallLiftsIt) {
    for (const double angle : {0.0, 0.2, 1.5, 2.9}) {
        World world = world_of("velocity_verlet", 60, 2, {0, -g});
        const Entity ball = world.spawn(Body{.velocity = {2, -3}, .contact = Contact{0.3}});
        world.add_obstacle({.shape = HalfSpaceShape{{1, 0}, 2}, .velocity = {0.5, 0}});
        world.step(3);
        const Vec3 n{std::cos(angle), std::sin(angle)};
        const Vec3 x = world.position(ball);
        const double offset = n[0] * x[0] + n[1] * x[1] + 1;
        world.add_obstacle({.shape = HalfSpaceShape{n, offset}});
        for (int i = 0; i < 60; ++i) {
            ASSERT_NO_THROW(world.step()) << angle;
            const Vec3 now = world.position(ball);
            ASSERT_GE(n[0] * now[0] + n[1] * now[1] - offset - 0.3, -1e-9) << angle << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace oiler::test
