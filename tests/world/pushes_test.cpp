// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

const Method& method(const char* name) { return find_method(name); }

/// The position after 1 s of a rocket of mass 2 kg with thrust 6 N and drag 0.8 N·s/m, from
/// x = v = 0: with c = b/m and w = F/b, x = w·(t − (1 − e^(−c·t))/c).
const double rocket_position = 6 / 0.8 * (1 - (1 - std::exp(-0.4)) / 0.4);

double rocket_error(const Method& by, int rate) {
    World world(1, {.method = &by, .rate = {rate}});
    const Entity rocket = world.spawn({.mass = 2}, LinearDrag{0.8});
    for (int i = 0; i < rate; ++i) {
        world.apply_force(rocket, {2});
        world.apply_force(rocket, {4});
        world.step();
    }
    return std::abs(world.position(rocket)[0] - rocket_position);
}

// A constant thrust is part of the smooth motion, so that half the step divides the error by 2^p.
// The next order changes that by a few percent at dt = 1/20 s.
TEST(Pushes, OfARocketKeepTheOrderOfTheMethod) {
    for (const auto& [name, order] : {std::pair{"semi_implicit_euler", 1},
                                      {"velocity_verlet", 2},
                                      {"rk2_midpoint", 2},
                                      {"rk4", 4},
                                      {"implicit_midpoint", 2}}) {
        const double coarse = rocket_error(method(name), 20);
        const double fine = rocket_error(method(name), 40);
        EXPECT_GT(fine, 1e-12) << name;
        EXPECT_NEAR(std::log2(coarse / fine), order, 0.1) << name;
    }
    EXPECT_LE(rocket_error(method("exact"), 20), 1e-14);
}

TEST(Pushes, AreGoneAfterTheNextStep) {
    World world(2, {.rate = {10}});
    const Entity body = world.spawn({.mass = 4});
    world.apply_force(body, {8, -4});
    world.step(3);
    EXPECT_EQ(world.velocity(body), (Vec3{0.2, -0.1}));
    world.step();
    EXPECT_EQ(world.velocity(body), (Vec3{0.2, -0.1}));
}

TEST(Pushes, DoNotDependOnTheStepsPerCall) {
    World one(2, {.method = &method("rk4"), .rate = {50}});
    const Entity body = one.spawn({.mass = 3, .velocity = {1}}, QuadraticDrag{0.5});
    World three = one;
    one.apply_force(body, {1, 2});
    three.apply_force(body, {1, 2});
    for (int i = 0; i < 3; ++i) one.step();
    three.step(3);
    EXPECT_EQ(one.state_hash(), three.state_hash());
}

// The force acts on every link of a net alike: the centre of mass of two linked bodies moves as one
// body of their mass.
TEST(Pushes, MoveLinkedBodies) {
    for (const char* name :
         {"semi_implicit_euler", "velocity_verlet", "rk4", "implicit_midpoint"}) {
        World world(1, {.method = &method(name), .rate = {100}});
        const Entity a = world.spawn({.mass = 1});
        const Entity b = world.spawn({.mass = 3, .position = {2}});
        world.link(a, b, {.stiffness = 50, .damping = 0.5, .rest_length = 2});
        for (int i = 0; i < 100; ++i) {
            world.apply_force(a, {8});
            world.step();
        }
        const double momentum = world.velocity(a)[0] + 3 * world.velocity(b)[0];
        EXPECT_NEAR(momentum, 8, 1e-12) << name;
    }
}

// A step may reuse the accelerations from the end of the step before, but not across the begin or
// the end of a push. The momentum of both bodies is force times dt.
TEST(Pushes, ActOnLinkedBodiesForOneStep) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "blanes_moan_srkn6b", "rk4",
                             "implicit_midpoint"}) {
        World world(1, {.method = &method(name), .rate = {64}});
        const Entity a = world.spawn({});
        const Entity b = world.spawn({.position = {2}});
        world.link(a, b, {.stiffness = 50, .rest_length = 2});
        const auto momentum = [&] { return world.velocity(a)[0] + world.velocity(b)[0]; };
        world.step();
        world.apply_force(a, {8});
        world.step();
        EXPECT_NEAR(momentum(), 8.0 / 64, 1e-15) << name;
        world.step();
        EXPECT_NEAR(momentum(), 8.0 / 64, 1e-15) << name;
    }
}

