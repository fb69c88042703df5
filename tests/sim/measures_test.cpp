// SPDX-License-Identifier: MIT
// Measures of bodies include every axis.
#include <gtest/gtest.h>

#include "oiler/sim/bodies.hpp"
#include "support/oscillator.hpp"

namespace oiler::test {
namespace {

TEST(Deviation, CountsEachAxisAlone) {
    for (const Precision precision : precisions)
        for (int axis = 0; axis < 3; ++axis) {
            Bodies bodies(3, precision);
            bodies.add({.position = {1, 2, 3}});
            Bodies moved = bodies;
            Vec3 by{};
            by[axis] = -0.25;
            moved.set_position(0, Vec3{1, 2, 3} + by);
            EXPECT_EQ(bodies.deviation_from(moved).distance, 0.25) << axis;
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(bodies.deviation_from(moved).along[i], i == axis ? 0.25 : 0) << axis;
        }
}

// The deviation of row 0 is √(3² + 4² + 12²) = 13 m. That of row 1 is larger along z but 12.5 m in
// total.
TEST(Deviation, IsTheLargestOfAllRowsInDistanceAndAlongEachAxis) {
    Bodies bodies(3, Precision::double_);
    for (int i = 0; i < 3; ++i) bodies.add({.position = {1, 1, 1}});
    Bodies moved = bodies;
    moved.set_position(0, {4, 5, 13});
    moved.set_position(1, {1, 1, -11.5});
    const Deviation apart = bodies.deviation_from(moved);
    EXPECT_EQ(apart.distance, 13);
    EXPECT_EQ(apart.along, (Vec3{3, 4, 12.5}));
}

TEST(Deviation, IsNotZeroIfTheSquareOfADifferenceUnderflows) {
    Bodies bodies(3, Precision::double_);
    bodies.add({});
    Bodies moved = bodies;
    moved.set_position(0, {0, 0, 1e-200});
    EXPECT_EQ(bodies.deviation_from(moved).distance, 1e-200);
}

// ½·2·3² = 9 J along one axis; 2·10·5 = 100 J in gravity, ½·6·5² = 75 J on a spring.
TEST(Energy, CountsEachAxisAlone) {
    for (const Precision precision : precisions)
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 unit{};
            unit[axis] = 1;
            Bodies bodies(3, precision);
            bodies.set_gravity(unit * -10.0);
            bodies.add({.mass = 2, .position = unit * 5.0, .velocity = unit * -3.0},
                       Spring{.stiffness = 6});
            EXPECT_EQ(bodies.energy().kinetic, 9) << axis;
            EXPECT_EQ(bodies.energy().potential, 175) << axis;
        }
}

}  // namespace
}  // namespace oiler::test
