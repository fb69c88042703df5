// SPDX-License-Identifier: MIT
// Long runs among obstacles: energy over many elastic bounces, and the same bits for any threads
// and steps per call while obstacles are added, moved and removed.
#include "oiler/sim/bodies.hpp"
#include "world/campaigns.hpp"
#include "world/contacts.hpp"

namespace oiler::test {
namespace {

// A bounce changes v² by at most 4 units of round-off, of the length of the normal, and a step by
// some of g·y, of either sign: a drift would be 10⁴ times as large as the root of their number.
TEST(ElasticBounces, KeepTheEnergyAmongPegs) {
    const int bounces = whole(20000, 1000000);
    World world = world_of("velocity_verlet", 60, 2, {0, -g});
    for (const double x : {-1.5, 1.5})
        world.add_obstacle({.shape = BoxShape{{x, 0}, {1, 4}}, .restitution = 1});
    for (const double y : {-1.5, 1.5})
        world.add_obstacle({.shape = BoxShape{{0, y}, {4, 1}}, .restitution = 1});
    for (const Vec3& peg : {Vec3{-0.5, -0.3}, {0.45, 0.1}, {0, -0.7}, {-0.1, 0.5}})
        world.add_obstacle({.shape = CircleShape{peg, 0.1}, .restitution = 1});
    world.spawn({.position = {0.7, 0.7}, .velocity = {11, 3}, .contact = Contact{0.1}});
    const double energy = world.energy().total();
    double largest = 0;
    int met = 0;
    while (met < bounces) {
        world.step();
        met += static_cast<int>(world.impacts().size());
        largest = std::max(largest, std::abs(world.energy().total() / energy - 1));
    }
    const double events = static_cast<double>(met + world.tick());
    EXPECT_LT(largest, 16 * epsilon * std::sqrt(events));
    say("{} bounces, {} steps: energy within {} of itself", met, world.tick(), largest);
}

constexpr int between = 192;  ///< steps between changes: a multiple of 1, 3 and 64

/// A world of balls, some on ropes, and obstacles that change all the time.
struct Changing {
    World world;
    Dice dice;
    std::vector<ObstacleHandle> handles{};
    std::vector<Entity> balls{};

    Changing(std::uint64_t seed, Precision precision, int threads, bool ropes)
        : world(2, {.stepping = {.method = &find_method("velocity_verlet"),
                                 .rate = {240},
                                 .precision = precision},
                    .threads = threads}),
          dice(seed) {
        world.set_gravity({0, -g});
        world.add_plane({.normal = {0, 1}, .offset = -4, .restitution = 0.8, .friction = 0.1});
        for (int i = 0; i < 30; ++i) add();
        for (int i = 0; i < whole(300, 1500); ++i)
            balls.push_back(world.spawn({.position = {dice.uniform(-4, 4), dice.uniform(2, 9)},
                                         .velocity = {dice.uniform(-3, 3), 0},
                                         .contact = Contact{dice.uniform(0.01, 0.1)}}));
        for (std::size_t i = 0; ropes && i < 40; i += 2)
            world.link(balls[i], balls[i + 1],
                       {.stiffness = 50, .damping = 1, .rest_length = 2, .pulls_only = true});
    }
    void add() {
        const Vec3 at{dice.uniform(-4, 4), dice.uniform(-4, 2)};
        Obstacle made{.restitution = dice.uniform(0, 1), .friction = dice.uniform(0, 0.5)};
        const int kind = dice.whole(0, 2);
        if (kind == 0) made.shape = CircleShape{at, dice.uniform(0.1, 0.5)};
        if (kind == 1) made.shape = SegmentShape{at, at + Vec3{dice.uniform(0.2, 1), 0.3}};
        if (kind == 2) made.shape = BoxShape{at, {0.5, 0.4}, dice.uniform(-1, 1)};
        if (dice.chance(0.2)) made.velocity = {dice.uniform(-1, 1), dice.uniform(-1, 1)};
        if (dice.chance(0.2)) made.swing = Swing{{0.3, 0.2}, dice.uniform(0.5, 3)};
        if (dice.chance(0.1)) made.one_way = Vec3{0, 1};
        made.solid = dice.chance(0.9);
        handles.push_back(world.add_obstacle(made));
    }
    void change() {
        for (int i = 0; i < 4; ++i) {
            const std::size_t at = dice.below(handles.size());
            const Vec3 to{dice.uniform(-4, 4), dice.uniform(-4, 2)};
            switch (dice.whole(0, 4)) {
                case 0:
                    add();
                    break;
                case 1:
                    world.move_obstacle(handles[at], to);
                    break;
                case 2:
                    world.teleport_obstacle(handles[at], to);
                    break;
                case 3:
                    world.set_obstacle_velocity(handles[at], to * 0.2);
                    break;
                default:
                    world.remove_obstacle(handles[at]);
                    handles.erase(handles.begin() + static_cast<std::ptrdiff_t>(at));
            }
        }
    }
    void run(int changes, int per_call) {
        for (int i = 0; i < changes; ++i) {
            change();
            for (int k = 0; k < between; k += per_call) world.step(per_call);
        }
    }
};

TEST(ChangingObstacles, GiveTheSameBitsWithAnyThreadsStepsPerCallAndReplays) {
    const int changes = whole(1, 4);
    for (int seed = 0; seed < whole(1, 3); ++seed)
        for (const Precision precision : {Precision::double_, Precision::single})
            for (const bool ropes : {false, true}) {
                if (whole(1, 0) && ropes != (precision == Precision::single)) continue;
                const auto hash_of = [&](int threads, int per_call) {
                    Changing one(static_cast<unsigned>(seed), precision, threads, ropes);
                    one.run(changes, per_call);
                    Changing kept = one;
                    one.run(changes, per_call);
                    const std::uint64_t first = one.world.state_hash();
                    one = kept;
                    one.run(changes, 1);
                    EXPECT_EQ(one.world.state_hash(), first) << seed << ' ' << threads;
                    return first;
                };
                const std::uint64_t first = hash_of(1, 1);
                for (const auto& [threads, per_call] : {std::pair{1, 64}, {3, 3}, {8, 1}})
                    EXPECT_EQ(hash_of(threads, per_call), first)
                        << seed << ' ' << threads << ' ' << per_call;
            }
}

}  // namespace
}  // namespace oiler::test
