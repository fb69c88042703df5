// SPDX-License-Identifier: MIT
// The settings of a world affect its steps.
#include <filesystem>
#include <iterator>

#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

std::ptrdiff_t threads_of_this_process() {
    const std::filesystem::directory_iterator threads("/proc/self/task");
    return std::distance(begin(threads), end(threads));
}

// The caller is one of the threads.
TEST(WorldSettings, Threads) {
    const std::ptrdiff_t before = threads_of_this_process();
    const World world(1, {.threads = 4});
    EXPECT_EQ(threads_of_this_process(), before + 3);
    const World copy = world;
    EXPECT_EQ(threads_of_this_process(), before + 3) << "copies share the threads";
    const World alone(1);
    EXPECT_EQ(threads_of_this_process(), before + 3);
}

// A spring and a drag share the damping, whose sums have no row then.
TEST(WorldSettings, ChangeAlsoWhenAllBodiesAreGone) {
    for (const char* method : {"velocity_verlet", "exact"}) {
        World world(1);
        world.destroy(world.spawn(Body{}, Spring{.stiffness = 1, .damping = 1}, LinearDrag{1}));
        world.set_stepping({.method = &find_method(method)});
        world.step();
        EXPECT_EQ(world.settings().stepping.method->name, method);
    }
}

TEST(WorldSettings, AnotherNumberOfThreads) {
    const std::ptrdiff_t before = threads_of_this_process();
    World world(1, {.threads = 4});
    world.set_threads(3);
    EXPECT_EQ(threads_of_this_process(), before + 2);
    EXPECT_EQ(world.settings().threads, 3);
    world.set_threads(1);
    EXPECT_EQ(threads_of_this_process(), before);
    EXPECT_THROW(world.set_threads(0), Mistake);
    EXPECT_EQ(world.settings().threads, 1);
}

/// 1 kg at 1 m on a spring of 1 N/m and 1 N·s/m, after a step of 0.5 s.
double position_after_a_step(const Stepping& stepping) {
    World world(1, stepping);
    const Entity body =
        world.spawn(Body{.position = {1}, .velocity = {1}}, Spring{.stiffness = 1, .damping = 1});
    world.step();
    EXPECT_EQ(world.time(), 0.5);
    return world.position(body)[0];
}

// Explicit Euler moves with the old velocity, semi-implicit Euler with 1 − (1 + 1)/2 = 0 m/s. With
// the damper in the drift, it moves with 1 − ½ = ½ m/s, which fades as e^(−t): ½·(1 − e^(−½)) m.
TEST(WorldSettings, MethodAndDamping) {
    EXPECT_EQ(position_after_a_step({.method = &find_method("explicit_euler"), .rate = {2}}), 1.5);
    EXPECT_EQ(position_after_a_step({.rate = {2}}), 1);
    EXPECT_EQ(position_after_a_step({.rate = {2}, .damping = Damping::in_kick}), 1);
    EXPECT_NEAR(position_after_a_step({.rate = {2}, .damping = Damping::in_drift}),
                1 + 0.5 * (1 - std::exp(-0.5)), 1e-15);
}

TEST(WorldSettings, Precision) {
    const World world(1, {.precision = Precision::single});
    EXPECT_EQ(world.bodies().precision(), Precision::single);
}

/// A body that falls from rest with 8 m/s², stepped to 1 s: powers of two, so that nothing is
/// rounded.
World fallen(const Stepping& stepping) {
    World world(1, stepping);
    world.set_gravity({-8});
    (void)world.spawn(Body{});
    world.step(stepping.rate.steps);
    return world;
}

