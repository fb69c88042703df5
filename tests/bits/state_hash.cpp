// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include "oiler/core/state_hash.hpp"
#include "oiler/world/world.hpp"

// Prints a line for each method, precision and number of axes, with the state hash after 10,000
// steps of assorted bodies. Compiled by several compilers with several options, it must print the
// same. Numbers are made of small integers over powers of two, so that nothing but the engine's own
// arithmetic can differ.

namespace {

using oiler::Vec3;
using oiler::World;

constexpr int bodies = 70;
constexpr int steps = 10'000;

/// From −12 to 12, in steps of 1/8.
Vec3 assorted(int i, int axes) {
    Vec3 numbers{};
    for (int axis = 0; axis < axes; ++axis)
        numbers[axis] = ((i * 37 + axis * 59 + 11) % 193 - 96) / 8.0;
    return numbers;
}

/// Springs of ω up to 5 rad/s at 256 Hz. Explicit Euler gains up to (ω·dt)²/2 a step on each unless
/// its damping, at least 1/8 per s and kg, takes more: 1/8·dt > 25·dt².
void spawn_assorted(World& world, int i) {
    const int axes = world.bodies().axes();
    const double mass = 1 + i % 3 / 2.0;
    const oiler::Body body{
        .mass = mass, .position = assorted(i, axes), .velocity = assorted(i + 7, axes)};
    const oiler::Entity entity = world.spawn(body);
    if (i % 4 != 3)
        world.attach(entity, oiler::Spring{.anchor = assorted(i + 13, axes),
                                           .stiffness = mass * (1 + i % 24),
                                           .damping = mass * (1 + i % 5) / 8.0});
    if (i % 3 == 1) world.attach(entity, oiler::LinearDrag{(1 + i % 7) / 64.0});
    if (i % 5 == 2) world.attach(entity, oiler::QuadraticDrag{(1 + i % 3) / 128.0});
}

std::uint64_t hash_after_run(const oiler::Method& method, oiler::Precision precision, int axes) {
    World world(axes, {.rate = {256}, .method = &method, .precision = precision});
    world.set_gravity(assorted(5, axes));
    for (int i = 0; i < bodies; ++i) spawn_assorted(world, i);
    world.step(steps);
    return world.state_hash();
}

}  // namespace

int main() {
    for (const oiler::Method& method : oiler::methods())
        for (const auto precision : {oiler::Precision::single, oiler::Precision::double_})
            for (int axes = 1; axes <= 3; ++axes)
                std::printf("%s %s %d %s\n", std::string(method.name).c_str(),
                            std::string(name_of(precision)).c_str(), axes,
                            oiler::hash_text(hash_after_run(method, precision, axes)).c_str());
}
