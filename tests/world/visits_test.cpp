// SPDX-License-Identifier: MIT
// Creating and destroying while entities are visited; timers and random numbers of a world.
#include <random>

#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Health {
    int points = 0;
};
struct Shield {
    int strength = 0;
};

/// Entities with Health 0, 1, 2, …, bodies at x = points, and a Shield on the even ones.
World crowd(int count) {
    World world(1);
    for (int i = 0; i < count; ++i) {
        const Entity entity = world.spawn({.position = {static_cast<double>(i)}});
        world.add(entity, Health{i});
        if (i % 2 == 0) world.add(entity, Shield{i});
    }
    return world;
}
std::vector<Entity> entities_of(World& world) {
    std::vector<Entity> entities;
    world.each<Health>([&](Entity entity, Health&) { entities.push_back(entity); });
    return entities;
}
/// What must hold after any visit: each row is that of a living entity, and each body is where its
/// entity's Health says.
void expect_sound(World& world) {
    for (std::size_t row = 0; row < world.bodies().size(); ++row)
        EXPECT_EQ(world.row(world.entity_of_row(row)), row);
    world.each<Health>([&](Entity entity, const Health& health) {
        if (!world.has_body(entity)) return;
        EXPECT_EQ(world.position(entity)[0], health.points);
    });
}

TEST(Visits, MayDestroyAnyEntity) {
    for (const int target : {-1, 0, 1, 99}) {  // the one before, itself, the next, all
        World world = crowd(20);
        const std::vector<Entity> entities = entities_of(world);
        std::vector<int> visited;
        world.each<Health>([&](Entity, const Health& health) {
            visited.push_back(health.points);
            if (health.points != 7) return;
            for (int i = 0; i < 20; ++i)
                if (target == 99 || i == 7 + target)
                    world.destroy(entities[static_cast<std::size_t>(i)]);
            EXPECT_EQ(health.points, 7) << "references stay valid";
        });
        std::vector<int> expected;
        for (int i = 0; i < 20; ++i)
            if (i <= 7 || (target != 99 && i != 7 + target)) expected.push_back(i);
        EXPECT_EQ(visited, expected) << target;
        EXPECT_EQ(world.entity_count(), target == 99 ? 0U : 19U);
        expect_sound(world);
    }
}

TEST(Visits, AreCounted) {
    World world = crowd(9);
    EXPECT_EQ(world.count<Health>(), 9U);
    EXPECT_EQ((world.count<Health, Shield>()), 5U);
    EXPECT_EQ(world.count<int>(), 0U) << "no entity ever had one";
    world.each<Health>([&](Entity entity, const Health& health) {
        if (health.points == 4) world.destroy(entity);
        const std::size_t left = health.points < 4 ? 9 : 8;
        EXPECT_EQ(world.count<Health>(), left) << "what is destroyed is gone at once";
    });
    EXPECT_EQ((world.count<Shield, Health>()), 4U);
}

TEST(Visits, DestroyAtOnce) {
    World world = crowd(3);
    const Entity last = entities_of(world)[2];
    world.each<Health>([&](Entity entity, const Health& health) {
        if (health.points != 0) return;
        world.destroy(last);
        EXPECT_FALSE(world.alive(last));
        EXPECT_FALSE(world.find<Health>(last));
        EXPECT_EQ(world.within({2}, 0.1).size(), 0U);
        world.remove<Shield>(entity);
        EXPECT_FALSE(world.find<Shield>(entity));
        world.add(entity, Shield{5});
        EXPECT_EQ(world.get<Shield>(entity).strength, 5);
        const Entity fresh = world.spawn({.position = {3}});
        world.add(fresh, Health{3});
        EXPECT_EQ(world.position(fresh)[0], 3);
    });
    EXPECT_EQ(entities_of(world).size(), 3U);
    expect_sound(world);
}

TEST(Visits, MayThrow) {
    World world = crowd(10);
    EXPECT_THROW(world.each<Health>([&](Entity entity, const Health& health) {
        world.destroy(entity);
        if (health.points == 4) throw std::runtime_error("enough");
    }),
                 std::runtime_error);
    EXPECT_EQ(world.bodies().size(), 5U);
    expect_sound(world);
    world.step();
}

