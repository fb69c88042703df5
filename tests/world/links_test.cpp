// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Link stiff{.stiffness = 300, .damping = 0.5, .rest_length = 1};

struct Chain {
    World world{2, {.method = &find_method("velocity_verlet"), .rate = Rate{100}}};
    Entity first = world.spawn(Body{.position = {0, 0, 0}});
    Entity second = world.spawn(Body{.position = {1.5, 0, 0}});
    Entity third = world.spawn(Body{.position = {3, 0.5, 0}});

    Chain() {
        world.link(first, second, stiff);
        world.link(second, third, stiff);
    }
};

TEST(WorldLinks, PullTheirBodiesTogether) {
    Chain chain;
    chain.world.step(5);
    EXPECT_GT(chain.world.velocity(chain.first)[0], 0);
    EXPECT_LT(chain.world.velocity(chain.third)[0], 0);
}

TEST(WorldLinks, AreRemovedWithTheirEntities) {
    Chain chain;
    chain.world.destroy(chain.first);
    EXPECT_EQ(chain.world.bodies().link_count(), 1U);
    chain.world.step(5);
    EXPECT_LT(chain.world.velocity(chain.third)[0], 0);
    chain.world.remove_body(chain.second);
    EXPECT_EQ(chain.world.bodies().link_count(), 0U);
    const Vec3 velocity = chain.world.velocity(chain.third);
    chain.world.step(5);
    EXPECT_EQ(chain.world.velocity(chain.third), velocity);
}

TEST(WorldLinks, AreCopiedWithTheirWorld) {
    Chain chain;
    chain.world.step(7);
    World copy = chain.world;
    copy.step(20);
    chain.world.step(20);
    EXPECT_EQ(copy.state_hash(), chain.world.state_hash());
}

TEST(WorldLinks, ToPointsAreRemovedWithTheirEntities) {
    Chain chain;
    const LinkHandle pin = chain.world.link_to_point(chain.first, {0, 1}, stiff);
    const LinkHandle other = chain.world.link_to_point(chain.third, {3, 2}, stiff);
    const World copy = chain.world;
    chain.world.destroy(chain.first);
    EXPECT_FALSE(chain.world.alive(pin));
    EXPECT_TRUE(chain.world.alive(other));
    EXPECT_TRUE(copy.alive(pin));
    EXPECT_EQ(chain.world.bodies().link_count(), 2U);
    chain.world.unlink(other);
    EXPECT_EQ(chain.world.bodies().link_count(), 1U);
}

// A step after a teleport must not use the acceleration from before it.
TEST(WorldLinks, ReactToATeleportInTheNextStep) {
    Chain chain;
    chain.world.step(1);
    chain.world.teleport(chain.first, {1.5, 0, 0});
    chain.world.teleport(chain.second, {2.5, 0, 0});
    chain.world.teleport(chain.third, {3.5, 0, 0});
    const Vec3 before = chain.world.velocity(chain.first);
    chain.world.step(1);
    // At rest lengths only the relative velocities of the first step pull, by less than 0.1 m/s².
    EXPECT_NEAR(chain.world.velocity(chain.first)[0], before[0], 0.1);
}

// Bodies are named by their entities, also after rows have moved.
TEST(Preflight, NamesEntities) {
    World world(1, {.rate = Rate{60}});
    const Entity gone = world.spawn(Body{});
    world.spawn(Body{});
    const Entity stiffest = world.spawn(Body{}, Spring{.stiffness = 144.0 * 144});
    world.destroy(gone);
    ASSERT_EQ(world.row(stiffest), 0U);
    const auto lines = world.preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "spring of body 2: ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 73 Hz, or "
              "implicit_midpoint");
}

TEST(Preflight, CountsTheBodiesThatItDoesNotName) {
    World world(1, {.rate = Rate{10}});
    for (int i = 0; i < 9; ++i) world.spawn(Body{}, Spring{.stiffness = 1000.0 + i});
    const auto lines = world.preflight(2);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_TRUE(lines[0].starts_with("spring of body 8:")) << lines[0];
    EXPECT_EQ(lines[2], "and 7 more");
}

// The last row moves to the place of each removed row: entities 3 and 2 stay, in rows 0 and 1.
// ω² = 10368·(1 + 1) = 144² s⁻².
TEST(Preflight, NamesBothEndsOfALinkByTheirEntities) {
    World world(1, {.rate = Rate{60}});
    const Entity gone = world.spawn(Body{});
    const Entity gone_too = world.spawn(Body{});
    const Entity second_end = world.spawn(Body{});
    const Entity first_end = world.spawn(Body{.position = {1}});
    world.link(first_end, second_end, {.stiffness = 10368});
    world.destroy(gone);
    world.destroy(gone_too);
    ASSERT_EQ(world.row(first_end), 0U);
    ASSERT_EQ(world.row(second_end), 1U);
    const auto lines = world.preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("link of bodies 3 and 2: ω·dt up to 2.4, ")) << lines[0];
}

TEST(Preflight, CountsNoneIfAllAreNamed) {
    World world(1, {.rate = Rate{10}});
    for (int i = 0; i < 5; ++i) world.spawn(Body{}, Spring{.stiffness = 1000.0 + i});
    EXPECT_EQ(world.preflight(5).size(), 5U);
    EXPECT_EQ(world.preflight(6).size(), 5U);
    EXPECT_EQ(world.preflight().size(), 5U);
    for (const std::string& line : world.preflight(5))
        EXPECT_TRUE(line.starts_with("spring of body ")) << line;
    EXPECT_EQ(world.preflight(4).back(), "and 1 more");
}

TEST(Preflight, DependsOnTheDampingOfTheSetting) {
    const auto warnings = [](Damping damping) {
        World world(1, {.rate = Rate{10}, .damping = damping});
        world.spawn(Body{}, Spring{.stiffness = 100, .damping = 18});
        return world.preflight().size();
    };
    // ω·dt = 1 and ζ = 0.9: h² + 4ζh = 4.6 > 4 in the kicks.
    EXPECT_EQ(warnings(Damping::in_kick), 1U);
    EXPECT_EQ(warnings(Damping::in_drift), 0U);
}

TEST(WorldMethods, ThatCannotStepTheBodiesAreRefusedBeforeAnyStep) {
    Chain chain;
    World world = chain.world;
    EXPECT_NO_THROW(world.require_applicable());
    World exact(2, {.method = &find_method("exact")});
    const Entity a = exact.spawn(Body{});
    const Entity b = exact.spawn(Body{.position = {1, 0, 0}});
    EXPECT_NO_THROW(exact.require_applicable());
    exact.link(a, b, stiff);
    EXPECT_THROW(exact.require_applicable(), Error);
    EXPECT_EQ(exact.tick(), 0);
}

}  // namespace
}  // namespace oiler::test
