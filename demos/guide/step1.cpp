// SPDX-License-Identifier: MIT
// A ball flies.
#include "oiler/oiler.hpp"

using namespace oiler;

struct Cannon {
    static constexpr About about{
        .name = "step1", .title = "Cannon, step 1", .method = "velocity_verlet"};

    World world;
    Camera camera{.centre = {16, 8}, .height = 20};

    explicit Cannon(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        const Entity ball = world.spawn(Body{.position = {2, 1}, .velocity = {12, 14}});
        world.add(ball, Look{.size = 0.3F});
    }
};

int main(int argc, char** argv) { return run<Cannon>(argc, argv); }