// Each entity is visited once, in the order before the visit, if it still has its component by
// then, whatever is done meanwhile; also by visits within visits.
TEST(Visits, AgreeWithAListAfterRandomChanges) {
    std::mt19937 random(1);
    for (int run = 0; run < 3000; ++run) {
        World world = crowd(static_cast<int>(random() % 12));
        int next = 1000;
        for (int visit = 0; visit < 3; ++visit) {
            std::vector<Entity> waiting = entities_of(world);
            std::set<std::uint64_t> gone;
            const auto change_something = [&] {
                if (waiting.empty()) return;
                const Entity any = waiting[random() % waiting.size()];
                const unsigned what = random() % 5;
                if (what == 0 && world.alive(any)) {
                    world.destroy(any);
                    gone.insert(any.id());
                } else if (what == 1 && world.find<Health>(any)) {
                    world.remove<Health>(any);
                    gone.insert(any.id());
                } else if (what == 2) {
                    const Entity fresh = world.spawn({.position = {double(next)}});
                    world.add(fresh, Health{next++});
                } else if (what == 3 && world.has_body(any)) {
                    world.remove_body(any);
                }
            };
            std::size_t place = 0;
            world.each<Health>([&](Entity entity, const Health&) {
                while (place < waiting.size() && gone.contains(waiting[place].id())) ++place;
                ASSERT_LT(place, waiting.size());
                ASSERT_EQ(entity, waiting[place++]) << "run " << run;
                change_something();
                if (random() % 4 == 0)
                    world.each<Health>([&](Entity, const Health&) {
                        if (random() % 3 == 0) change_something();
                    });
            });
            while (place < waiting.size() && gone.contains(waiting[place].id())) ++place;
            ASSERT_EQ(place, waiting.size());
            ASSERT_NO_FATAL_FAILURE(expect_sound(world)) << "run " << run;
        }
    }
}

TEST(Visits, OfBodiesMoveThem) {
    World world = crowd(4);
    world.add(world.create(), Health{9});
    int visits = 0;
    world.each_body<Health>([&](Entity, const Moving& moving, const Health& health) {
        ++visits;
        EXPECT_EQ(moving.position()[0], health.points);
        moving.set_velocity({2});
        moving.apply_impulse({1});
        EXPECT_EQ(moving.velocity()[0], 2 + 1 / moving.mass());
    });
    EXPECT_EQ(visits, 4);
}

TEST(Visits, NeitherCopyNorReplaceNorStepTheirWorld) {
    World world = crowd(2);
    const auto mistake = [&](auto f) {
        return mistake_of([&] { world.each<Health>([&](Entity, Health&) { f(); }); });
    };
    EXPECT_EQ(mistake([&] { world = World(1); }),
              "a world is not replaced inside its own each; restart after it, or with "
              "Loop::restart");
    EXPECT_EQ(mistake([&] { (void)World(world); }), "a world is not copied inside its own each");
    EXPECT_EQ(mistake([&] { world.step(); }), "a world is not stepped inside its own each");
    world.step();
    EXPECT_EQ(world.tick(), 1) << "the visits have ended";
}

TEST(Timers, AreDueAfterTheirTimeRoundedUpToATick) {
    World world(1, {.rate = {10}});
    world.schedule(0.7, Health{7});
    world.schedule(0.21, Health{3});
    world.schedule(0.25, Health{4});
    world.schedule(0, Health{0});
    world.schedule(0.7, Shield{1});
    std::vector<int> due;
    for (int tick = 0; tick <= 10; ++tick) {
        world.due<Health>([&](const Health& health) {
            due.push_back(health.points);
            const int expected[] = {0, -1, -1, 3, -1, -1, -1, 7};
            if (health.points != 4) {
                EXPECT_EQ(expected[tick], health.points);
            }
        });
        world.step();
    }
    EXPECT_EQ(due, (std::vector<int>{0, 3, 4, 7}));
}

