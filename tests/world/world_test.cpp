// SPDX-License-Identifier: MIT
#include "oiler/world/world.hpp"

#include <random>

#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Health {
    int points = 0;
};
struct Name {
    std::string text;
};
struct Marked {};

TEST(World, ARefusedBodyLeavesNoEntity) {
    World world(1);
    EXPECT_THROW((void)world.spawn({.mass = 0}), Error);
    EXPECT_EQ(world.entity_count(), 0U);
    EXPECT_EQ(world.bodies().size(), 0U);
}

/// A simple model of the expected content of a world.
struct Model {
    Vec3 position;
    int points;
};

bool agrees(const World& world, Entity entity, const Model& model) {
    return world.alive(entity) && world.has_body(entity) &&
           world.entity_of_row(world.row(entity)) == entity &&
           world.position(entity) == model.position &&
           world.get<Health>(entity).points == model.points;
}

TEST(World, AgreesWithASimpleModelAfterRandomChanges) {
    std::mt19937_64 random(20240229);
    World world(2);
    std::map<std::uint64_t, std::pair<Entity, Model>> model;
    std::vector<Entity> gone;
    for (int i = 0; i < 5000; ++i) {
        const std::uint64_t choice = random() % 100;
        if (choice < 55 || model.empty()) {
            const Model body{{static_cast<double>(i), -1, 0}, i};
            const Entity entity = world.spawn({.position = body.position});
            world.add(entity, Health{i});
            ASSERT_TRUE(model.emplace(entity.id(), std::pair(entity, body)).second);
        } else {
            const auto at =
                std::next(model.begin(), static_cast<std::ptrdiff_t>(random() % model.size()));
            if (choice < 90) {
                world.destroy(at->second.first);
                gone.push_back(at->second.first);
                model.erase(at);
            } else {
                at->second.second.position = {0.5, static_cast<double>(i), 0};
                world.teleport(at->second.first, at->second.second.position);
            }
        }
        ASSERT_EQ(world.entity_count(), model.size());
        ASSERT_EQ(world.bodies().size(), model.size());
        if (i % 50 != 0) continue;
        for (const auto& [id, pair] : model) ASSERT_TRUE(agrees(world, pair.first, pair.second));
    }
    EXPECT_GT(gone.size(), 1000U);
    for (const Entity entity : gone) ASSERT_FALSE(world.alive(entity));
}

/// A swarm with forces, components and some removed entities.
World swarm() {
    World world(2, {.rate = {100}});
    world.set_gravity({0, -9.81, 0});
    std::vector<Entity> entities;
    for (int i = 0; i < 100; ++i) {
        const double place = i;
        entities.push_back(world.spawn({.mass = 1 + place, .position = {place, -place, 0}},
                                       Spring{.stiffness = 10 + place, .damping = 0.1},
                                       LinearDrag{0.1}));
        world.add(entities.back(), Name{std::to_string(i)});
    }
    for (const std::size_t i : {3U, 50U, 99U}) world.destroy(entities[i]);
    return world;
}

TEST(World, ACopyIsASnapshot) {
    World world = swarm();
    const std::uint64_t start = world.state_hash();
    World copy = world;
    EXPECT_EQ(copy.state_hash(), start);
    copy.step(10);
    EXPECT_EQ(world.state_hash(), start);
    EXPECT_EQ(world.tick(), 0);
    EXPECT_NE(copy.state_hash(), start);
    world.step(10);
    EXPECT_EQ(world.state_hash(), copy.state_hash());
    const World snapshot = world;
    world.step(5);
    world = snapshot;
    EXPECT_EQ(world.state_hash(), copy.state_hash());
    EXPECT_EQ(world.tick(), 10);
}

