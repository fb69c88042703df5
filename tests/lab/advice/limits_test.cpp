// SPDX-License-Identifier: MIT
// How far an advice holds: the growth of errors; requirements that no setting meets or that the
// reference cannot judge; and scenes whose errors were once told wrongly, because runs were sampled
// at instants that players do not see. Each of their truths is a closed form.

#include <fmt/core.h>

#include <functional>

#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/advice/growth.hpp"
#include "oiler/lab/advice/passing_time.hpp"
#include "oiler/lab/rates/budget.hpp"
#include "support/metres.hpp"
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

// velocity_verlet turns a circle of 1 m by 2·asin(ω·dt/2)/dt instead of ω: the distance is
// 2·sin(Δω·t/2). 8 times as many steps have a 64th of Δω, and samples are 1.03 s apart.
TEST(Growth, EndsWhereALongerRunPassesTheTolerance) {
    const Scene scene = parse_scene(
        "[scene]\naxes = 2\nrate = 60\nmethod = \"velocity_verlet\"\nduration = 1.0\n"
        "[[body]]\nname = \"b\"\nposition = [1.0, 0.0]\nvelocity = [0.0, 6.0]\n"
        "[[spring]]\nbody = \"b\"\nanchor = [0.0, 0.0]\nstiffness = 36.0\n",
        "test.toml");
    const double faster = 120 * std::asin(0.05) - 6;
    Growth growth{.law = Law::bounded, .until = 1, .at_steps = 1e-3};
    for (const double tolerance : {0.05, 0.2, 1.0}) {
        const double time = 2 * std::asin(tolerance / 2) / (faster * 63 / 64);
        growth.passed = passing_time(scene, scene.stepping, growth, tolerance);
        EXPECT_NEAR(growth.passed, time, 1.2) << tolerance;
        EXPECT_EQ(growth.holds_until(tolerance), growth.passed);
        growth.passed = std::numeric_limits<double>::infinity();
    }
    EXPECT_TRUE(std::isinf(passing_time(scene, scene.stepping, growth, 2.1)));
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
    static const MeasuredScene measured(one_axis + "duration = 40.0\n" + on_spring(1000, 15));
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

TEST(Advice, ThatDoesNotExistNamesTheObstacles) {
    const Requirements requirements{
        .position_error = 1e-6, .max_rate = 1000, .methods = methods_of({"explicit_euler"})};
    const Advised advised(article_spring, requirements);
    const Advice& advice = advised.advice;
    EXPECT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best);
    ASSERT_EQ(advice.obstacles.size(), 2U);
    // Floats between 512 m and 1024 m are 2⁻¹⁴ m apart.
    const std::string rounding = "in float, round-off alone moves bodies by ";
    ASSERT_TRUE(advice.obstacles[0].starts_with(rounding)) << advice.obstacles[0];
    const double moved = metres_in(advice.obstacles[0].substr(rounding.size()));
    EXPECT_LE(moved, 1.05 * std::ldexp(1, -15));
    EXPECT_GE(moved, std::ldexp(1, -16));
    EXPECT_TRUE(holds(advice.obstacles[1], "double"));
    EXPECT_TRUE(holds(advised.words().front(), "No setting meets 1e-06 m"));
}

// For a method of first order, the highest rate is the most accurate.
TEST(Advice, ThatDoesNotExistIsTheClosestSetting) {
    const Advice advice = advice_on(
        article_spring,
        {.position_error = 1e-6, .max_rate = 1000, .methods = methods_of({"semi_implicit_euler"})});
    EXPECT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best);
    EXPECT_EQ(advice.best->stepping.rate.steps, 960);
}

TEST(Advice, OnEnergyThatDoesNotExistNamesEnergy) {
    const Advice advice = advice_on(
        article_spring,
        {.energy_drift = 1e-9, .max_rate = 1000, .methods = methods_of({"semi_implicit_euler"})});
    EXPECT_FALSE(advice.meets);
    ASSERT_FALSE(advice.obstacles.empty());
    EXPECT_TRUE(holds(advice.obstacles.front(), "energy"));
}