TEST(Pushes, FollowABodyWhoseRowMoves) {
    World world(1, {.rate = {1}});
    const Entity first = world.spawn({});
    const Entity second = world.spawn({});
    const Entity third = world.spawn({});
    world.apply_force(first, {5});
    world.apply_force(third, {7});
    world.destroy(first);
    const Entity fourth = world.spawn({});
    world.step();
    EXPECT_EQ(world.velocity(second)[0], 0);
    EXPECT_EQ(world.velocity(third)[0], 7);
    EXPECT_EQ(world.velocity(fourth)[0], 0);
    world.apply_force(fourth, {3});
    world.step();
    EXPECT_EQ(world.velocity(third)[0], 7);
    EXPECT_EQ(world.velocity(fourth)[0], 3);
}

TEST(Pushes, StayWithTheirBodyWhenOthersComeAndGo) {
    World world(1, {.rate = {1}});
    const Entity first = world.spawn({});
    const Entity pushed = world.spawn({});
    world.apply_force(pushed, {5});
    const Entity late = world.spawn({});
    world.destroy(first);
    ASSERT_EQ(world.row(late), 0U);
    world.step();
    EXPECT_EQ(world.velocity(late)[0], 0);
    EXPECT_EQ(world.velocity(pushed)[0], 5);
}

TEST(Pushes, LeaveNothingBehindInTheState) {
    World world(1, {.rate = {1}});
    const Entity body = world.spawn({});
    const Entity gone = world.spawn({});
    World other = world;
    world.apply_force(gone, {2});
    world.destroy(gone);
    other.destroy(gone);
    EXPECT_EQ(world.state_hash(), other.state_hash());
    world.apply_force(body, {4});
    world.step();
    other.step();
    other.set_position(body, world.position(body));
    other.set_velocity(body, {4});
    EXPECT_EQ(world.state_hash(), other.state_hash());
}

TEST(Pushes, ArePartOfTheStateUntilTheyActed) {
    World world(1);
    const Entity body = world.spawn({});
    const World before = world;
    world.apply_force(body, {1e-3});
    EXPECT_NE(world.state_hash(), before.state_hash());
    World copy = world;
    world.step();
    copy.step();
    EXPECT_EQ(world.state_hash(), copy.state_hash());
    EXPECT_EQ(copy.velocity(body)[0], 1e-3 / 100);
}

TEST(Pushes, WakeASleepingBody) {
    World world(1, {.rate = {64}});
    const Entity body = world.spawn({.velocity = {1e-300}}, LinearDrag{50});
    world.step(128);
    ASSERT_EQ(world.velocity(body)[0], 0);
    world.apply_force(body, {64});
    world.step();
    EXPECT_EQ(world.velocity(body)[0], 1);
}

TEST(Pushes, ImpulsesChangeVelocityAtOnce) {
    World world(2);
    const Entity body = world.spawn({.mass = 4, .velocity = {1, 1}});
    world.apply_impulse(body, {2, -8});
    EXPECT_EQ(world.velocity(body), (Vec3{1.5, -1}));
    EXPECT_EQ(world.mass(body), 4);
}

TEST(Pushes, OfPositionsAreDrawnAsMotion) {
    World world(2);
    const Entity body = world.spawn({});
    world.set_position(body, {3, 4});
    EXPECT_EQ(world.position(body), (Vec3{3, 4}));
    EXPECT_EQ(world.jumps(body), 0U);
}

/// The line of the error of `f`, after which the world must be unchanged.
template <class F>
std::string refusal(World& world, F f) {
    const std::uint64_t hash = world.state_hash();
    const std::string line = line_of_error(Exit::diverged, f);
    EXPECT_EQ(world.state_hash(), hash);
    return line;
}

TEST(Pushes, RefuseNumbersThatAreNotFinite) {
    World world(2, {.precision = Precision::single});
    world.spawn({});
    const Entity body = world.spawn({.mass = 1e-10});
    world.step(7);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal(world,
                      [&] {
                          world.apply_force(body, {0, nan});
                      }),
              "apply_force of entity 1 at tick 7: a force of nan: give a number that is finite and "
              "at most 3.40282e+38");
    EXPECT_EQ(refusal(world, [&] { world.apply_force(body, {1e30}); }),
              "apply_force of entity 1 at tick 7: the acceleration by a force of 1e+40: give a "
              "number that is finite and at most 3.40282e+38");
    world.apply_force(body, {0, 3e28});
    EXPECT_EQ(refusal(world,
                      [&] {
                          world.apply_force(body, {0, 3e28});
                      }),
              "apply_force of entity 1 at tick 7: the sum of the forces on a body of inf: give a "
              "number that is finite and at most 3.40282e+38");
    EXPECT_TRUE(holds(refusal(world, [&] { world.apply_impulse(body, {1e30}); }), "1e+40"));
    for (const auto& set : {&World::set_velocity, &World::set_position, &World::teleport})
        EXPECT_TRUE(
            holds(refusal(world, [&] { (world.*set)(body, {nan}); }), "entity 1 at tick 7"));
    EXPECT_EQ(world.jumps(body), 0U);
}