TEST(World, ACopyHasItsOwnComponentsAndEntities) {
    World world(1);
    world.destroy(world.create());
    const Entity entity = world.create();
    world.destroy(world.create());
    world.add(entity, Name{"original"});
    World copy = world;
    EXPECT_EQ(copy.entity_count(), 1U);
    copy.get<Name>(entity).text = "copy";
    const Entity later = copy.create();
    EXPECT_EQ(world.get<Name>(entity).text, "original");
    EXPECT_FALSE(world.alive(later));
    copy.destroy(entity);
    EXPECT_TRUE(world.alive(entity));
    // Both continue with equal handles.
    EXPECT_EQ(world.create(), later);
}

TEST(World, ManyStepsPerCallEqualSingleSteps) {
    World one_call = swarm();
    World one_by_one = one_call;
    one_call.step(25);
    for (int i = 0; i < 25; ++i) one_by_one.step();
    EXPECT_EQ(one_call.state_hash(), one_by_one.state_hash());
    EXPECT_EQ(one_call.tick(), 25);
}

TEST(World, StepsWithItsSettings) {
    World world(
        1, {.method = &find_method("explicit_euler"), .rate = {1}, .precision = Precision::single});
    const Entity entity =
        world.spawn({.position = {1, 0, 0}, .velocity = {2, 0, 0}}, Spring{.stiffness = 4});
    world.step();
    EXPECT_EQ(world.position(entity), (Vec3{3, 0, 0}));
    EXPECT_EQ(world.velocity(entity), (Vec3{-2, 0, 0}));
    EXPECT_EQ(world.bodies().precision(), Precision::single);
}

TEST(World, TimeComesFromTheTick) {
    World world(1, {.rate = {10}});
    double accumulated = 0;
    for (int i = 1; i <= 1000; ++i) {
        world.step();
        accumulated += 0.1;
        ASSERT_EQ(world.time(), i / 10.0);
    }
    EXPECT_NE(accumulated, 100.0);
    World thirds(1, {.rate = {1, 3}});
    thirds.step(5);
    EXPECT_EQ(thirds.time(), 15);
}

TEST(World, TeleportsMoveABodyAndAreCounted) {
    World world(2);
    const Entity entity = world.spawn({.velocity = {1, 2, 0}});
    const Entity other = world.spawn({});
    EXPECT_EQ(world.jumps(entity), 0U);
    world.teleport(entity, {5, 6, 0});
    EXPECT_EQ(world.position(entity), (Vec3{5, 6, 0}));
    EXPECT_EQ(world.velocity(entity), (Vec3{1, 2, 0}));
    EXPECT_EQ(world.jumps(entity), 1U);
    world.teleport(entity, {7, 8, 0});
    EXPECT_EQ(world.jumps(entity), 2U);
    EXPECT_EQ(world.jumps(other), 0U);
    world.step();
    EXPECT_EQ(world.jumps(entity), 2U);
}

TEST(World, ForcesAreAttachedToTheRightBody) {
    World world(1, {.rate = {1}});
    const Entity first = world.spawn({.position = {1, 0, 0}});
    const Entity second = world.spawn({.position = {1, 0, 0}});
    world.destroy(first);
    const Entity third = world.spawn({.position = {1, 0, 0}});
    world.attach(second, Spring{.stiffness = 4});
    world.step();
    EXPECT_EQ(world.velocity(second), (Vec3{-4, 0, 0}));
    EXPECT_EQ(world.velocity(third), (Vec3{}));
}

TEST(StateHash, DependsOnEveryBitOfAVelocity) {
    World world = swarm();
    const std::uint64_t hash = world.state_hash();
    const Entity entity = world.entity_of_row(96);
    const Vec3 velocity = world.velocity(entity);
    world.set_velocity(entity, {velocity[0], std::nextafter(velocity[1], 1.0), 0});
    EXPECT_NE(world.state_hash(), hash);
    world.set_velocity(entity, velocity);
    EXPECT_EQ(world.state_hash(), hash);
    world.set_velocity(entity, {-0.0, velocity[1], 0});
    ASSERT_EQ(world.velocity(entity), velocity);
    EXPECT_NE(world.state_hash(), hash);
}