// 0.14·50 is 7.000000000000001 in double.
TEST(Timers, AreNotLateByRoundOff) {
    World world(1, {.rate = {50}});
    world.schedule(0.14, Health{1});
    world.step(7);
    int due = 0;
    world.due<Health>([&](const Health&) { ++due; });
    EXPECT_EQ(due, 1);
}

TEST(Timers, AreCopiedAndMayBeSetAgainWhenDue) {
    World world(1, {.rate = {10}});
    world.schedule(0.1, Health{1});
    world.step();
    World copy = world;
    const auto count = [](World& of) {
        int due = 0;
        of.due<Health>([&](Health&) {
            ++due;
            of.schedule(0, Health{2});
        });
        return due;
    };
    EXPECT_EQ(count(world), 1);
    EXPECT_EQ(count(copy), 1);
    EXPECT_EQ(count(world), 1) << "the new one";
}

/// How often a message that schedules itself each 0.08 s comes in [0 s, 8 s], and its largest
/// delay.
std::pair<int, double> beats_in_8_s(Rate rate) {
    World world(1, {.rate = rate});
    world.schedule(0, Health{0});
    int count = 0;
    double late = 0;
    for (; world.time() <= 8; world.step())
        world.due<Health>([&](const Health&) {
            late = std::max(late, world.time() - 0.08 * count++);
            world.schedule(0.08, Health{});
        });
    return {count, late};
}

// 8 s are 100 times 0.08 s: 101 beats. At 5 Hz several are due at one tick.
TEST(Timers, ThatRepeatComeAsOftenAtAnyRate) {
    for (const int rate : {5, 20, 50, 60, 100, 144, 240, 1000}) {
        const auto [count, late] = beats_in_8_s({rate});
        EXPECT_EQ(count, 101) << rate;
        EXPECT_LT(late, 1.0 / rate) << rate;
    }
}

// Two messages repeat, several times per tick: all come in the tick that they are due at, in the
// order of their times.
TEST(Timers, ThatRepeatComeInTheirOrder) {
    World world(1, {.rate = {30}});
    const double every[] = {0.007, 0.011};
    double next[] = {0, 0};
    for (const int i : {0, 1}) world.schedule(0, Health{i});
    double last = 0;
    for (; world.time() <= 1; world.step())
        world.due<Health>([&](const Health& health) {
            double& time = next[health.points];
            EXPECT_GE(time, last - 1e-12);
            EXPECT_LT(world.time() - time, 1 / 30.0);
            last = time;
            time += every[health.points];
            world.schedule(every[health.points], health);
        });
    for (const int i : {0, 1}) EXPECT_GT(next[i], 1);
}

TEST(Timers, AreNotLostIfOneThrows) {
    World world(1);
    for (const int i : {1, 2, 3}) world.schedule(0, Health{i});
    std::vector<int> heard;
    const auto hear = [&](const Health& health) {
        if (health.points == 1 && heard.empty()) throw std::runtime_error("once");
        heard.push_back(health.points);
    };
    EXPECT_THROW(world.due<Health>(hear), std::runtime_error);
    world.due<Health>(hear);
    EXPECT_EQ(heard, (std::vector<int>{2, 3}));
}

TEST(Timers, RefuseTimesThatAreNone) {
    World world(1);
    for (const double seconds : {-0.1, std::nan(""), HUGE_VAL})
        EXPECT_THROW(world.schedule(seconds, Health{}), Error);
}

TEST(WorldRandom, IsPartOfASnapshotAndFollowsTheSeed) {
    World world(1, Settings{.seed = 5});
    World same(1, Settings{.seed = 5});
    World other(1, Settings{.seed = 6});
    const std::uint64_t first = world.random().next();
    EXPECT_EQ(same.random().next(), first);
    EXPECT_NE(other.random().next(), first);
    World copy = world;
    EXPECT_EQ(copy.random().next(), world.random().next());
    for (int i = 0; i < 1000; ++i) {
        const double x = world.random().uniform(-2, 3);
        EXPECT_TRUE(x >= -2 && x < 3);
        EXPECT_LT(world.random().below(6), 6U);
    }
    EXPECT_FALSE(world.random().chance(0));
    EXPECT_TRUE(world.random().chance(1));
}

}  // namespace
}  // namespace oiler::test
