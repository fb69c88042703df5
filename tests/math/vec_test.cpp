// SPDX-License-Identifier: MIT
#include "oiler/math/vec.hpp"

#include <gtest/gtest.h>

namespace oiler {
namespace {

template <class V>
concept CanAddToX = requires(V (*returns)()) {
    returns()[0] += 1;
};

// `world.velocity(body)[0] += 1` would change a copy.
TEST(Vec, ReturnedByValueCanBeReadButNotChanged) {
    EXPECT_FALSE(CanAddToX<Vec3>);
    EXPECT_TRUE(CanAddToX<Vec3&>);
    EXPECT_EQ((Vec3{1, 2, 3} + Vec3{1, 1, 1})[2], 4);
}

TEST(Vec, HasTheOperatorsOfVectors) {
    Vec3 a{1, -2, 2};
    EXPECT_EQ(2.0 * a, (Vec3{2, -4, 4}));
    EXPECT_EQ(a / 4, (Vec3{0.25, -0.5, 0.5}));
    EXPECT_EQ(length(a), 3);
    EXPECT_EQ(length(normalised(a / 8)), 1);
    EXPECT_EQ(dot(normalised(a * 3), a), 3);
    EXPECT_EQ(normalised(Vec3{}), Vec3{});
    a += {1, 1, 1};
    EXPECT_EQ(a, (Vec3{2, -1, 3}));
    a -= {0, 1, 5};
    EXPECT_EQ(a, (Vec3{2, -2, -2}));
    a *= 3;
    EXPECT_EQ(a, (Vec3{6, -6, -6}));
    a /= 2;
    EXPECT_EQ(a, (Vec3{3, -3, -3}));
}

}  // namespace
}  // namespace oiler