TEST(StateHash, DependsOnTheTick) {
    World world(1);
    const std::uint64_t hash = world.state_hash();
    world.step();
    EXPECT_NE(world.state_hash(), hash);
}

TEST(StateHash, DependsOnNoForce) {
    World world = swarm();
    const std::uint64_t hash = world.state_hash();
    world.set_gravity({1, 2, 0});
    world.attach(world.entity_of_row(0), Spring{.stiffness = 99});
    EXPECT_EQ(world.state_hash(), hash);
}

/// A component with a hash of its own: the speed, but not the colour.
struct Paint {
    float speed = 0;
    int colour = 0;
    void hash(StateHash& hash) const { hash.add(std::span(&speed, 1)); }
};

TEST(StateHash, DependsOnComponentsThatSayHow) {
    World world(1);
    const Entity entity = world.create();
    std::vector<std::uint64_t> hashes{world.state_hash()};
    const auto expect_change = [&](bool change) {
        EXPECT_EQ(world.state_hash() != hashes.back(), change) << hashes.size();
        hashes.push_back(world.state_hash());
    };
    world.add(entity, Health{3});
    expect_change(true);
    world.get<Health>(entity).points = 4;
    expect_change(true);
    world.add(entity, Paint{.speed = 2});
    expect_change(true);
    world.get<Paint>(entity).speed = 3;
    expect_change(true);
    world.get<Paint>(entity).colour = 3;
    expect_change(false);
    world.add(entity, Name{"x"});
    expect_change(false);
    ASSERT_EQ(world.unhashed().size(), 1U);
    EXPECT_TRUE(holds(world.unhashed()[0], "Name"));
    (void)world.random().next();
    expect_change(true);
    world.schedule(1, Health{3});
    expect_change(true);
    const World copy = world;
    EXPECT_EQ(copy.state_hash(), world.state_hash());
    world.remove<Health>(entity);
    expect_change(true);
}

TEST(World, ADivergingRunThrows) {
    World world(1, {.rate = {1}, .precision = Precision::single});
    world.spawn({.velocity = {1, 0, 0}}, LinearDrag{3});
    const std::string line = line_of_error(Exit::diverged, [&] { world.step(1000); });
    EXPECT_TRUE(holds(line, "step 128 "));
}

// A computed number diverges; a number that was wrong when it was written is wrong usage.
TEST(World, TellsWrongUsageFromDivergence) {
    World world(2, {.rate = {60}});
    const Entity a = world.spawn({});
    const Entity b = world.spawn({});
    const double nan = std::nan("");
    const auto exit_of = [](auto f) {
        try {
            f();
        } catch (const Error& error) {
            return error.exit();
        }
        return Exit::done;
    };
    EXPECT_EQ(exit_of([&] { world.set_position(a, {nan}); }), Exit::diverged);
    EXPECT_EQ(exit_of([&] { world.set_position(a, {0, 0, 1}); }), Exit::usage);
    EXPECT_EQ(exit_of([&] { world.apply_force(a, {0, 0, 1}); }), Exit::usage);
    EXPECT_EQ(exit_of([&] { world.link(a, b, {.stiffness = nan}); }), Exit::diverged);
    EXPECT_EQ(exit_of([&] { world.link(a, b, {.rest_length = -1}); }), Exit::usage);
    EXPECT_EQ(exit_of([&] { world.spawn({.position = {nan}}); }), Exit::usage) << "no step yet";
    world.step();
    EXPECT_EQ(exit_of([&] { world.spawn({.position = {nan}}); }), Exit::diverged);
    EXPECT_EQ(exit_of([&] { World(2, {.rate = {0}}); }), Exit::usage);
    EXPECT_EQ(exit_of([&] { World(2, {.rate = {60, 0}}); }), Exit::usage);
}

