// SPDX-License-Identifier: MIT
// Floors of many pieces are one floor; jumps through ledges; a lift.
#include "world/campaigns.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

enum class Floor { boxes, chain, segments };
constexpr std::array floors{Floor::boxes, Floor::chain, Floor::segments};

/// A floor of pieces of 1 m from `from` m on, turned about the origin.
void add_floor(World& world, Floor kind, double from, int pieces, double angle,
               double restitution) {
    const auto at = [&](double x, double y) {
        return Vec3{x * std::cos(angle) - y * std::sin(angle),
                    x * std::sin(angle) + y * std::cos(angle)};
    };
    Obstacle piece{.restitution = restitution};
    std::vector<Vec3> points{at(from, 0)};
    for (int i = 0; i < pieces; ++i) {
        points.push_back(at(from + i + 1, 0));
        if (kind == Floor::boxes)
            piece.shape = BoxShape{at(from + i + 0.5, -0.5), {1, 1}, angle};
        else
            piece.shape = SegmentShape{points[points.size() - 2], points.back()};
        if (kind != Floor::chain) world.add_obstacle(piece);
    }
    if (kind == Floor::chain) world.add_chain(points, false, piece);
}

// At 7.3 m/s, 136 s pass 1000 pieces.
TEST(Joints, AreNotFeltBySlides) {
    const int pieces = whole(100, 1000);
    for (const Floor floor : floors)
        for (const Precision precision : {Precision::double_, Precision::single})
            for (const int rate : {60, 240})
                for (const double from : {0.0, 1024.0}) {
                    World world = world_of("velocity_verlet", rate, 2, {0, -g}, {}, precision);
                    add_floor(world, floor, from, pieces, 0, 0.5);
                    const Entity ball = world.spawn(
                        {.position = {from + 1, 0.5}, .velocity = {7.3}, .contact = Contact{0.5}});
                    world.step();
                    EXPECT_EQ(count(world, static_cast<int>((pieces - 2) / 7.3 * rate)), 0);
                    EXPECT_EQ(world.position(ball)[1], 0.5);
                    const double kept = precision == Precision::single ? 7.3F : 7.3;
                    EXPECT_EQ(world.velocity(ball), (Vec3{kept}));
                }
}

// Drops at right angles onto a floor at any angle. Each of some 30 bounces at up to 6 m/s adds a
// unit of round-off of it to the speed along the floor, for 2 s.
TEST(Joints, SendNothingSideways) {
    Dice dice(7);
    double largest = 0;
    for (int i = 0; i < whole(300, 20000); ++i) {
        const double angle = dice.chance(0.5) ? 0 : dice.uniform(-3, 3);
        const Vec3 up{-std::sin(angle), std::cos(angle)};
        const Vec3 along{std::cos(angle), std::sin(angle)};
        World world = world_of("velocity_verlet", dice.whole(10, 120), 2, up * -g);
        add_floor(world, floors[dice.below(3)], -2, 4, angle, dice.uniform(0, 0.9));
        const double radius = dice.uniform(0.05, 0.5);
        const double x = dice.chance(0.1) ? 0 : dice.sign() * dice.log_uniform(1e-17, 0.1);
        const Entity ball = world.spawn(
            {.position = along * x + up * dice.uniform(0.5, 2), .contact = Contact{radius}});
        world.step(2 * world.settings().stepping.rate.steps);
        largest = std::max(largest, std::abs(dot(world.velocity(ball), along)));
        ASSERT_NEAR(dot(world.position(ball), along), x, 1e-13) << i;
    }
    EXPECT_LT(largest, 5e-14);
    say("sideways at most {} m/s", largest);
}

