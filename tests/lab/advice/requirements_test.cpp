// SPDX-License-Identifier: MIT
// Advice for errors at the steps, as drawn and on a display; ties; damping.
#include <fmt/core.h>

#include <functional>

#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Every step takes 1 ns.
SweepWatch equal_costs() {
    return made_up_clock([](const Stepping&) { return 1.0; });
}

std::int64_t rate_for(const MeasuredScene& measured, const Requirements& requirements) {
    const Advice advice = advise(measured.scene, measured.reference, requirements, equal_costs());
    EXPECT_TRUE(advice.meets);
    return advice.best->stepping.rate.steps;
}

// ---- at the steps, as drawn, on a display

/// The rate at which chords deviate from 1000 m·cos(ωt) by 98 % of the tolerance, which the advice
/// uses at most: A(1 − cos(ω·dt/2)).
double rate_of_chords(double tolerance) {
    return std::sqrt(15.0) / (2 * std::acos(1 - 0.98 * tolerance / 1000));
}

// Exact steps meet any tolerance at the lowest rate. Their chords do not. Refining ends within
// 1/32.
TEST(Requirements, AtTheStepsAllowsLowerRatesThanAsDrawn) {
    for (const double tolerance : {0.1, 0.01}) {
        const auto exact = methods_of({"exact"});
        EXPECT_EQ(
            rate_for(spring(), {.position_error = tolerance, .at_steps = true, .methods = exact}),
            30);
        const auto drawn = static_cast<double>(
            rate_for(spring(), {.position_error = tolerance, .methods = exact}));
        const double expected = rate_of_chords(tolerance);
        EXPECT_GE(drawn, 0.98 * expected) << tolerance;
        EXPECT_LE(drawn, (1 + 1.0 / 32) * 1.02 * expected) << tolerance;
    }
}

// Steps at 60 Hz are frames of a display of 60 Hz: there exact steps are right, and what their
// chords miss in between is not shown. A display of 240 Hz shows it.
TEST(Requirements, OnADisplayMissTheTimeBetweenItsFrames) {
    const Requirements requirements{
        .position_error = 0.01, .display = 60, .min_rate = 60, .methods = methods_of({"exact"})};
    EXPECT_EQ(rate_for(spring(), requirements), 60);
    Requirements faster = requirements;
    faster.display = 240;
    EXPECT_GT(rate_for(spring(), faster), 60);
    faster.display = 0;
    EXPECT_GT(rate_for(spring(), faster), 60);
}

// A fall: the chords of exact steps deviate by g·dt²/8 at any time, half way between steps. A
// display of twice the rate shows just that time.
TEST(Requirements, OfAFallAreThoseOfItsParabola) {
    const MeasuredScene fall(
        "[scene]\naxes = 1\nrate = 60\nduration = 2.0\n[gravity]\nacceleration = [-9.81]\n"
        "[[body]]\nname = \"mass\"\n");
    const double deviation = 9.81 / 8 / 60 / 60;
    for (const std::int64_t display : {0, 120}) {
        Requirements requirements{.position_error = deviation / 0.97,
                                  .display = display,
                                  .min_rate = 60,
                                  .methods = methods_of({"exact"})};
        EXPECT_EQ(rate_for(fall, requirements), 60) << display;
        requirements.position_error = deviation / 1.01;
        EXPECT_GT(rate_for(fall, requirements), 60) << display;
    }
}

// A setting whose first step ends after the run is not judged at any step.
TEST(Requirements, OfAShortRunHaveASettingWithAStep) {
    const MeasuredScene brief(one_axis + "duration = 0.002\n" + on_spring(1, 15));
    const Requirements requirements{.position_error = 1,
                                    .methods = methods_of({"exact", "velocity_verlet"})};
    EXPECT_GE(rate_for(brief, requirements), 500);
}

// ---- threads

