// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/growth.hpp"

#include <functional>

#include "lab/advice/made_up_clock.hpp"
#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Law = Growth::Law;

/// The largest errors at the steps up to the ends of 64 equal parts of 8 s; lines add `lines` m.
Growth growth_of(const std::function<double(double t)>& error, double lines = 0) {
    std::vector<double> errors;
    for (int part = 1; part <= 64; ++part) errors.push_back(error(part / 8.0));
    return fit_growth(errors, errors.back() + lines, 8, 1e-9);
}

// An error of 2 m at 8 s is ten times as large at 80 s if it grows with t, and at 8·√10 s with t².
// t/8 + t²/64 is 20 m at 32 s.
TEST(Growth, HasTheLawOfTheErrorsAndPassesATolerance) {
    const Growth bounded = growth_of([](double t) { return 2 - std::exp(-9 * t); });
    EXPECT_EQ(bounded.law, Law::bounded);
    EXPECT_TRUE(std::isinf(bounded.holds_until(20)));
    const Growth linear = growth_of([](double t) { return t / 4; });
    EXPECT_EQ(linear.law, Law::linear);
    EXPECT_NEAR(linear.holds_until(20), 80, 1e-3);
    const Growth quadratic = growth_of([](double t) { return t * t / 32; });
    EXPECT_EQ(quadratic.law, Law::quadratic);
    EXPECT_NEAR(quadratic.holds_until(20), 8 * std::sqrt(10), 1e-3);
    const Growth both = growth_of([](double t) { return t / 8 + t * t / 64; });
    EXPECT_EQ(both.law, Law::faster_than_linear);
    EXPECT_NEAR(both.holds_until(20), 32, 0.01);
    // e-fold in 1/2 s: tenfold after ln(10)/2 s more.
    const Growth exponential = growth_of([](double t) { return 2 * std::exp(2 * (t - 8)); });
    EXPECT_EQ(exponential.law, Law::exponential);
    EXPECT_NEAR(exponential.holds_until(20), 8 + std::log(10) / 2, 1e-9);
    EXPECT_EQ(exponential.holds_until(1), 8);
}

// Lines that add 1 m leave the steps 2 m of 3 m, which t/100 m passes at 200 s: the error as drawn
// at 8 s, 1.08 m, is nearly constant. A constant error of 1 m leaves the same.
TEST(Growth, IsNotHiddenByWhatDoesNotGrow) {
    const auto slow = [](double t) { return t / 100; };
    const Growth growth = growth_of(slow, 1);
    EXPECT_EQ(growth.law, Law::linear);
    EXPECT_NEAR(growth.holds_until(3), 200, 1e-2);
    EXPECT_NEAR(growth_of([&](double t) { return 1 + slow(t); }).holds_until(3), 200, 0.5);
    EXPECT_TRUE(std::isinf(growth.holds_until(90))) << "over 1000 × 8 s";
    EXPECT_EQ(growth.holds_until(1.07), 8) << "1.08 m at 8 s";
    EXPECT_EQ(growth.holds_until(0.5), 8) << "less than the lines add";
    const Growth fast = growth_of([](double t) { return 2 * std::exp(2 * (t - 8)); }, 1);
    EXPECT_EQ(fast.holds_until(0.5), 8) << "less than the lines add";
}

TEST(Growth, OfRoundOffHasNoLaw) {
    const Growth growth = growth_of([](double t) { return 1e-9 * std::exp(t - 8); }, 1);
    EXPECT_EQ(growth.law, Law::round_off);
    EXPECT_TRUE(std::isinf(growth.holds_until(3)));
}

TEST(Growth, OfNoErrorsIsNotFitted) {
    EXPECT_EQ(fit_growth({}, 1, 8, 0).law, Law::unfit);
    EXPECT_EQ(growth_of([](double) { return 0.0; }).law, Law::unfit);
    EXPECT_EQ(fit_growth(std::vector<double>(7, 1.0), 1, 8, 0).law, Law::unfit);
}

/// An undamped spring of √15 rad/s over 40 s.
const MeasuredScene& undamped() {
    static const MeasuredScene measured(
        one_axis + "duration = 40.0\n[[body]]\nname = \"mass\"\nposition = [1000.0]\n[[spring]]\n" +
        "body = \"mass\"\nanchor = [0.0]\nstiffness = 15.0\n");
    return measured;
}

// Velocity Verlet gains a phase of ω·(ω·dt)²/24 rad per second: its error grows with t, and is as
// large as the tolerance at that time. Chords between exact steps have an error that does not grow;
// the sentence has two digits.
TEST(Growth, OfAnAdviceIsThatOfItsError) {
    const auto advice_of = [](const char* method, const Requirements& common) {
        Requirements requirements = common;
        requirements.methods = methods_of({method});
        return advise(undamped().scene, undamped().reference, requirements, clock_by_evaluations());
    };
    const Requirements requirements{.position_error = 2, .min_rate = 200};
    const Advice verlet = advice_of("velocity_verlet", requirements);
    ASSERT_TRUE(verlet.meets);
    EXPECT_EQ(verlet.growth.law, Law::linear);
    const double w = std::sqrt(15);
    const double dt = 1 / static_cast<double>(verlet.best->stepping.rate.steps);
    const double slope = 1000 * w * (w * dt) * (w * dt) / 24;  // m/s
    const double until = 2 / slope;
    EXPECT_NEAR(verlet.growth.holds_until(2), until, 0.03 * until);
    const std::vector<std::string> words =
        describe(verlet, undamped().scene, undamped().reference, requirements);
    const std::string passes = " the error grows with t and passes 2 m at about ";
    ASSERT_TRUE(
        holds(words[1],
              "It holds for the 40 s measured, also from 3 starts perturbed by 0.1 %;" + passes))
        << words[1];
    EXPECT_NEAR(std::stod(words[1].substr(words[1].find(passes) + passes.size())), until,
                0.05 * until);

    const Advice exact = advice_of("exact", requirements);
    ASSERT_TRUE(exact.meets);
    EXPECT_TRUE(std::isinf(exact.growth.holds_until(2)));
    EXPECT_TRUE(holds(describe(exact, undamped().scene, undamped().reference, requirements)[1],
                      "It holds for the 40 s measured, also from 3 starts perturbed by 0.1 %; the "
                      "error hardly grows."));
}

}  // namespace
}  // namespace oiler::test
