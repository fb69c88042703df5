// SPDX-License-Identifier: MIT
#include "oiler/math/vec.hpp"
#include "oiler/math/matrix.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Matrix3 = Matrix<double, 3>;
using Vector3 = Vec<double, 3>;

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

// Every elimination step needs an exchange of rows: the largest numbers of the first column are in
// the last row, of the second column in the first. All numbers are small integers: no rounding.
TEST(Solve, ExchangesRowsOfBothSides) {
    const Matrix3 m{{Vector3{0, 4, 1}, Vector3{1, 0, 2}, Vector3{2, 0, 0}}};
    const Vector3 x{3, -1, 5};
    const Vector3 b{0 * 3 + 4 * -1 + 1 * 5, 1 * 3 + 0 * -1 + 2 * 5, 2 * 3 + 0 * -1 + 0 * 5};
    EXPECT_EQ(solve(m, b), x);
}

TEST(Solve, IsNotFiniteIfTheMatrixIsSingular) {
    const Matrix<double, 2> m{{Vec<double, 2>{1, 2}, Vec<double, 2>{2, 4}}};
    const Vec<double, 2> x = solve(m, Vec<double, 2>{1, 1});
    EXPECT_FALSE(std::isfinite(x[0]) && std::isfinite(x[1]));
}

TEST(Matrix, OuterProductHasItsFirstFactorDownTheRows) {
    const Matrix<double, 2> m = Matrix<double, 2>::outer({2, 3}, {5, 7});
    EXPECT_EQ(m(0, 1), 14);
    EXPECT_EQ(m(1, 0), 15);
}

}  // namespace
}  // namespace oiler::test