TEST(Detach, TakesAForceOffABody) {
    World world(1, {.rate = {1}});
    const Entity one = world.spawn({.velocity = {4}}, LinearDrag{0.5});
    const Entity other = world.spawn({.velocity = {4}}, LinearDrag{0.5});
    world.detach<LinearDrag>(one);
    world.step();
    EXPECT_EQ(world.velocity(one)[0], 4);
    EXPECT_EQ(world.velocity(other)[0], 2);
    world.detach<LinearDrag>(other);
    for (const Stored& stored : world.bodies().stored()) EXPECT_NE(stored.of, LinearDrag::name);
    world.attach(one, LinearDrag{0.25});
    world.step();
    EXPECT_EQ(world.velocity(one)[0], 3);
    EXPECT_EQ(world.velocity(other)[0], 2);
}

TEST(Links, HaveHandlesThatKnowWhenTheyAreGone) {
    World world(1);
    const Entity a = world.spawn({});
    const Entity b = world.spawn({.position = {1}});
    const Entity c = world.spawn({.position = {2}});
    const LinkHandle ab = world.link(a, b, {.stiffness = 1});
    const LinkHandle bc = world.link(b, c, {.stiffness = 2});
    EXPECT_FALSE(world.alive(LinkHandle{}));
    world.unlink(ab);
    EXPECT_FALSE(world.alive(ab));
    EXPECT_TRUE(world.alive(bc));
    ASSERT_EQ(world.bodies().link_count(), 1U);
    EXPECT_EQ(world.bodies().link_at(0).stiffness, 2);
    const LinkHandle again = world.link(a, c, {.stiffness = 3});
    EXPECT_EQ(again.slot, ab.slot);
    EXPECT_FALSE(world.alive(ab));
    const World copy = world;
    world.destroy(c);
    EXPECT_FALSE(world.alive(bc));
    EXPECT_FALSE(world.alive(again));
    EXPECT_TRUE(copy.alive(again));
    EXPECT_THROW(world.unlink(bc), Mistake);
}

TEST(Links, HaveNumbersThatCanBeRead) {
    World world(1);
    const Entity a = world.spawn({});
    const Entity b = world.spawn({.position = {1}});
    const LinkHandle rope = world.link_to_point(
        a, {5}, {.stiffness = 1, .damping = 2, .rest_length = 3, .pulls_only = true});
    const LinkHandle gone = world.link(a, b, {.stiffness = 6});
    const LinkHandle spring = world.link(b, a, {.stiffness = 4, .rest_length = 5});
    world.unlink(gone);
    EXPECT_EQ(world.link(rope).stiffness, 1);
    EXPECT_EQ(world.link(rope).damping, 2);
    EXPECT_EQ(world.link(rope).rest_length, 3);
    EXPECT_TRUE(world.link(rope).pulls_only);
    EXPECT_EQ(world.link(spring).stiffness, 4);
    EXPECT_EQ(world.link(spring).rest_length, 5);
    EXPECT_FALSE(world.link(spring).pulls_only);
    EXPECT_THROW((void)world.link(gone), Mistake);
}

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

// A lost bounce makes no run diverge; a spring of ω·dt = 3 does.
TEST(Preflight, TellsInstabilitiesFromTheRest) {
    World world(1, {.rate = Rate{60}});
    world.set_gravity({-9.81});
    world.add_plane({.normal = {1}, .restitution = 1});
    world.spawn(Body{.velocity = {3}, .contact = Contact{}});
    EXPECT_EQ(world.preflight().size(), 1U);
    EXPECT_TRUE(world.instabilities(1).empty());
    world.spawn(Body{.position = {1}}, Spring{.stiffness = 9 * 3600.0});
    EXPECT_EQ(world.preflight().size(), 2U);
    ASSERT_EQ(world.instabilities(1).size(), 1U);
    EXPECT_TRUE(holds(world.instabilities(1)[0], "ω·dt = 3"));
}

}  // namespace
}  // namespace oiler::test