void expect_refused(const MeasuredScene& measured, const Requirements& requirements,
                    const std::string& named) {
    const std::string line = line_of_error(Exit::usage, [&] {
        (void)advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
    });
    EXPECT_TRUE(holds(line, "expected at least"));
    EXPECT_TRUE(holds(line, named));
    EXPECT_FALSE(holds(line, "--duration 0"));
    EXPECT_FALSE(holds(line, "\n"));
}

TEST(Advice, BelowTheFloorIsRefused) {
    expect_refused(spring(), {.position_error = 1e-14, .methods = all_methods()}, "1e-14 m");
    expect_refused(spring(), {.energy_drift = 1e-15, .methods = all_methods()}, "1e-15");
}

// A reference that misses its wanted error blames the tolerance, not the scene.
TEST(Advice, BelowTheFloorOfAReferenceMadeForItIsRefused) {
    const Requirements requirements{.position_error = 1e-14, .methods = all_methods()};
    expect_refused(measured_for(article_spring, requirements), requirements, "1e-14");
}

/// A double pendulum of stiff springs, started upright: chaotic.
std::string double_pendulum(const std::string& duration) {
    return "[scene]\naxes = 2\nrate = 100\nduration = " + duration +
           "\n[gravity]\nacceleration = [0.0, -9.81]\n"
           "[[body]]\nname = \"a\"\nposition = [0.0, 1.0]\n"
           "[[body]]\nname = \"b\"\nposition = [0.1, 2.0]\n"
           "[[spring]]\nbody = \"a\"\nanchor = [0.0, 0.0]\nstiffness = 500.0\nrest_length = 1.0\n"
           "[[spring]]\nbody = \"b\"\nto = \"a\"\nstiffness = 500.0\nrest_length = 1.0\n";
}

TEST(Advice, OnAChaoticSceneIsRefusedAndTheRemedyHelps) {
    const Requirements requirements{.position_error = 1e-3,
                                    .methods = methods_of({"rk4", "kahan_li8_kdk"})};
    const ReferenceEffort effort{.wanted = required_reference_error(requirements) / 2,
                                 .most_work = 2e7};
    const MeasuredScene measured(double_pendulum("60.0"), effort);
    ASSERT_FALSE(measured.reference.why_no_longer.empty());
    const std::string line = line_of_error(Exit::usage, [&] {
        (void)advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
    });
    const std::string remedy = "ask for ";
    ASSERT_TRUE(holds(line, remedy));
    const std::string rest = line.substr(line.find(remedy) + remedy.size());
    const std::string duration = rest.substr(0, rest.find(' '));
    EXPECT_GT(std::stod(duration), 1) << line;
    const MeasuredScene shorter(double_pendulum(holds(duration, ".") ? duration : duration + ".0"),
                                effort);
    EXPECT_NO_THROW(
        (void)advise(shorter.scene, shorter.reference, requirements, clock_by_evaluations()))
        << duration;
}

// Runs that exceed 20 times the tolerance end early; those that are named do not.
TEST(Advice, ThatMeetsNothingNamesTheClosest) {
    const Requirements requirements{
        .position_error = 1e-6,
        .max_rate = 2000,
        .methods = methods_of({"semi_implicit_euler", "velocity_verlet", "ruth3"})};
    const Advised advised(article_spring, requirements);
    const Advice& advice = advised.advice;
    ASSERT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best && advice.runner_up);
    const auto error_of = [&](const Stepping& choice) {
        return judge(advised.scene, Settings{choice}, advised.reference).position_error;
    };
    for (const TradeoffRow& row : {*advice.best, *advice.runner_up}) {
        EXPECT_TRUE(row.judgement.complete);
        EXPECT_EQ(row.judgement.position_error, error_of(row.stepping));
    }
    for (const Method* method : requirements.methods)
        EXPECT_LE(advice.best->judgement.position_error,
                  error_of({method, {1920}, Precision::double_}))
            << method->name;
}