/// Projectiles whose steps cost 100 ns on one thread and `on_all` ns on all cores.
Advice advice_of_many(int bodies, double on_all) {
    const MeasuredScene many(fmt::format(
        "[scene]\naxes = 1\nduration = 1.0\n[gravity]\nacceleration = [-9.81]\n[[scatter]]\n"
        "count = {}\nseed = 1\nposition_from = [0.0]\nposition_to = [1.0]\nvelocity_from = [0.0]\n"
        "velocity_to = [9.0]\n",
        bodies));
    SweepWatch watch = made_up_clock([](const Stepping&) { return 100.0; });
    watch.ns_of_frames = [=](const Scene&, const Settings& settings, const auto&) {
        if (settings.threads == 1) return std::vector{100.0};
        return std::vector{settings.threads == this_machine().cores ? on_all : unknown};
    };
    return advise(many.scene, many.reference,
                  {.position_error = 1, .methods = methods_of({"velocity_verlet"})}, watch);
}

TEST(Threads, AreNamedIfTheyCostLess) {
    if (this_machine().cores < 2) GTEST_SKIP() << "one core";
    const Advice faster = advice_of_many(3000, 60);
    EXPECT_EQ(faster.threads, this_machine().cores);
    EXPECT_NEAR(faster.ns_on_threads / faster.best->ns_per_second, 0.6, 1e-9);
    EXPECT_EQ(advice_of_many(3000, 97).threads, 1);
    EXPECT_EQ(advice_of_many(3000, 150).threads, 1);
    EXPECT_EQ(advice_of_many(20, 60).threads, 1);
}

// ---- ties

TradeoffRow costing(double ns, double spread) {
    return {.stepping = {&find_method("rk4"), {60}, Precision::double_},
            .ns_per_second = ns,
            .ns_spread = spread};
}

TEST(IsTie, IsWithinTheSpreadsOrEightPercent) {
    EXPECT_TRUE(is_tie(costing(100, 5), costing(114, 10)));
    EXPECT_FALSE(is_tie(costing(100, 5), costing(116, 10)));
    EXPECT_TRUE(is_tie(costing(116, 10), costing(102, 5)));
    EXPECT_TRUE(is_tie(costing(100, 0), costing(107.9, 0)));
    EXPECT_FALSE(is_tie(costing(100, 0), costing(108.1, 0)));
}

/// The advice for 5 m at the steps of at least 120 Hz, where each of these methods meets it.
Advice advice_among(const std::vector<const char*>& names, const SweepWatch& watch) {
    return advise(
        spring().scene, spring().reference,
        {.position_error = 5, .at_steps = true, .min_rate = 120, .methods = methods_of(names)},
        watch);
}

/// A clock whose readings go around so that the interquartile range of a row's nine times is about
/// `spread` of the time.
SweepWatch noisy(double spread, const std::function<double(const Stepping&)>& ns) {
    SweepWatch watch = made_up_clock(ns);
    auto reading = std::make_shared<int>(0);
    watch.ns_of_frames = [=](const Scene&, const Settings& settings, const auto&) {
        return std::vector{ns(settings.stepping) * (1 + spread * ((*reading)++ % 7 - 3) / 3)};
    };
    return watch;
}

bool is_among(const std::vector<TradeoffRow>& rows, const char* method) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const TradeoffRow& row) { return row.stepping.method->name == method; });
}

// Velocity Verlet has an error of 1 m, rk4 of a millimetre. It is 2 % cheaper, which no measurement
// tells apart, or 10 %, which it does unless times scatter by more.
TEST(Ties, GoToTheMostAccurate) {
    const auto cheaper_by = [](double share) {
        return [=](const Stepping& choice) {
            return choice.method->name == "velocity_verlet" ? 100 * (1 - share) : 100.0;
        };
    };
    const std::vector<const char*> names{"velocity_verlet", "rk4"};
    const Advice tie = advice_among(names, made_up_clock(cheaper_by(0.02)));
    ASSERT_TRUE(tie.meets);
    EXPECT_EQ(tie.best->stepping.method->name, "rk4");
    EXPECT_TRUE(is_among(tie.ties, "velocity_verlet"));
    EXPECT_FALSE(tie.runner_up);

    const Advice cheapest = advice_among(names, made_up_clock(cheaper_by(0.1)));
    EXPECT_EQ(cheapest.best->stepping.method->name, "velocity_verlet");
    EXPECT_FALSE(is_among(cheapest.ties, "rk4"));
    ASSERT_TRUE(cheapest.runner_up);
    EXPECT_EQ(cheapest.runner_up->stepping.method->name, "rk4");

    const Advice scattered = advice_among(names, noisy(0.3, cheaper_by(0.1)));
    EXPECT_EQ(scattered.best->stepping.method->name, "rk4");
    EXPECT_TRUE(is_among(scattered.ties, "velocity_verlet"));
}

