// SPDX-License-Identifier: MIT
// Bodies that obstacles hold between them or meet together, some of which move.
#include "oiler/sim/bodies.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

/// A ball of 0.3 m between a wall on the left and one on the right that leans back by `angle`.
struct Squeeze {
    Squeeze(const char* method, int rate, double angle, double friction, const Obstacle& right = {})
        : world(world_of(method, rate, 2, {0, -10}, {{.normal = {1, 0}, .friction = friction}})) {
        Obstacle leaning = right;
        const Vec3 normal{-std::cos(angle), std::sin(angle)};
        leaning.shape = HalfSpaceShape{normal, dot(normal, {0.3, 0}) - 0.3};
        leaning.friction = friction;
        world.add_obstacle(leaning);
    }
    World world;
};

// A wall that closes with u presses the ball up with u/tan(angle), in one leg per step: both walls
// alone determine its way.
TEST(Squeezes, TakeOneLegPerStep) {
    for (const double angle : {0.01, 0.05, 0.2}) {
        Squeeze squeeze("rk4", 60, angle, angle / 4, {.velocity = {-3, 0}});
        World& world = squeeze.world;
        const double up = 3 / std::tan(angle);
        const Entity ball =
            world.spawn({.position = {0.3, 0}, .velocity = {0, up}, .contact = Contact{0.3}});
        const std::int64_t before = world.bodies().evaluations();
        world.step(10);
        EXPECT_LE(world.bodies().evaluations() - before, 10 * 64) << angle;
        // The reactions of the walls are ill-conditioned by 1/angle².
        EXPECT_NEAR(world.position(ball)[1] / (up / 6), 1, 64 * epsilon / (angle * angle));
        EXPECT_NEAR(world.velocity(ball)[1] / up, 1, 64 * epsilon / (angle * angle));
    }
}

// A wall that oscillates moves the ball up and down by its way over tan(angle), as long as that
// needs less than gravity downwards: 1.37/0.546 < 10 m/s². No method and rate changes that.
TEST(Squeezes, FollowAnOscillationExactly) {
    const double angle = 0.5;
    const double omega = 2 * std::acos(-1.0) / 1.2;
    for (const char* method : {"semi_implicit_euler", "velocity_verlet", "rk4"})
        for (const double friction : {0.0, 0.1}) {
            Squeeze squeeze(method, 20, angle, friction, {.swing = Swing{{-0.05, 0}, 1.2, 0}});
            World& world = squeeze.world;
            const double up = 1 / std::tan(angle);
            const Entity ball = world.spawn({.position = {0.3, 0},
                                             .velocity = {0, 0.05 * omega * up},
                                             .contact = Contact{0.3}});
            for (int tick = 1; tick <= 48; ++tick) {
                world.step();
                const double y = 0.05 * std::sin(omega * tick / 20) * up;
                EXPECT_NEAR(world.position(ball)[1], y, 1e-13) << method << ' ' << tick;
                EXPECT_NEAR(world.position(ball)[0], 0.3, 1e-13) << method << ' ' << tick;
            }
        }
}

// A ball comes to rest between two slopes. Round-off keeps it bouncing on and on where its flights
// are as low as that, which takes few events nevertheless.
TEST(Squeezes, EndBouncesInAValley) {
    for (const double x : {-0.2, 0.0, 0.1, 0.3}) {
        World world = world_of("exact", 60, 2, {0, -10});
        world.add_chain(std::vector<Vec3>{{-7.18, -2.22}, {-0.06, -4.9}, {6.6, -2.98}}, false,
                        {.restitution = 0.5});
        const Entity ball = world.spawn({.position = {x, -4.0}, .contact = Contact{0.27}});
        std::int64_t most = 0;
        for (int tick = 0; tick < 900; ++tick) {
            const std::int64_t before = world.bodies().evaluations();
            world.step();
            most = std::max(most, world.bodies().evaluations() - before);
        }
        EXPECT_LE(most, 4096) << x;
        EXPECT_EQ(world.velocity(ball), Vec3{}) << x;
    }
}