// explicit_euler and ruth3 need more than 10⁴ steps for 1e-6 m, and a step of one body counts as
// some 300 evaluations: this limit is reached before. The closest of what was tried is told as
// that.
TEST(Advice, EndsAtItsLimitOfWork) {
    const Requirements requirements{.position_error = 1e-6,
                                    .at_steps = true,
                                    .methods = methods_of({"explicit_euler", "ruth3"}),
                                    .most_search_work = 1e7};
    const Advised advised(article_spring, requirements);
    const Advice& advice = advised.advice;
    EXPECT_TRUE(advice.ended_early);
    EXPECT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best);
    EXPECT_TRUE(advice.best->judgement.complete);
    EXPECT_TRUE(
        holds(advised.words().front(), "No setting that was tried meets 1e-06 m. Closest:"));
    EXPECT_TRUE(holds(advice.obstacles.back(), "work"));
    Requirements enough = requirements;
    enough.most_search_work = 2e10;
    const Advice whole = Advised(article_spring, enough).advice;
    EXPECT_FALSE(whole.ended_early);
    EXPECT_TRUE(whole.meets);
    EXPECT_GT(whole.runs, advice.runs);
}

constexpr double pi = std::numbers::pi;

std::string spring(const std::string& name, double omega, double amplitude) {
    return on_spring(amplitude, omega * omega, name);
}
/// The motion of such a spring, from rest.
Vec<Real, 3> oscillation(double omega, double amplitude, Real t) {
    return {amplitude * std::cos(omega * t)};
}

std::string scene_of(double duration, std::int64_t rate, const std::string& bodies,
                     const std::string& method = "velocity_verlet") {
    return fmt::format("[scene]\naxes = 1\nrate = {}\nduration = {:g}\nmethod = \"{}\"\n{}", rate,
                       duration, method, bodies);
}

Advice advice_of(const MeasuredScene& measured, double tolerance,
                 const std::vector<const char*>& methods) {
    return advise(measured.scene, measured.reference,
                  {.position_error = tolerance, .methods = methods_of(methods)},
                  clock_by_evaluations());
}

// A spring of 60 Hz at one step per second: every step is at the crest, 2 m above the trough.
TEST(SeenErrors, OfAFastSpringAtOneStepPerPeriod) {
    MeasuredScene measured(scene_of(3, 1, spring("a", 120 * pi, 1), "exact"));
    EXPECT_NEAR(measured.reference.extent, 2, 1e-3);
    measured.scene.budget.position_error = 1e-3;
    const auto lines = check_budget(measured.scene, Settings{measured.scene.stepping});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_FALSE(lines[0].kept);
    EXPECT_NEAR(lines[0].measured, 2, 0.03);
}

// A spring of 30 Hz: samples at 60 per second fall on its turning points alone.
TEST(SeenErrors, OfASpringAtHalfTheSamplingRate) {
    const MeasuredScene measured(scene_of(3, 60, spring("a", 60 * pi, 1)));
    const Advice advice = advice_of(measured, 1e-3, {"velocity_verlet", "mclachlan_atela4"});
    ASSERT_TRUE(advice.meets);
    const double seen = true_error(
        measured.scene, advice.best->stepping,
        [](std::size_t, Real t) { return oscillation(60 * pi, 1, t); }, 64);
    EXPECT_LE(seen, 1e-3);
    EXPECT_NEAR(advice.best->judgement.position_error, seen, 0.02 * seen);
    // Its phase error ω·t·(ω·dt)²/24 is 1e-2 at 6,600 Hz: it can.
    const Advice verlet = advice_of(measured, 1e-2, {"velocity_verlet"});
    ASSERT_TRUE(verlet.meets);
    const auto rate = static_cast<double>(verlet.best->stepping.rate.steps);
    const double phase = 60 * pi * 3 * std::pow(60 * pi / rate, 2) / 24;
    EXPECT_NEAR(verlet.best->judgement.step_error, phase, 0.05 * phase);
}

