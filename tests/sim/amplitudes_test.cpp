// SPDX-License-Identifier: MIT
// Motion at the smallest and largest amplitudes, and far from the origin.
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{64};
constexpr int steps = 200;

/// The state after `steps` steps from 2^power m, divided by 2^power.
struct Scaled {
    long double x;
    long double v;
};

Scaled from_power(const Method& method, Precision precision, int power, double damping = 0.1) {
    Bodies bodies = oscillator(precision, 15, damping, std::ldexp(1, power));
    bodies.step(method, {rate, 0, steps});
    return {std::ldexp(x_of(bodies), -power), std::ldexp(v_of(bodies), -power)};
}

// Up to 1e300 m and 1e30 m. The lower limit keeps an iteration's last corrections, u² of the state,
// normal numbers.
TEST(Amplitude, ScalesTheMotionToTheBit) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            const bool single = precision == Precision::single;
            const Scaled one = from_power(method, precision, 0);
            EXPECT_NE(one.x, 1);
            for (const int power : {single ? -60 : -880, -1, single ? 100 : 996}) {
                const Scaled scaled = from_power(method, precision, power);
                EXPECT_EQ(scaled.x, one.x) << method.name << ", 2^" << power;
                EXPECT_EQ(scaled.v, one.v) << method.name << ", 2^" << power;
            }
        }
}

// 2⁻¹⁰³⁰ = 9e-311 and 2⁻¹³³ = 9e-41. Each rounding of x or v is up to half of the smallest number.
// With ω = 3.9/s and ω·dt < 1, roundings grow by at most ω. Without damping, because damped bodies
// this small sleep.
TEST(Amplitude, OfSubnormalNumbersLosesTheSmallestNumberPerRounding) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            const bool single = precision == Precision::single;
            const int power = single ? -133 : -1030;
            const double smallest = std::ldexp(1, (single ? -149 : -1074) - power);
            const Scaled one = from_power(method, precision, 0, 0);
            const Scaled small = from_power(method, precision, power, 0);
            const double tolerance =
                steps * roundings(method) * (smallest / 2 + round_off_of(precision));
            EXPECT_NEAR(small.x, one.x, tolerance) << method.name;
            EXPECT_NEAR(small.v, one.v, 4 * tolerance) << method.name;
            EXPECT_NE(small.x, one.x) << method.name;
        }
}

// A damped spring fades through the subnormal numbers, which is no divergence. From a thousand
// times the smallest normal number, e^(−2t) reaches them in 3.5 s = 55 steps.
TEST(Amplitude, FadesAwayWithoutAnError) {
    for (const Method& method : methods())
        for (const Precision precision : precisions)
            for (const double damping : {3.0, 4.0, 5.0}) {
                const double smallest = precision == Precision::single
                                            ? double{std::numeric_limits<float>::min()}
                                            : std::numeric_limits<double>::min();
                Bodies bodies = oscillator(precision, 15, damping, 1000 * smallest, smallest);
                const auto where = bodies.try_step(method, {{16}, 0, 1000});
                ASSERT_FALSE(where) << method.name << ", " << name_of(precision)
                                    << ", c = " << damping << ", at step " << where->tick;
                EXPECT_LT(std::abs(x_of(bodies)), 1e-5 * smallest) << method.name;
            }
}

/// A number whose square overflows in the columns.
double too_large_to_square(Precision precision) {
    return precision == Precision::single ? 1e30 : 1e200;
}

/// The methods that report no divergence for bodies with a number too large to square.
template <class MakeBodies>
std::vector<std::string> silent_methods(MakeBodies make) {
    std::vector<std::string> silent;
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            if (is_exact(method)) continue;
            Bodies bodies = make(precision, too_large_to_square(precision));
            if (!bodies.try_step(method, {rate, 0, 2}))
                silent.push_back(std::string(method.name) + " in " +
                                 std::string(name_of(precision)));
        }
    return silent;
}
const std::vector<std::string> none;

// This drag reduces the speed by 1.6 % per second, but its |v|² is infinite. It must not silently
// stop the body.
TEST(Amplitude, QuadraticDragOfASpeedWithAnInfiniteSquareIsReported) {
    const auto fast = [](Precision precision, double large) {
        Bodies bodies(1, precision);
        bodies.add({.velocity = {large}}, QuadraticDrag{0.016 / large});
        return bodies;
    };
    EXPECT_EQ(silent_methods(fast), none);
}

TEST(Amplitude, ACoilSpringOfALengthWithAnInfiniteSquareIsReported) {
    for (const double damping : {0.0, 1.0}) {
        const auto long_coil = [&](Precision precision, double large) {
            Bodies bodies(2, precision);
            bodies.add({.position = {large, large}},
                       CoilSpring{.stiffness = 1, .damping = damping, .rest_length = 1});
            return bodies;
        };
        EXPECT_EQ(silent_methods(long_coil), none) << damping;
    }
}