// A box that the game moves evenly, with its velocity, does what one with a velocity does: the same
// impacts at the same instants.
TEST(MovedObstacles, DoWhatEvenlyMovingOnesDo) {
    for (const int rate : {60, 240})
        for (const double speed : {-1.29, -1.85, -1.9})
            for (const double restitution : {0.0, 0.5, 0.8}) {
                const auto run = [&](bool moved) {
                    World world =
                        world_of("rk4", rate, 2, {0, -10}, {{.normal = {0, 1}, .friction = 0.3}});
                    const ObstacleHandle box =
                        world.add_obstacle({.shape = BoxShape{{2, 0.8}, {1, 1.5}},
                                            .restitution = restitution,
                                            .friction = 0.3});
                    if (!moved) world.set_obstacle_velocity(box, {speed, 0});
                    world.spawn({.position = {0.5, 0.15}, .contact = Contact{0.15}});
                    std::vector<Impact> all;
                    for (int tick = 1; tick <= 2 * rate; ++tick) {
                        const Vec3 to{2 + speed * (double(tick) / rate), 0.8};
                        if (moved) world.move_obstacle(box, to, {{speed, 0}});
                        for (const Impact& impact : impacts(world, 1)) all.push_back(impact);
                    }
                    return all;
                };
                const auto even = run(false);
                const auto moved = run(true);
                ASSERT_EQ(moved.size(), even.size()) << rate << ' ' << speed << ' ' << restitution;
                for (std::size_t i = 0; i < even.size(); ++i) {
                    EXPECT_EQ(moved[i].kind, even[i].kind);
                    EXPECT_NEAR(moved[i].time, even[i].time, 1e-9);
                }
            }
}

// In a step of semi_implicit_euler, a ball of 1 mm that slides on a segment gets below it by 2.3
// mm, past its middle. It stays on the side where it was.
TEST(MovedObstacles, KeepSmallBodiesOnTheirSide) {
    const double omega = 2 * std::acos(-1.0) / 1.2;
    for (const double friction : {0.0, 0.3, 1.0}) {
        World world = world_of("semi_implicit_euler", 30, 2, {0, -10});
        world.add_obstacle({.shape = SegmentShape{{-20, 0}, {20, 0}},
                            .friction = friction,
                            .swing = Swing{{0, 0.15}, 1.2, 0}});
        const Entity ball = world.spawn(
            {.position = {0, 0.001}, .velocity = {3, 0.15 * omega}, .contact = Contact{0.001}});
        for (int tick = 1; tick <= 90; ++tick) {
            world.step();
            const double surface = 0.15 * std::sin(omega * tick / 30);
            EXPECT_NEAR(world.position(ball)[1], surface + 0.001, 1e-12) << friction;
        }
    }
}

// In a step of semi_implicit_euler, a point that leaves a floor of boxes gets below it, at the
// joint of two of them on the sides of both. It stays on the floor.
TEST(Joints, KeepPointsAboveInLongSteps) {
    World world = world_of("semi_implicit_euler", 60, 2, {0, -10});
    for (const double x : {-0.5, 0.5})
        world.add_obstacle({.shape = BoxShape{{x, -0.5}, {1, 1}}, .restitution = 0.5});
    const Entity point =
        world.spawn({.position = {0, 1}, .velocity = {0, -3}, .contact = Contact{0}});
    for (int tick = 0; tick < 120; ++tick) {
        world.step();
        ASSERT_GE(world.position(point)[1], -1e-14) << tick;
    }
    EXPECT_EQ(world.velocity(point), Vec3{});
}