TEST(World, TryStepReturnsTheDivergence) {
    World world(1, {.rate = {1}, .precision = Precision::single});
    world.spawn({.velocity = {1, 0, 0}}, LinearDrag{3});
    EXPECT_FALSE(world.try_step(100));
    EXPECT_EQ(world.tick(), 100);
    const auto where = world.try_step(900);
    ASSERT_TRUE(where);
    EXPECT_EQ(where->tick, 128);
    EXPECT_EQ(where->row, 0U);
    EXPECT_EQ(world.tick(), 127);
}

// Checked in every build, because continuing would change the entity that uses the slot now.
TEST(World, MistakesNameCallEntityAndTickAndChangeNothing) {
    World world(2);
    const Entity first = world.spawn({});
    const Entity gone = world.spawn({});
    world.destroy(gone);
    const Entity now = world.spawn({});
    world.add(now, Health{});
    world.step(3);
    ASSERT_EQ(gone.index, now.index);
    ASSERT_NE(gone.index, first.index);
    const std::uint64_t hash = world.state_hash();
    const auto line = [](const char* call, const char* what) {
        return std::string(call) + " of entity 1 at tick 3: " + what;
    };
    constexpr const char* no_body = "it has no body, or is gone";
    constexpr const char* no_component = "it has no component of this type, or is gone";
    EXPECT_EQ(mistake_of([&] { (void)world.position(gone); }), line("the body", no_body));
    EXPECT_EQ(mistake_of([&] { world.set_velocity(gone, {1}); }), line("set_velocity", no_body));
    EXPECT_EQ(mistake_of([&] { world.teleport(gone, {1}); }), line("teleport", no_body));
    EXPECT_EQ(mistake_of([&] { world.destroy(gone); }), line("destroy", "it is gone"));
    EXPECT_EQ(mistake_of([&] { world.add(gone, Name{}); }), line("add", "it is gone"));
    EXPECT_EQ(mistake_of([&] { world.add_body(gone, {}); }), line("add_body", "it is gone"));
    EXPECT_EQ(mistake_of([&] { (void)world.get<Health>(gone); }), line("get", no_component));
    EXPECT_EQ(mistake_of([&] { world.remove<Health>(gone); }), line("remove", no_component));
    EXPECT_EQ(mistake_of([&] { world.add(now, Health{}); }),
              line("add", "it has a component of this type already"));
    EXPECT_EQ(mistake_of([&] { world.add_body(now, {}); }),
              line("add_body", "it has a body already"));
    EXPECT_TRUE(
        holds(mistake_of([&] { (void)world.bodies().position(2); }), "no body in this row"));
    EXPECT_TRUE(holds(mistake_of([] { World(4); }), "1, 2 or 3 axes"));
    EXPECT_TRUE(holds(mistake_of([&] { (void)world.random().below(0); }), "give 1 or more"));
    EXPECT_EQ(world.state_hash(), hash);
}

TEST(World, ADivergenceNamesTheEntityAsTheTraceDoes) {
    World world(1, {.method = &find_method("explicit_euler"), .rate = {1}});
    const Entity first = world.spawn({});
    (void)world.spawn({});
    const Entity last = world.spawn({.position = {1e300}}, Spring{.stiffness = 1e9});
    world.destroy(first);
    ASSERT_EQ(world.row(last), 0U);
    EXPECT_TRUE(holds(line_of_error(Exit::diverged, [&] { world.step(100); }), "body 2"));
}

// v' = −2·v overflows where 2^(n − 1) m/s does.
TEST(World, HasTheTickBeforeADivergenceHoweverItIsStepped) {
    for (const std::int64_t per_call : {1, 7, 5000}) {
        World world(1, {.stepping = {.method = &find_method("explicit_euler"), .rate = {1}}});
        world.spawn(Body{.velocity = {0.5}}, LinearDrag{3});
        EXPECT_THROW(while (world.tick() < 5000) world.step(per_call), Error);
        EXPECT_EQ(world.tick(), std::numeric_limits<double>::max_exponent) << per_call;
    }
}

}  // namespace
}  // namespace oiler::test
