// SPDX-License-Identifier: MIT
#include <random>

#include "oiler/math/matrix.hpp"
#include "oiler/math/sine.hpp"
#include "oiler/math/vec.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Round-offs of `turns` and of `sine_of_turns`, as their comments promise.
constexpr long double turns_error = 6;
constexpr long double sine_error = 10;
constexpr long double two_pi = 6.283185307179586476925286766559005768L;

template <class T>
constexpr long double round_off = std::numeric_limits<T>::epsilon() / 2;

/// The difference of two angles in turns, where whole turns do not count.
long double apart(long double a, long double b) { return std::abs(std::remainder(a - b, 1.0L)); }

struct Sample {
    long double frequency;
    double t;
    double phase;  ///< turns
    long double turns;
    long double sine;
};

// The literals are the fraction of f·t and sin(2π·(f·t + phase)) to 40 digits in Python, from exact
// products of the numbers as they are stored:
//   from fractions import Fraction as F; from mpmath import *; mp.dps = 60
//   f, t, p = F(1000), F(99999.9873), F(0.25)
//   real = lambda q: mpf(q.numerator)/q.denominator; whole = lambda q: q - round(q)
//   print(nstr(real(whole(f*t)), 40), nstr(sin(2*pi*real(whole(f*t + p))), 40))
constexpr Sample samples[] = {
    {1.75L, 0.0, 0.25, 0.0L, 1.0L},
    {1.75L, 0.3125, 0.0, -0.453125L, -0.2902846772544623676361923758173952746915L},
    {-2.5L, 0.4375, -0.375, -0.09375L, -0.1950903220161282678482848684770222409277L},
    {0x1.99999ap-4L, 16.7, 0.125, -0.3299999751150608773286886973012026549879L,
     -0.9602936420548071651069295048314952497413L},
    {1000.0L, 0.123456789, 0.0, 0.456788999999997336054491370305186137557L,
     0.2681794130803331742574651453858642557165L},
    {1000.0L, 99999.9873, 0.25, 0.299999993410892784595489501953125L,
     -0.3090169550006542090409509137569698965573L},
    {-1000.0L, 99999.9873, 0.0, -0.299999993410892784595489501953125L,
     -0.9510565290886360618321389901346900258184L},
    {0x1.f3fccep+9L, 100000.0, -0.375, -0.337890625L, 0.9729399522055601454677201139037965700244L},
    {-60.0L, 86400.0078125, 0.0, -0.46875L, -0.1950903220161282678482848684770222409277L},
    {-0x1.82a92p+5L, 0x1.7f1996191913bp+16, 0.125, 0.4877297552155086535208283748943358659744L,
     -0.6505450891768558428588008182447552164712L},
    {0x1.986c2ap+8L, 0x1.6e9e5bd81538p+29, 0.0, -0.4943101764656603336334228515625L,
     -0.03574260085784573049846305983687967096582L},
    {-0x1.f3fffbcdef012p+9L, 0x1.869fffffcafep+16, 0.0,
     -0.1929713712641352413265097696828780093892L, -0.9364868176049831690888647782792117914146L},
    {0x1.f3ffff36fe8p+9L, 100000.0, 0.25, -0.396176569163799285888671875L,
     -0.7946643579563349870704706891031536775951L},
    {0x1.b70a3d70a3d70a3ep+8L, 100000.0, 0.0, 7.7715611723760957829654216766357421875e-13L,
     0.000000000004883015897212084659270917861451738973171L},
    {-0x1.2a05f2345678abcep+33L, 0x1.dcd6500000123p+28, 0.125,
     0.4370188363040258816560879040480358526111L, -0.3798885775888530384892597965219092496472L},
    {-0x1.f40ccccccccccccep+9L, 0x1.869ff5a3c1234p+16, -0.375,
     0.4741024846352392088256762651940155176723L, 0.5832136769435401605164593731307970104302L},
};

template <class T>
class Sine : public testing::Test {};
using Types = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(Sine, Types, );

TYPED_TEST(Sine, HasTheDigitsOfTheReferences) {
    using T = TypeParam;
    for (const Sample& sample : samples) {
        const T frequency = static_cast<T>(sample.frequency);
        if (frequency != sample.frequency) continue;
        const T fraction = turns(frequency, sample.t);
        EXPECT_LE(std::abs(fraction), T(0.5));
        EXPECT_LE(apart(fraction, sample.turns), turns_error * round_off<T>)
            << sample.frequency << " Hz, " << sample.t << " s";
        // The sum of fraction and phase is rounded once.
        EXPECT_LE(std::abs(sine_of_turns(fraction + T(sample.phase)) - sample.sine),
                  (two_pi * (turns_error + 1) + sine_error) * round_off<T>)
            << sample.frequency << " Hz, " << sample.t << " s";
    }
}