// The transient of a stiff damper is over within 1/60 s; rk4 at 4800 Hz has ω·dt of 2.1 there.
TEST(SeenErrors, OfATransient) {
    const MeasuredScene measured(
        scene_of(0.5, 4800, spring("a", 1000, 1) + "damping = 10000.0\n", "rk4"));
    const double error =
        judge(measured.scene, Settings{measured.scene.stepping}, measured.reference).step_error;
    // From rest, λ = 5000 ± √(5000² − 10⁶): x = (λ₁e^(−λ₂t) − λ₂e^(−λ₁t))/(λ₁ − λ₂); rk4 multiplies
    // each part by the series of e^z of degree 4.
    const double fast = 5000 + std::sqrt(24e6);
    const double slow = 1e6 / fast;
    const auto series = [](double z) {
        return 1 + z + z * z / 2 + z * z * z / 6 + z * z * z * z / 24;
    };
    double most = 0;
    for (int n = 0; n <= 2400; ++n) {
        const double t = n / 4800.0;
        const auto part = [&](double rate) {
            return std::pow(series(-rate / 4800), n) - std::exp(-rate * t);
        };
        most = std::max(most, std::abs(fast * part(slow) - slow * part(fast)) / (fast - slow));
    }
    EXPECT_NEAR(error, most, 1e-6 * most);
    EXPECT_GT(most, 1e-3);
}

// 100 m slowly beside 2 m at 60 Hz.
TEST(SeenErrors, OfAFastBodyBesideASlowOne) {
    const MeasuredScene measured(
        scene_of(5, 60, spring("slow", 0.3, 100) + spring("fast", 120 * pi, 2)));
    const Advice advice = advice_of(measured, 0.05, {"exact", "rk4"});
    ASSERT_TRUE(advice.meets);
    const auto truth = [](std::size_t row, Real t) {
        return row == 0 ? oscillation(0.3, 100, t) : oscillation(120 * pi, 2, t);
    };
    EXPECT_LE(true_error(measured.scene, advice.best->stepping, truth, 64), 0.05);
}

// The chord of g·dt²/8 is the same for one body and for many.
TEST(SeenErrors, OfManyBodiesAreThoseOfOne) {
    for (const int bodies : {1, 5000}) {
        const MeasuredScene measured(fmt::format(
            "[scene]\naxes = 2\nrate = 60\nduration = 4.0\n[gravity]\nacceleration = [0.0, "
            "-9.81]\n[[scatter]]\ncount = {}\nseed = 1\nposition_from = [0.0, 0.0]\nposition_to = "
            "[1.0, 1.0]\nvelocity_from = [-9.0, 0.0]\nvelocity_to = [9.0, 20.0]\n",
            bodies));
        const Judgement judgement =
            judge(measured.scene, Settings{{&find_method("exact"), {1}, Precision::double_}},
                  measured.reference);
        EXPECT_NEAR(judgement.position_error, 9.81 / 8, 1e-3) << bodies;
    }
}

// A critically damped spring: methods whose backward drifts overflow are left out, the others are
// compared.
TEST(SeenErrors, OfACriticallyDampedSpringAreCompared) {
    const MeasuredScene measured(scene_of(2, 60, spring("camera", 50, 1) + "damping = 100.0\n"));
    std::vector<const char*> all{"velocity_verlet", "rk4", "yoshida8d_kdk", "mclachlan6_s9_kdk"};
    EXPECT_TRUE(advice_of(measured, 1e-2, all).meets);
}

// At rest on its spring, 100 rad/s: at 30 Hz ω·dt is 3.3. Nothing moves, but a touch would explode.
TEST(SeenErrors, OfASceneAtRestAreThoseAfterATouch) {
    const MeasuredScene measured(
        scene_of(5, 60, "[gravity]\nacceleration = [-10.0]\n" + spring("a", 100, -0.001)));
    const Advice advice = advice_of(measured, 1e-3, {"explicit_euler", "velocity_verlet"});
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "velocity_verlet");
    EXPECT_GE(advice.best->stepping.rate.steps, 50);
}

// Nobody plays a jump at 6 Hz.
TEST(SeenErrors, OfAJumpAreJudgedAtThirtyHertzOrMore) {
    const MeasuredScene measured(
        "[scene]\naxes = 1\nrate = 60\nduration = 1.2\n[gravity]\nacceleration = "
        "[-20.0]\n[[body]]\nvelocity = [9.0]\n");
    EXPECT_GE(advice_of(measured, 0.1, {"velocity_verlet"}).best->stepping.rate.steps, 30);
}

}  // namespace
}  // namespace oiler::test