// The belt of a moving chain carries a ball over its joints, without an impact.
TEST(Joints, OfAMovingBeltAreNotFelt) {
    for (const bool reversed : {false, true}) {
        World world = world_of("rk4", 240, 2, {0, -10});
        const Vec3 along{std::cos(0.6163), std::sin(0.6163)};
        std::vector<Vec3> points;
        for (int i = -30; i <= 30; ++i) points.push_back(along * (0.37 * i + 0.05 * (i % 3)));
        if (reversed) std::ranges::reverse(points);
        world.add_chain(points, false, {.friction = 1, .belt = 3, .velocity = {0, 1.11}});
        const Vec3 start = Vec3{-along[1], along[0]} * 0.1808;
        world.spawn({.position = start, .velocity = {0, 1.11}, .contact = Contact{0.1808}});
        EXPECT_LE(count(world, 360), 2) << reversed;
    }
}

// A segment that comes up through the floor of a ball takes it along with its own speed, and lists
// that where it leaves the floor.
TEST(MovedObstacles, TakeABodyOffAnotherFace) {
    for (const bool first : {false, true})
        for (const double below : {0.3, 0.425}) {
            World world = world_of("velocity_verlet", 120, 2, {0, -10});
            const Obstacle press{.shape = SegmentShape{{-3, -below}, {3, -below}},
                                 .velocity = {0, 3}};
            if (first) world.add_obstacle(press);
            world.add_obstacle({.shape = BoxShape{{0, -1}, {20, 2}}});
            if (!first) world.add_obstacle(press);
            const Entity ball = world.spawn({.position = {0, 0.1}, .contact = Contact{0.1}});
            std::vector<Impact> all = impacts(world, 60);
            std::erase_if(all, [](const Impact& impact) { return impact.time == 0; });
            ASSERT_EQ(all.size(), 2U) << first << ' ' << below;
            EXPECT_EQ(all[0].kind, Meeting::bounce);
            EXPECT_NEAR(all[0].time, below / 3, 1e-14);
            EXPECT_NEAR(all[0].after[1], 3, 1e-14);
            EXPECT_NEAR(world.position(ball)[1], 3 * 0.5 - below + 0.1, 1e-13);
        }
}

// Both edges of a hole as wide as the ball touch it at once, from opposite sides. It falls through,
// or stays on them, and gains no energy.
TEST(Squeezes, AHoleAsWideAsTheBallEndsNoRun) {
    Dice dice(3);
    for (int run = 0; run < 200; ++run) {
        const double radius = dice.uniform(0.1, 0.5);
        const double friction = dice.chance(0.5) ? 0.5 : 0;
        World world = world_of("velocity_verlet", 30 << dice.whole(0, 2), 2, {0, -20});
        for (const double side : {-1.0, 1.0}) {
            const std::array<Shape, 3> shapes{
                BoxShape{{2 * radius * side, -radius}, {2 * radius, 2 * radius}},
                SegmentShape{{side * radius, 0}, {side * 5, 0}},
                CircleShape{{2 * radius * side, -1}, radius}};
            world.add_obstacle(
                {.shape = shapes[static_cast<std::size_t>(run % 3)], .friction = friction});
        }
        const Entity ball = world.spawn({.position = {dice.uniform(-0.6, 0.6) * radius, 2 * radius},
                                         .velocity = {dice.uniform(-0.5, 0.5), -dice.uniform(0, 8)},
                                         .contact = Contact{radius}});
        const auto energy = [&] {
            const Vec3 v = world.velocity(ball);
            return (v[0] * v[0] + v[1] * v[1]) / 2 + 20 * world.position(ball)[1];
        };
        const double before = energy();
        ASSERT_NO_THROW(world.step(200)) << run;
        EXPECT_LE(energy(), before + 1e-9) << run;
    }
}

