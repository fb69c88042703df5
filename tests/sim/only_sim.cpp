// SPDX-License-Identifier: MIT
#include <cstdio>

#include "oiler/sim/bodies.hpp"

// The smallest program that simulates: the article's spring for 10 s at 100 Hz. A test checks its
// output, and that it links no window and no GL.
int main() {
    oiler::Bodies bodies(1, oiler::Precision::double_);
    bodies.add({.position = {1000, 0, 0}}, oiler::Spring{.stiffness = 15, .damping = 0.1});
    bodies.step(oiler::find_method("semi_implicit_euler"), {{100}, 0, 1000});
    std::printf("%.9f\n", bodies.position(0)[0]);
}
