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

}  // namespace
}  // namespace oiler