// Errors of 0.01 mm and less are equal beside 5 m: of methods at one rate, the first of methods()
// wins, in whatever order they are asked for.
TEST(Ties, OfEqualErrorsGoToTheFirstMethod) {
    const Advice one = advice_among({"rk4", "rk4_38", "exact"}, equal_costs());
    const Advice other = advice_among({"exact", "rk4_38", "rk4"}, equal_costs());
    ASSERT_TRUE(one.meets);
    EXPECT_EQ(one.best->stepping, other.best->stepping);
    for (const TradeoffRow& tie : one.ties)
        EXPECT_LE(one.best->stepping.method, tie.stepping.method);
}

// ω = 200 rad/s: velocity Verlet is stable from 100 Hz on, exact motion at any rate. Errors of at
// most 2 m are equal beside 1000 m, and all settings take as long: the higher rate shows input
// earlier.
TEST(Ties, OfEqualErrorsGoToTheHigherRate) {
    const MeasuredScene stiff(one_axis + "duration = 2.0\n" + on_spring(1, 40'000));
    SweepWatch watch = made_up_clock(
        [](const Stepping& choice) { return 6000.0 / static_cast<double>(choice.rate.steps); });
    watch.ns_per_step = [](const auto&, const Stepping& choice, std::int64_t) {
        return choice.method->name == "exact" ? 0.4 : 0.1;
    };
    for (const auto& names : {std::vector<const char*>{"exact", "velocity_verlet"},
                              std::vector<const char*>{"velocity_verlet", "exact"}}) {
        const Advice advice = advise(stiff.scene, stiff.reference,
                                     {.position_error = 1000, .methods = methods_of(names)}, watch);
        ASSERT_TRUE(advice.meets);
        EXPECT_EQ(advice.best->stepping.method->name, "velocity_verlet");
        EXPECT_GE(advice.best->stepping.rate.steps, 100);
        EXPECT_TRUE(is_among(advice.ties, "exact"));
    }
}

// ---- disturbed estimates

// Another program delays the only estimate of a single step of semi-implicit Euler. Its further
// steps are not free for that: blanes_moan_srkn11b needs some 60 Hz for 1 m, Euler thousands.
TEST(DisturbedEstimates, MakeNoStepFree) {
    SweepWatch watch = clock_by_evaluations();
    watch.ns_per_step = [](const auto&, const Stepping& choice, std::int64_t per_frame) {
        const bool is_delayed = choice.method->order == 1 && per_frame == 1;
        return is_delayed && choice.rate.steps > 60 ? 100.0 : 1.0 * choice.method->evaluations;
    };
    const Requirements requirements{
        .position_error = 1,
        .at_steps = true,
        .max_rate = 1'000'000,
        .methods = methods_of({"semi_implicit_euler", "blanes_moan_srkn11b"})};
    const Advice advice = advise(spring().scene, spring().reference, requirements, watch);
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "blanes_moan_srkn11b");
}

// ---- negligible costs

/// The advice of these methods for 5 m at the steps, where costs up to `negligible` do not decide.
Advice advice_on_spring(double negligible, const SweepWatch& watch,
                        const std::vector<const char*>& names, std::int64_t max_rate = 10'000) {
    return advise(spring().scene, spring().reference,
                  {.position_error = 5,
                   .at_steps = true,
                   .max_rate = max_rate,
                   .methods = methods_of(names),
                   .negligible_ns_per_second = negligible},
                  watch);
}

// Exact steps meet any tolerance at 30 Hz. The scene has 100 Hz: input shows after 10 ms, not 33
// ms.
TEST(NegligibleCosts, LeaveTheScenesOwnRate) {
    const SweepWatch watch = made_up_clock([](const Stepping&) { return 10.0; });
    const Advice prompt = advice_on_spring(1e7, watch, {"exact"});
    ASSERT_TRUE(prompt.meets);
    EXPECT_EQ(prompt.best->stepping.rate.steps, 100);
    ASSERT_TRUE(prompt.cheapest);
    EXPECT_EQ(prompt.cheapest->stepping.rate.steps, 30);
    EXPECT_EQ(advice_on_spring(1e7, watch, {"exact"}, 50).best->stepping.rate.steps, 50);
    // 100 Hz cost 1000 ns per second.
    EXPECT_EQ(advice_on_spring(1001, watch, {"exact"}).best->stepping.rate.steps, 100);
    const Advice cheapest = advice_on_spring(999, watch, {"exact"});
    EXPECT_EQ(cheapest.best->stepping.rate.steps, 30);
    EXPECT_FALSE(cheapest.cheapest);
}

// At 100 Hz, velocity Verlet has an error of 1.5 m and costs half of rk4, whose error is 1 mm.
TEST(NegligibleCosts, LeaveTheMostAccurate) {
    const SweepWatch watch = made_up_clock([](const Stepping& choice) {
        return choice.method->name == "velocity_verlet" ? 50.0 : 100.0;
    });
    const std::vector<const char*> names{"velocity_verlet", "rk4"};
    const Advice accurate = advice_on_spring(1e7, watch, names);
    ASSERT_TRUE(accurate.meets);
    EXPECT_EQ(accurate.best->stepping.method->name, "rk4");
    EXPECT_GE(accurate.best->stepping.rate.steps, 100);
}

// ---- damping

// A thrown body with drag: x = (v₀/b)·(1 − e^(−b·t)). With damping in the drifts, semi-implicit
// Euler is exact at the steps; its own choice, in the kicks, has an error of (v₀/b)·b·dt/(2·e),
// 0.06 m at 30 Hz.
TEST(Damping, IsChosenWhereItIsMoreAccurate) {
    const MeasuredScene dragged(one_axis + "duration = 4.0\n[[body]]\nname = \"mass\"\n" +
                                "velocity = [10.0]\nlinear_drag = 1.0\n");
    const Method& euler = find_method("semi_implicit_euler");
    ASSERT_EQ(euler.damping, Damping::in_kick);
    const Advice advice =
        advise(dragged.scene, dragged.reference,
               {.position_error = 1e-4, .at_steps = true, .methods = {&euler}}, equal_costs());
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.damping, Damping::in_drift);
    EXPECT_EQ(advice.best->stepping.rate.steps, 30);
    World world = make_world(dragged.scene, Settings{advice.best->stepping});
    world.step(120);
    EXPECT_NEAR(world.bodies().position(0)[0], 10 * (1 - std::exp(-4)), 1e-4);
}

TEST(Damping, OfAConservativeSceneIsNoChoice) {
    const MeasuredScene undamped(undamped_spring);
    const Advice advice =
        advise(undamped.scene, undamped.reference,
               {.position_error = 5, .at_steps = true, .methods = methods_of({"velocity_verlet"})},
               equal_costs());
    ASSERT_TRUE(advice.meets);
    EXPECT_FALSE(advice.best->stepping.damping);
    for (const TradeoffRow& tie : advice.ties) EXPECT_FALSE(tie.stepping.damping);
}

TEST(Damping, IsNamed) {
    EXPECT_EQ(describe(Stepping{&find_method("rk4"), {60}, Precision::double_, Damping::in_drift}),
              "rk4 at 60 Hz in double, damping in the drift");
}

}  // namespace
}  // namespace oiler::test
