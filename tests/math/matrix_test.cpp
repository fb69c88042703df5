// SPDX-License-Identifier: MIT
#include "oiler/math/matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace oiler {
namespace {

using Matrix3 = Matrix<double, 3>;
using Vector3 = Vec<double, 3>;

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
}  // namespace oiler
