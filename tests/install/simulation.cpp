// SPDX-License-Identifier: MIT
#include <cstdio>

#include "oiler/world/world.hpp"

// A mass on a spring for 1 s at 60 Hz.
int main() {
    oiler::World world(1, oiler::Stepping{});
    const oiler::Entity mass =
        world.spawn(oiler::Body{.position = {2}}, oiler::Spring{.stiffness = 40, .damping = 0.8});
    world.step(60);
    std::printf("%a\n", world.position(mass)[0]);
}
