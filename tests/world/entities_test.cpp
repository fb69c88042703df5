// SPDX-License-Identifier: MIT
// Entities, their components, and visits of them. How visits create and destroy is in
// visits_test.cpp.
#include <random>

#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"
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

TEST(Entities, LiveUntilDestroyed) {
    World world(1);
    const Entity first = world.create();
    const Entity second = world.create();
    EXPECT_NE(first, second);
    EXPECT_EQ(world.entity_count(), 2U);
    world.destroy(first);
    EXPECT_FALSE(world.alive(first));
    EXPECT_TRUE(world.alive(second));
    EXPECT_EQ(world.entity_count(), 1U);
}

TEST(Entities, NoneIsAliveByDefault) {
    const World world(1);
    EXPECT_FALSE(world.alive(Entity{}));
    EXPECT_FALSE(world.has_body(Entity{}));
    EXPECT_EQ(world.find<Health>(Entity{}), nullptr);
    EXPECT_EQ(world.jumps(Entity{}), 0U);
}

TEST(Entities, StaleHandlesAreRecognisedAlsoWhenTheSlotIsUsedAgain) {
    World world(1);
    const Entity old = world.spawn({});
    world.add(old, Health{3});
    world.destroy(old);
    EXPECT_EQ(world.find<Health>(old), nullptr);
    const Entity next = world.spawn({});
    world.add(next, Health{5});
    ASSERT_EQ(next.index, old.index);
    EXPECT_NE(next, old);
    EXPECT_NE(next.id(), old.id());
    EXPECT_FALSE(world.alive(old));
    EXPECT_EQ(world.find<Health>(old), nullptr);
    EXPECT_FALSE(world.has_body(old));
    EXPECT_EQ(world.jumps(old), 0U);
    EXPECT_EQ(world.get<Health>(next).points, 5);
}

TEST(Entities, HaveIdsThatAreNeverZero) {
    World world(1);
    EXPECT_NE(world.create().id(), 0U);
}

TEST(Entities, DoNotInheritComponentsOfTheirSlot) {
    World world(1);
    const Entity old = world.spawn({});
    world.add(old, Health{3});
    world.teleport(old, {1, 0, 0});
    world.destroy(old);
    const Entity next = world.create();
    EXPECT_EQ(world.find<Health>(next), nullptr);
    EXPECT_FALSE(world.has_body(next));
    EXPECT_EQ(world.jumps(next), 0U);
}

TEST(Components, AreAddedFoundAndRemoved) {
    World world(1);
    const Entity entity = world.create();
    EXPECT_EQ(world.find<Health>(entity), nullptr);
    world.add(entity, Health{3}).points += 1;
    world.add(entity, Name{"a name that is too long for the small-string buffer"});
    EXPECT_EQ(world.get<Health>(entity).points, 4);
    world.remove<Health>(entity);
    EXPECT_EQ(world.find<Health>(entity), nullptr);
    EXPECT_EQ(std::as_const(world).get<Name>(entity).text.size(), 51U);
}

TEST(Components, StayWithTheirEntityWhenOthersLeave) {
    World world(1);
    std::vector<Entity> entities;
    for (int i = 0; i < 10; ++i) {
        entities.push_back(world.create());
        world.add(entities.back(), Name{"the name of entity number " + std::to_string(i)});
    }
    world.remove<Name>(entities[2]);
    world.destroy(entities[9]);
    world.destroy(entities[0]);
    for (const std::size_t i : {1U, 3U, 4U, 5U, 6U, 7U, 8U})
        EXPECT_EQ(world.get<Name>(entities[i]).text,
                  "the name of entity number " + std::to_string(i));
}

TEST(Components, MayBeMoveOnly) {
    World world(1);
    const Entity first = world.create();
    const Entity second = world.create();
    world.add(first, std::make_unique<int>(1));
    world.add(second, std::make_unique<int>(2));
    world.remove<std::unique_ptr<int>>(first);
    EXPECT_EQ(*world.get<std::unique_ptr<int>>(second), 2);
    World moved = std::move(world);
    EXPECT_EQ(*moved.get<std::unique_ptr<int>>(second), 2);
    EXPECT_THROW(World{moved}, std::logic_error);
}

// Counts the moves of components. A search or a shift would make many.
struct Counted {
    static inline int moves = 0;
    Counted() = default;
    Counted(Counted&&) noexcept { ++moves; }
    Counted& operator=(Counted&&) noexcept {
        ++moves;
        return *this;
    }
};

TEST(Components, LeaveWithoutMovingMoreThanOneOther) {
    World world(1);
    std::vector<Entity> entities;
    for (int i = 0; i < 1000; ++i) {
        entities.push_back(world.create());
        world.add(entities.back(), Counted{});
    }
    for (const Entity entity : entities) {
        Counted::moves = 0;
        world.remove<Counted>(entity);
        EXPECT_LE(Counted::moves, 1);
    }
}

/// The indices of the entities in the order of `each<First, Rest...>`.
template <class First, class... Rest>
std::vector<std::uint32_t> order(World& world) {
    std::vector<std::uint32_t> indices;
    world.each<First, Rest...>(
        [&](Entity entity, First&, Rest&...) { indices.push_back(entity.index); });
    return indices;
}

