// SPDX-License-Identifier: MIT
// What messages call an entity.
#include "oiler/world/name.hpp"

#include "oiler/world/world.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Two bodies, of which the second diverges.
struct Stiff {
    World world{1, {.method = &find_method("explicit_euler"), .rate = {1}}};
    Entity first = world.spawn({});
    Entity second = world.spawn({.position = {1}}, Spring{.stiffness = 1e9});

    [[nodiscard]] std::string line() {
        return line_of_error(Exit::diverged, [&] { world.step(1000); });
    }
};

TEST(Name, IsWhatADivergenceCallsABody) {
    Stiff unnamed;
    EXPECT_TRUE(holds(unnamed.line(), " x of body 1 is no longer finite; spring of body 1: "));
    Stiff named;
    named.world.add(named.second, Name{"stiff"});
    EXPECT_TRUE(
        holds(named.line(), " x of body 'stiff' is no longer finite; spring of body 'stiff': "));
    Stiff alike;
    for (const Entity entity : {alike.first, alike.second}) alike.world.add(entity, Name{"twin"});
    EXPECT_TRUE(holds(alike.line(), " x of body 'twin 1' is no longer finite; "));
}

TEST(Name, IsWhatAWarningCallsABody) {
    Stiff named;
    named.world.add(named.second, Name{"{} stiff"});
    const std::vector<std::string> lines = named.world.preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("spring of body '{} stiff': ")) << lines[0];
    World linked(1, {.rate = {1}});
    const Entity a = linked.spawn({});
    const Entity b = linked.spawn({.position = {1}});
    linked.link(a, b, {.stiffness = 1e9});
    linked.add(b, Name{"bob"});
    const std::string line = linked.preflight().at(0);
    EXPECT_TRUE(line.starts_with("link of bodies 0 and 'bob': ") ||
                line.starts_with("link of bodies 'bob' and 0: "))
        << line;
}

TEST(Name, IsInTheErrorsOfCalls) {
    World world(1);
    const Entity ball = world.spawn({});
    world.add(ball, Name{"ball"});
    EXPECT_TRUE(line_of_error(Exit::diverged, [&] {
                    world.set_velocity(ball, {NAN});
                }).starts_with("set_velocity of entity 'ball' at tick 0: "));
    EXPECT_TRUE(mistake_of([&] {
                    world.add_body(ball, {});
                }).starts_with("add_body of entity 'ball' at tick 0: "));
    world.destroy(ball);
    EXPECT_TRUE(
        mistake_of([&] { world.destroy(ball); }).starts_with("destroy of entity 0 at tick 0: "));
}

TEST(Name, IsNoStateOfThePlay) {
    World world(1);
    const Entity ball = world.spawn({});
    const std::uint64_t hash = world.state_hash();
    world.add(ball, Name{"ball"});
    EXPECT_EQ(world.state_hash(), hash);
    EXPECT_TRUE(world.unhashed().empty());
}

}  // namespace
}  // namespace oiler::test