TEST(Amplitude, ALinkOfALengthWithAnInfiniteSquareIsReported) {
    const auto long_link = [](Precision precision, double large) {
        Bodies bodies(2, precision);
        bodies.add({.position = {large, 0}});
        bodies.add({});
        bodies.link(0, 1, {.stiffness = 1, .rest_length = 1});
        return bodies;
    };
    EXPECT_EQ(silent_methods(long_link), none);
}

/// The largest fraction of a step's displacement that the method adds to a position in one
/// addition.
double longest_move(const Method& method) {
    long double longest = 0;
    if (const auto* splitting = std::get_if<Splitting>(&method.rule)) {
        for (const auto& stage : splitting->stages())
            if (stage.move == Move::drift) longest = std::max(longest, std::abs(stage.coefficient));
    } else if (const auto* tableau = std::get_if<Tableau>(&method.rule)) {
        longest = *std::max_element(tableau->b.begin(), tableau->b.end());
    } else {
        longest = 1;
    }
    return static_cast<double>(longest);
}

// Floats around 1e7 are 1 m apart. 30 m/s at 60 Hz is 0.5 m per step, which rounds to the even 1e7.
// Methods that move in several additions also stand still, unless one addition exceeds 0.5 m.
TEST(FarFromTheOrigin, ABodyAt30MetresPerSecondStandsStillInFloat) {
    int standing = 0;
    for (const Method& method : methods()) {
        if (longest_move(method) > 1) continue;
        Bodies bodies(1, Precision::single);
        bodies.add({.position = {1e7}, .velocity = {30}});
        bodies.step(method, {{60}, 0, 600});
        EXPECT_EQ(x_of(bodies), 1e7L) << method.name;
        ++standing;
    }
    EXPECT_GE(standing, 13);
}

// Doubles around 1e7 are 2⁻³⁰ m apart. Each of up to twenty moves per step rounds by half of that.
TEST(FarFromTheOrigin, ABodyAt30MetresPerSecondMovesToWithinRoundOffInDouble) {
    for (const Method& method : methods()) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.position = {1e7}, .velocity = {30}});
        bodies.step(method, {{60}, 0, 600});
        EXPECT_NEAR(x_of(bodies), 1e7L + 300, 600 * roundings(method) * std::ldexp(1, -30) / 2)
            << method.name;
        EXPECT_NE(x_of(bodies), 1e7L);
    }
}

// 1 m from its anchor the spring adds 15 m/s² · dt = 0.25 m/s per step, exactly in float. The mass
// stands still until it has 30 m/s, after 2 s. Then a step of 0.5 m rounds to the anchor, which is
// even. There is no force there, and the next 0.5 m round back to it: the mass stands still for
// good, at 30 m/s and 60 times the energy. This is a limit of float.
TEST(FarFromTheOrigin, ASpringInFloatHoldsItsMassAtTheAnchor) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies bodies(1, Precision::single);
    bodies.add({.position = {1e7 + 1}}, Spring{.anchor = {1e7}, .stiffness = 15});
    bodies.step(method, {{60}, 0, 119});
    EXPECT_EQ(x_of(bodies), 1e7L + 1);
    EXPECT_EQ(v_of(bodies), -119 * 0.25);
    bodies.step(method, {{60}, 119, 1});
    EXPECT_EQ(x_of(bodies), 1e7L);
    bodies.step(method, {{60}, 120, 600});
    EXPECT_EQ(x_of(bodies), 1e7L);
    EXPECT_EQ(v_of(bodies), -30);
}

// The motion is that at the origin, apart from roundings of positions around 1e7 m. The spring does
// not amplify them, because h = 0.065 is small.
TEST(FarFromTheOrigin, ASpringInDoubleOscillatesAsAtTheOrigin) {
    for (const Method& method : methods()) {
        Bodies here = oscillator(Precision::double_, 15, 0.1, 1);
        Bodies far(1, Precision::double_);
        far.add({.position = {1e7 + 1}}, Spring{.anchor = {1e7}, .stiffness = 15, .damping = 0.1});
        here.step(method, {{60}, 0, 600});
        far.step(method, {{60}, 0, 600});
        const double tolerance = 600 * roundings(method) * std::ldexp(1, -30) / 2;
        EXPECT_NEAR(x_of(far) - 1e7L, x_of(here), tolerance) << method.name;
        EXPECT_NEAR(v_of(far), v_of(here), tolerance * 4) << method.name;
    }
}

}  // namespace
}  // namespace oiler::test