// The first landing of a jump through a ledge, also a moving one, beside its ends and from below,
// is the same at all rates.
TEST(OneWayObstacles, EndJumpsAlikeAtAllRates) {
    Dice dice(9);
    int landed = 0;
    for (int i = 0; i < whole(100, 1500); ++i) {
        const Vec3 start{dice.uniform(-4, 4), 0.25};
        const Vec3 v{dice.uniform(-4, 4), dice.uniform(5, 9)};
        const Vec3 ledge_velocity{0, dice.chance(0.3) ? dice.uniform(-0.5, 0.5) : 0};
        std::optional<Impact> first;
        for (const int rate : {20, 60, 240}) {
            World world = world_of("velocity_verlet", rate, 2, {0, -g});
            const auto floor = world.add_plane({.normal = {0, 1}});
            world.add_obstacle({.shape = BoxShape{{0, 2}, {6, 0.2}},
                                .velocity = ledge_velocity,
                                .one_way = Vec3{0, 1}});
            world.spawn({.position = start, .velocity = v, .contact = Contact{0.25}});
            const auto met = impacts(world, 3 * rate, Meeting::bounce);
            ASSERT_FALSE(met.empty());
            if (!first) landed += met[0].obstacle != floor;
            if (!first) first = met[0];
            ASSERT_EQ(met[0].obstacle, first->obstacle) << i << ' ' << rate;
            ASSERT_NEAR(met[0].time, first->time, 1e-11) << i << ' ' << rate;
        }
    }
    say("{} of 1500 jumps end on the ledge", landed);
}

// A lift that accelerates by 4.4 m/s² at most keeps its rider at each step, whatever drives it.
TEST(MovingObstacles, CarryARiderWhateverDrivesThem) {
    const double turns = std::sqrt(4.4 / 2);  // rad/s, with an amplitude of 2 m
    for (const Precision precision : {Precision::double_, Precision::single})
        for (const int rate : {30, 60, 240})
            for (const bool smooth : {true, false}) {
                World world = world_of("velocity_verlet", rate, 2, {0, -g}, {}, precision);
                const auto lift = world.add_obstacle({.shape = BoxShape{{0, -0.5}, {2, 1}}});
                const Entity rider = world.spawn({.position = {0, 0.5}, .contact = Contact{0.5}});
                const double noise = precision == Precision::single ? 1e-6 : 1e-14;
                for (int i = 1; i <= 10 * rate; ++i) {
                    const double phase = turns * i / rate;
                    const Vec3 speed{0, -2 * turns * std::sin(phase)};
                    world.move_obstacle(lift, {0, -2.5 + 2 * std::cos(phase)},
                                        smooth ? std::optional(speed) : std::nullopt);
                    world.step();
                    ASSERT_TRUE(world.ground(rider)) << rate << ' ' << smooth << ' ' << i;
                    const double top = std::get<BoxShape>(world.obstacle(lift).shape).centre[1];
                    ASSERT_NEAR(world.position(rider)[1], top + 1, noise) << i;
                    ASSERT_TRUE(i == 1 || world.impacts().empty()) << i;
                }
            }
}

// A platform that sinks onto a ball on the floor: the ball stays where it is, and is listed once.
TEST(MovingObstacles, CrushABallWhereverTheyComeDown) {
    Dice dice(11);
    for (int i = 0; i < whole(100, 3000); ++i) {
        const int rate = std::array{20, 60, 240}[dice.below(3)];
        World world = world_of("velocity_verlet", rate, 2, {0, -g}, {{.normal = {0, 1}}});
        const double down = dice.log_uniform(0.2, 5);
        const Vec3 place{dice.uniform(-0.95, 0.95), 0.3};
        world.add_obstacle({.shape = BoxShape{{0, 1.6}, {2, 0.4}},
                            .restitution = dice.uniform(0, 1),
                            .velocity = {0, -down}});
        const Entity ball = world.spawn({.position = place, .contact = Contact{0.3}});
        const int steps = static_cast<int>(3 / down * rate) + 2;
        EXPECT_EQ(count(world, steps, Meeting::crushed), 1) << i;
        EXPECT_NEAR(length(world.position(ball) - place), 0, 1e-14) << i;
    }
}

}  // namespace
}  // namespace oiler::test