// A frequency of 24 digits times a time of 40 digits has 64 digits: a long double holds it, and
// std::remainder is exact. In float, most of these products are beyond the range of nearest_whole.
TYPED_TEST(Sine, CountsTurnsOverDays) {
    using T = TypeParam;
    std::mt19937_64 random(1);
    long double largest = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto sign = static_cast<float>(i % 2 == 0 ? 1 : -1);
        const float frequency = sign * std::ldexp(static_cast<float>(random() >> 40), -14);
        const double t = std::ldexp(static_cast<double>(random() >> 24), -22);
        const T fraction = turns(T(frequency), t);
        largest = std::max(largest, apart(fraction, 1.0L * frequency * t));
    }
    EXPECT_LE(largest, turns_error * round_off<T>);
}

// The C library's sine of a number up to π is right to an ulp, after two roundings of that number.
TYPED_TEST(Sine, HasTheErrorThatItPromises) {
    using T = TypeParam;
    long double largest = 0;
    for (int i = -(1 << 21); i <= 1 << 21; ++i) {
        const T angle = std::ldexp(static_cast<T>(i), -22);
        const long double sine = std::sin(two_pi * angle);
        largest = std::max(largest, std::abs(sine_of_turns(angle) - sine));
    }
    EXPECT_LE(largest, sine_error * round_off<T> + 4 * round_off<long double>);
}

TYPED_TEST(Sine, HasThePeriodOfOneTurn) {
    using T = TypeParam;
    for (const int whole : {-1000, -1, 1, 2, 1'000'000})
        for (const T fraction : {T(-0.375), T(-0.25), T(0), T(0.125), T(0.25)})
            EXPECT_EQ(sine_of_turns(T(whole) + fraction), sine_of_turns(fraction)) << whole;
}

}  // namespace

/// A number of 113 bits, as long double has on ARM64.
using Float113 [[gnu::mode(TF)]] = float;
struct Quad {
    constexpr Quad(auto number) : value(static_cast<Float113>(number)) {}
    constexpr explicit operator double() const { return static_cast<double>(value); }
    friend constexpr Quad operator+(Quad a, Quad b) { return a.value + b.value; }
    friend constexpr Quad operator-(Quad a, Quad b) { return a.value - b.value; }
    friend constexpr Quad operator*(Quad a, Quad b) { return a.value * b.value; }
    friend constexpr Quad operator/(Quad a, Quad b) { return a.value / b.value; }
    friend constexpr Quad operator-(Quad a) { return -a.value; }

    Float113 value;
};

}  // namespace oiler::test

template <>
struct std::numeric_limits<oiler::test::Quad> {
    static constexpr int digits = 113;
};

namespace oiler::test {
namespace {

// The literals and the constant of `sine_of_turns` have more than 113 bits where long double has.
TEST(Sine113, IsAtLeastAsPreciseAsALongDouble) {
    for (const Sample& sample : samples) {
        const Quad fraction = turns(Quad(sample.frequency), sample.t);
        const Quad sine = sine_of_turns(fraction + Quad(sample.phase));
        EXPECT_LE(apart(static_cast<long double>(fraction.value), sample.turns),
                  round_off<long double>);
        EXPECT_LE(std::abs(static_cast<long double>(sine.value) - sample.sine),
                  (two_pi + 2) * round_off<long double>);
    }
    EXPECT_EQ(static_cast<double>(nearest_whole(Quad(0x1p111L) - Quad(0.25L))), 0x1p111);
    EXPECT_EQ(static_cast<double>(nearest_whole(Quad(0x1p52L) + Quad(0.75L)) - Quad(0x1p52L)), 1);
}

using Matrix2 = Matrix<double, 2>;
using Vector2 = Vec<double, 2>;
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

// x = y = 1/(1 + 1e-20), which rounds to 1. With 1e-20 as the pivot, x would be 0.
TEST(Solve, TakesTheLargestPivotHoweverSigned) {
    const Vector2 large{-1, 1};
    const Vector2 small{1e-20, 1};
    EXPECT_EQ(solve(Matrix2{{large, small}}, Vector2{0, 1}), (Vector2{1, 1}));
    EXPECT_EQ(solve(Matrix2{{small, large}}, Vector2{1, 0}), (Vector2{1, 1}));
}

TEST(Solve, IsNotFiniteIfTheMatrixIsSingular) {
    const Matrix2 m{{Vector2{1, 2}, Vector2{2, 4}}};
    const Vector2 x = solve(m, Vector2{1, 1});
    EXPECT_FALSE(std::isfinite(x[0]) && std::isfinite(x[1]));
}

TEST(Matrix, OuterProductHasItsFirstFactorDownTheRows) {
    const Matrix2 m = Matrix2::outer({2, 3}, {5, 7});
    EXPECT_EQ(m(0, 1), 14);
    EXPECT_EQ(m(1, 0), 15);
}

}  // namespace
}  // namespace oiler::test
