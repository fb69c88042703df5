// SPDX-License-Identifier: MIT
// The settings of a world affect its steps.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>

#include "oiler/world/world.hpp"

namespace {

using namespace oiler;

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
    const World world(1, {.precision = oiler::Precision::single});
    EXPECT_EQ(world.bodies().precision(), oiler::Precision::single);
}

}  // namespace