TEST(Each, VisitsInTheOrderOfAddingWithTheLastInTheHole) {
    World world(1);
    std::vector<Entity> entities;
    for (int i = 0; i < 6; ++i) entities.push_back(world.create());
    for (const std::size_t i : {3U, 1U, 5U, 0U, 4U}) world.add(entities[i], Health{});
    EXPECT_EQ(order<Health>(world), (std::vector<std::uint32_t>{3, 1, 5, 0, 4}));
    world.remove<Health>(entities[1]);
    EXPECT_EQ(order<Health>(world), (std::vector<std::uint32_t>{3, 4, 5, 0}));
    world.remove<Health>(entities[0]);
    world.add(entities[2], Health{});
    EXPECT_EQ(order<Health>(world), (std::vector<std::uint32_t>{3, 4, 5, 2}));
}

TEST(Each, VisitsEntitiesWithAllComponents) {
    World world(1);
    std::vector<Entity> entities;
    for (int i = 0; i < 30; ++i) {
        entities.push_back(world.create());
        if (i % 2 == 0) world.add(entities.back(), Health{i});
    }
    for (int i = 29; i >= 0; --i)
        if (i % 3 == 0) world.add(entities[static_cast<std::size_t>(i)], Name{std::to_string(i)});
    EXPECT_EQ((order<Health, Name>(world)), (std::vector<std::uint32_t>{0, 6, 12, 18, 24}));
    EXPECT_EQ((order<Name, Health>(world)), (std::vector<std::uint32_t>{24, 18, 12, 6, 0}));
    EXPECT_TRUE((order<Health, Marked>(world)).empty());
    std::as_const(world).each<Health, Name>([](Entity, const Health& health, const Name& name) {
        EXPECT_EQ(std::to_string(health.points), name.text);
    });
}

/// Adds and removes Health in a fixed sequence. With `noise`, other components and bodies are added
/// and removed in between, and their pools are created first.
World with_history(bool noise) {
    World world(1);
    std::mt19937_64 random(7);
    std::vector<Entity> entities;
    for (int i = 0; i < 50; ++i) entities.push_back(world.create());
    if (noise)
        for (int i = 49; i > 0; i -= 2) world.add(entities[static_cast<std::size_t>(i)], Name{"x"});
    for (int i = 0; i < 500; ++i) {
        const Entity entity = entities[random() % entities.size()];
        if (world.find<Health>(entity))
            world.remove<Health>(entity);
        else
            world.add(entity, Health{i});
        if (!noise) continue;
        const Entity other = entities[static_cast<std::size_t>(i * 7 % 50)];
        if (world.find<Name>(other)) world.remove<Name>(other);
        if (world.has_body(other))
            world.remove_body(other);
        else
            world.add_body(other, {});
    }
    return world;
}

TEST(Each, HasAnOrderThatDependsOnTheAddsAndRemovesOfItsTypeAlone) {
    World quiet = with_history(false);
    World noisy = with_history(true);
    EXPECT_GT(order<Health>(quiet).size(), 10U);
    EXPECT_EQ(order<Health>(quiet), order<Health>(noisy));
}

TEST(Each, MayDestroyTheVisitedEntity) {
    for (const int keep : {0, 1, 2, 3}) {
        World world(1);
        for (int i = 0; i < 20; ++i) world.add(world.spawn({}), Health{i});
        std::map<int, int> visits;
        world.each<Health>([&](Entity entity, Health& health) {
            ++visits[health.points];
            if (keep == 0 || health.points % keep != 0) world.destroy(entity);
        });
        EXPECT_EQ(visits.size(), 20U);
        for (const auto& [points, count] : visits) EXPECT_EQ(count, 1) << points;
        const std::size_t left = keep == 0 ? 0 : static_cast<std::size_t>((20 + keep - 1) / keep);
        EXPECT_EQ(world.entity_count(), left);
        EXPECT_EQ(world.bodies().size(), left);
    }
}

TEST(Each, MayCreateOthersAndDoesNotVisitThem) {
    World world(1);
    for (int i = 0; i < 20; ++i) world.add(world.create(), Health{i});
    std::map<int, int> visits;
    world.each<Health>([&](Entity entity, const Health& health) {
        const int points = health.points;
        ++visits[points];
        world.add(world.create(), Health{100 + points});
        if (points % 2 == 0) world.destroy(entity);
        if (points % 3 == 0) world.add(world.create(), Health{200 + points});
    });
    EXPECT_EQ(visits.size(), 20U);
    for (const auto& [points, count] : visits) EXPECT_TRUE(points < 20 && count == 1) << points;
}

TEST(Entities, AreNumberedInTheOrderOfTheirCreation) {
    World world(1);
    const Entity first = world.create(), second = world.create();
    EXPECT_EQ(world.number(first), first.id()) << "not yet numbered";
    world.number_entities();
    EXPECT_EQ(world.number(first), 0U);
    EXPECT_EQ(world.number(second), 1U);
    world.destroy(first);
    world.destroy(second);
    World copy = world;
    for (World* const one : {&world, &copy}) {
        const Entity third = one->create(), fourth = one->create();
        EXPECT_EQ(third.index, second.index) << "the slot that was freed last";
        EXPECT_EQ(one->number(third), 2U);
        EXPECT_EQ(one->number(fourth), 3U);
        one->number_entities();
        EXPECT_EQ(one->number(fourth), 3U) << "a second time changes nothing";
    }
}

}  // namespace
}  // namespace oiler::test