/// How often a ball in a V of two moving half-spaces is crushed, or lifted, in 2 s. Normals are
/// less than 90° apart, so that friction below 1 never holds the ball between them.
std::pair<int, int> crushes_and_lifts(Dice& dice, bool swings, bool on_rope) {
    World world = world_of("semi_implicit_euler", 60, 2, {0, -10});
    for (const double side : {-1.0, 1.0}) {
        Obstacle wall{.shape = HalfSpaceShape{{side * dice.uniform(0.3, 1), 1}, -0.7},
                      .friction = 0.5};
        if (swings)
            wall.swing = Swing{{dice.uniform(-0.3, 0.3), dice.uniform(-0.5, 0.5)},
                               dice.uniform(1, 4),
                               dice.uniform(0, 6)};
        else
            wall.velocity = {-side * dice.uniform(-0.1, 0.5), dice.uniform(-0.3, 0.3)};
        world.add_obstacle(wall);
    }
    const Entity ball =
        world.spawn({.position = {dice.uniform(-0.3, 0.3), 1.2}, .contact = Contact{0.2}});
    if (on_rope) world.link_to_point(ball, {0, 5}, {.rest_length = 20, .pulls_only = true});
    int crushes = 0;
    int lifts = 0;
    for (int i = 0; i < 120; ++i) {
        world.step();
        for (const Impact& impact : world.impacts()) {
            crushes += impact.kind == Meeting::crushed ? 1 : 0;
            lifts += impact.kind == Meeting::lifted ? 1 : 0;
        }
    }
    return {crushes, lifts};
}

// One of these 400 balls is crushed nevertheless, at an instant at which it sticks to one wall and
// begins to be pushed by the other.
TEST(Squeezes, AnOpenVThatSwingsCrushesNothing) {
    Dice dice(17);
    int crushes = 0;
    for (int run = 0; run < 400; ++run) crushes += crushes_and_lifts(dice, true, false).first;
    EXPECT_LE(crushes, 1);
}

// A slack rope changes nothing: the walls carry the ball, and do not run over it.
TEST(Squeezes, AnOpenVLiftsNoBallOnASlackRope) {
    Dice dice(18);
    int lifts = 0;
    for (int run = 0; run < 60; ++run) lifts += crushes_and_lifts(dice, false, true).second;
    EXPECT_LE(lifts, 20);
}

// Two rollers that turn towards each other draw a ball in until it touches both: √(0.65² − 0.5²) m
// above the line between their centres. From a friction of √(0.65² − 0.5²)/0.5 = 0.83 on, no pushes
// bear it there, however large: it is locked, not thrown.
TEST(Squeezes, RollersThatDrawABallInHoldIt) {
    for (const char* method : {"velocity_verlet", "rk4"})
        for (const double friction : {0.5, 1.5, 30.0, 1e6, 1e300})
            for (const bool on_rope : {false, true}) {
                World world = world_of(method, 30, 2, {0, -10});
                for (const double side : {-1, 1})
                    world.add_obstacle({.shape = CircleShape{{0.5 * side, 0}, 0.4},
                                        .friction = friction,
                                        .belt = -1.5 * side});
                const Entity ball = world.spawn(
                    {.position = {0.05, 1}, .velocity = {0.3, 0}, .contact = Contact{0.25}});
                if (on_rope)
                    world.link_to_point(ball, {0, 9},
                                        {.stiffness = 20, .rest_length = 60, .pulls_only = true});
                world.step(60);
                const double y = std::sqrt(0.65 * 0.65 - 0.5 * 0.5);
                EXPECT_NEAR(world.position(ball)[0], 0, 1e-12) << friction;
                EXPECT_NEAR(world.position(ball)[1], y, 1e-12) << friction;
                EXPECT_LE(std::hypot(world.velocity(ball)[0], world.velocity(ball)[1]), 1e-12);
                EXPECT_TRUE(impacts(world, 30).empty()) << method << ' ' << friction;
            }
}