// Semi-implicit Euler falls a·t·(t + dt)/2, explicit Euler a·t·(t − dt)/2, from where it begins
// with its speed: 4·(1 + 1/4) = 5 m at 4 Hz, then 8·1 + 4·(1 − 1/8) = 11.5 m at 8 Hz.
TEST(WorldSettings, GoesOnWithAnotherRateAndMethod) {
    World world = fallen({.rate = {4}});
    const Stepping next{.method = &find_method("explicit_euler"), .rate = {8}};
    world.set_stepping(next);
    EXPECT_EQ(world.tick(), 8);
    EXPECT_EQ(world.time(), 1);
    EXPECT_EQ(world.settings().stepping, next);
    world.step(8);
    EXPECT_EQ(world.time(), 2);
    EXPECT_EQ(world.bodies().position(0)[0], -5 - 11.5);
}

TEST(WorldSettings, ChangesTheDamping) {
    World world(1, Stepping{.rate = {2}});
    const Entity body =
        world.spawn(Body{.position = {1}, .velocity = {1}}, Spring{.stiffness = 1, .damping = 1});
    world.set_stepping({.rate = {2}, .damping = Damping::in_drift});
    world.step();
    EXPECT_NEAR(world.position(body)[0], 1 + 0.5 * (1 - std::exp(-0.5)), 1e-15);
}

struct Bell {
    int number;
};

// 1.3 s at 10 Hz are 13 ticks; at 4 Hz the first tick that is not earlier is number 6, at 1.5 s.
// The second bell is due at 1 s, where the rates change, and is still due then.
TEST(WorldSettings, WhatIsScheduledKeepsItsTime) {
    World world(1, Stepping{.rate = {10}});
    world.schedule(1.3, Bell{1});
    world.schedule(1.0, Bell{2});
    world.schedule(2.0, Bell{3});
    world.step(10);
    world.set_stepping({.rate = {4}});
    std::vector<std::pair<int, double>> heard;
    for (int i = 0; i < 6; ++i) {
        world.due<Bell>([&](const Bell& bell) { heard.emplace_back(bell.number, world.time()); });
        world.step();
    }
    EXPECT_EQ(heard, (std::vector<std::pair<int, double>>{{2, 1.0}, {1, 1.5}, {3, 2.0}}));
}

// 3 ticks of 12 Hz are 0.25 s, which 8 Hz has, and 10 Hz has not. 5 steps in 2 s have it at no tick
// before 2 s.
TEST(WorldSettings, KnowsTheTicksOfOtherRates) {
    World world(1, Stepping{.rate = {12}});
    EXPECT_EQ(world.tick_at({10}), 0);
    world.step(3);
    EXPECT_EQ(world.tick_at({8}), 2);
    EXPECT_EQ(world.tick_at({12}), 3);
    EXPECT_EQ(world.tick_at({10}), std::nullopt);
    EXPECT_EQ(world.tick_at({5, 2}), std::nullopt);
    world.step(21);
    EXPECT_EQ(world.tick_at({5, 2}), 5);
    World slow(1, Stepping{.rate = {1, 2}});
    slow.step(3);
    EXPECT_EQ(slow.tick_at({1}), 6);
}

TEST(WorldSettings, RefusesWhatItCannotGoOnWith) {
    const World before = fallen({.rate = {10}});
    const auto expect_refused = [&](World world, const Stepping& stepping, const char* why) {
        const std::uint64_t hash = world.state_hash();
        const std::string line = line_of_error(Exit::usage, [&] { world.set_stepping(stepping); });
        EXPECT_TRUE(holds(line, why));
        EXPECT_EQ(world.state_hash(), hash);
        EXPECT_EQ(world.settings().stepping.rate, Rate{10});
    };
    World late = before;
    late.step();
    expect_refused(late, {.rate = {4}}, "set_stepping at tick 11: 4 Hz has no tick at 1.1 s");
    expect_refused(before, {.rate = {20}, .precision = Precision::single}, "a new world");
    World dragged = before;
    dragged.attach(dragged.entity_of_row(0), QuadraticDrag{.coefficient = 1});
    expect_refused(dragged, {.method = &find_method("exact"), .rate = {20}}, "exact");
}

}  // namespace
}  // namespace oiler::test