/// A ball of 0.25 m in the crease of two half-spaces with belts.
struct BeltCrease {
    struct Belt {
        Vec3 normal;
        double friction;
        double speed;
    };
    BeltCrease(const char* method, int rate, const Vec3& gravity, const Belt& one, const Belt& two)
        : world(world_of(method, rate, 2, gravity)) {
        for (const Belt& belt : {one, two})
            obstacles.push_back(
                world.add_obstacle({.shape = HalfSpaceShape{normalised(belt.normal), -0.25},
                                    .friction = belt.friction,
                                    .belt = belt.speed}));
        ball = world.spawn({.contact = Contact{0.25}});
    }
    World world;
    std::vector<ObstacleHandle> obstacles{};
    Entity ball{};
};

// A wall that leans over a floor: gravity presses the ball onto the floor only, and the belt of the
// floor onto the wall. Both pushes are positive: 42 and 24 N.
TEST(Squeezes, ABeltHoldsABallUnderAWallThatLeansOverIt) {
    for (const char* method : {"velocity_verlet", "implicit_midpoint", "rk4"})
        for (const int rate : {30, 144}) {
            BeltCrease crease(method, rate, {0, -30}, {{-0.6363203, 0.7714249}, 2.3934715, -0.37},
                              {{-0.0912366, 0.9958292}, 1.5037247, 1.73});
            EXPECT_TRUE(impacts(crease.world, rate, Meeting::bounce).empty()) << method;
            EXPECT_LE(std::hypot(crease.world.position(crease.ball)[0],
                                 crease.world.position(crease.ball)[1]),
                      1e-12)
                << method << ' ' << rate;
        }
}

// The wall alone bears this ball, N = −n·g, and its belt takes it off the floor with
// g + N·(n + μ·t), where t is the belt's direction.
TEST(Squeezes, ABeltTakesABallOffAnotherOne) {
    const Vec3 gravity{-0.9418429, -0.3360534};
    const Vec3 wall = normalised(Vec3{0.9594367, -0.2819241});
    for (const char* method : {"velocity_verlet", "rk2_heun", "rk4"})
        for (const int rate : {60, 240}) {
            BeltCrease crease(method, rate, gravity, {{-0.0641547, 0.9979400}, 2.6402813, 1.846},
                              {wall, 2.8846837, -1.846});
            const double push = -dot(wall, gravity);
            const Vec3 up{-wall[1], wall[0]};  // a belt of negative speed runs anticlockwise
            const Vec3 a = gravity + wall * push + up * (2.8846837 * push);
            crease.world.step(rate / 2);
            for (const int axis : {0, 1})
                EXPECT_NEAR(crease.world.position(crease.ball)[axis], a[axis] / 8, 1e-9)
                    << method << ' ' << rate << ' ' << axis;
        }
}

// Belts that draw a ball in lock it, also while one of them moves: it stays in the crease.
TEST(Squeezes, ALockedBallFollowsItsCrease) {
    const double tilt = 0.8;
    const Vec3 left{std::sin(tilt), std::cos(tilt)};
    const Vec3 right{-std::sin(tilt), std::cos(tilt)};
    for (const char* method : {"velocity_verlet", "rk4"})
        for (const int rate : {30, 60, 240}) {
            BeltCrease crease(method, rate, {0, -10}, {left, 2, 1.5}, {right, 2, -2});
            World& world = crease.world;
            world.step(rate / 3);
            const std::int64_t before = world.bodies().evaluations();
            const Vec3 start = world.position(crease.obstacles[0]);
            const int steps = rate / 5;
            for (int tick = 1; tick <= steps; ++tick) {
                const double way = 0.3 * tick / rate;
                world.move_obstacle(crease.obstacles[0], start + left * way, left * 0.3);
                world.step();
                // n·x is the way on the left, and 0 on the right.
                const double y = way / (2 * std::cos(tilt));
                EXPECT_NEAR(world.position(crease.ball)[0], way / (2 * std::sin(tilt)), 1e-12);
                EXPECT_NEAR(world.position(crease.ball)[1], y, 1e-12) << method << ' ' << rate;
            }
            EXPECT_LE(world.bodies().evaluations() - before, steps * 512) << method << ' ' << rate;
        }
}

}  // namespace
}  // namespace oiler::test
