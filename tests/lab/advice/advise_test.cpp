// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/advise.hpp"

#include <variant>

#include "lab/measured_scenes.hpp"
#include "lab/motions.hpp"
#include "support/folder.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

// ---- exact motions, from textbooks

Vec<Real, 3> spring_truth(std::size_t, Real t) { return article_motion(0.1L)(t).x; }
Vec<Real, 3> orbit_truth(std::size_t, Real t) { return planet(0.6L, t).x; }
Vec<Real, 3> chain_truth(std::size_t row, Real t) { return chain_motion(row == 0 ? 1 : -1)(t).x; }

const std::string orbit = text_of(OILER_SOURCE "/assets/scenes/orbit.toml");
const std::string chain = text_of(OILER_SOURCE "/assets/scenes/chain.toml");

/// A tolerance, m, at the steps or as drawn.
struct Tolerance {
    double error;
    bool at_steps;
};
void PrintTo(const Tolerance& tolerance, std::ostream* out) {
    *out << tolerance.error << (tolerance.at_steps ? " m at the steps" : " m as drawn");
}

class AdviceOnPosition : public testing::TestWithParam<Tolerance> {
protected:
    static Requirements among(const std::vector<const Method*>& methods) {
        return {.position_error = GetParam().error,
                .at_steps = GetParam().at_steps,
                .methods = methods};
    }
    static void expect_within_tolerance(const std::string& text, const ExactPosition& truth,
                                        const std::vector<const Method*>& methods) {
        const Advised advised(text, among(methods));
        const Advice& advice = advised.advice;
        ASSERT_TRUE(advice.best);
        ASSERT_TRUE(advice.meets) << advice.obstacles.front();
        EXPECT_TRUE(advice.obstacles.empty());
        const int points = GetParam().at_steps ? 1 : 16;
        const auto error = [&](const TradeoffRow& row) {
            return true_error(advised.scene, row.stepping, truth, points);
        };
        const std::string words = describe(advice.best->stepping);
        EXPECT_LE(error(*advice.best), GetParam().error) << words;
        EXPECT_GE(advice.best->stepping.rate.steps, 30) << words;
        EXPECT_TRUE(std::find(methods.begin(), methods.end(), advice.best->stepping.method) !=
                    methods.end())
            << words;
        for (const TradeoffRow& tie : advice.ties)
            EXPECT_LE(error(tie), GetParam().error) << describe(tie.stepping);
        if (!advice.runner_up) return;
        EXPECT_NE(advice.runner_up->stepping.method, advice.best->stepping.method);
        EXPECT_LE(error(*advice.runner_up), GetParam().error);
    }
};

TEST_P(AdviceOnPosition, OfTheArticlesSpringIsKept) {
    expect_within_tolerance(article_spring, spring_truth, all_methods());
}
TEST_P(AdviceOnPosition, OfAnOrbitIsKept) {
    expect_within_tolerance(orbit, orbit_truth, all_methods());
}
TEST_P(AdviceOnPosition, OfAChainIsKept) {
    expect_within_tolerance(chain, chain_truth, all_methods());
}

// Positions at whole seconds, which are steps at any rate, to twenty digits.
TEST_P(AdviceOnPosition, OfADraggedProjectileIsKept) {
    for (const nlohmann::json& run : reference("projectile_quadratic_drag")) {
        if (run.at("name") != "scipython_projectile") continue;
        const auto word = [&](const char* name) { return run.at(name).get<std::string>(); };
        const std::string text =
            "[scene]\naxes = 2\nrate = 60\nduration = 6.0\n[gravity]\nacceleration = [0.0, -" +
            word("g") + "]\n[[body]]\nvelocity = [" + word("vx0") + ", " + word("vy0") +
            "]\nquadratic_drag = " + word("k_per_m") + "\n";
        const Advised advised(text, among(all_methods()));
        ASSERT_TRUE(advised.advice.meets);
        const Stepping& best = advised.advice.best->stepping;
        World world = make_world(advised.scene, Settings{best});
        for (const nlohmann::json& state : run.at("states")) {
            world.step(best.rate.steps);
            const Vec3 at = world.bodies().position(0);
            EXPECT_LE(std::hypot(at[0] - number<Real>(state.at("x")),
                                 at[1] - number<Real>(state.at("y"))),
                      GetParam().error)
                << describe(best) << " after " << state.at("t");
        }
        EXPECT_EQ(world.time(), 6);
        return;
    }
    FAIL() << "no such case";
}

INSTANTIATE_TEST_SUITE_P(AtTheSteps, AdviceOnPosition,
                         testing::Values(Tolerance{1e-1, true}, Tolerance{1e-2, true},
                                         Tolerance{1e-3, true}, Tolerance{1e-4, true},
                                         Tolerance{1e-5, true}, Tolerance{1e-6, true},
                                         Tolerance{1e-7, true}, Tolerance{1e-8, true}));
INSTANTIATE_TEST_SUITE_P(AsDrawn, AdviceOnPosition,
                         testing::Values(Tolerance{1e-1, false}, Tolerance{1e-2, false},
                                         Tolerance{1e-3, false}, Tolerance{1e-4, false}));

// Exact steps are right at any rate, and the lowest rate has the fewest. Each takes no longer than
// an evaluation of the forces; float takes as long as double, which is more accurate.
TEST(Advice, OnTheArticlesSpringIsTheExactMotion) {
    for (const double tolerance : {1e-3, 1e-6}) {
        const Advice advice = advise(
            spring().scene, spring().reference,
            {.position_error = tolerance, .at_steps = true, .methods = all_methods()},
            made_up_clock([](const Stepping& choice) {
                return choice.method->name == "exact" ? 1.0
                                                      : std::max(1, choice.method->evaluations);
            }));
        ASSERT_TRUE(advice.meets);
        EXPECT_EQ(describe(advice.best->stepping), "exact at 30 Hz in double");
        EXPECT_EQ(advice.current->stepping.method->name, "semi_implicit_euler");
    }
}

// The sweep counts the force evaluations of every setting within the tolerance; a step takes 1 ns
// for each. The advice keeps 2 % of the tolerance unused, ties within 3 % of the cost, and avoids
// settings that raise warnings.
TEST(Advice, AmongSplittingsIsOneOfTheSweepsBest) {
    SweepPlan plan{.methods = splittings(), .max_rate = 11'520};
    for (const double tolerance : {1.0, 1e-3, 1e-6}) {
        const Requirements requirements{.position_error = tolerance,
                                        .at_steps = true,
                                        .min_rate = 1,
                                        .max_rate = plan.max_rate,
                                        .methods = plan.methods};
        const Advised advised(article_spring, requirements);
        Tradeoff tradeoff = start_tradeoff(advised.scene, advised.reference, plan);
        sweep(tradeoff, advised.scene, advised.reference, plan, {});
        double fewest = INFINITY;
        for (const TradeoffRow* row : tradeoff.rows())
            if (row->judgement.stable && !(row->judgement.step_error > tolerance))
                fewest = std::min(fewest, row->judgement.evaluations);
        const Advice& advice = advised.advice;
        ASSERT_TRUE(advice.meets);
        EXPECT_LE(advice.best->judgement.evaluations, 1.1 * fewest)
            << describe(advice.best->stepping);
        EXPECT_GT(advice.runs, 0);
        EXPECT_LT(static_cast<std::size_t>(advice.runs), tradeoff.rows().size() / 2);
    }
}

// Refining ends within 1/32 of the lowest rate that meets 98 % of the tolerance.
TEST(Advice, IsTheLowestRateThatMeetsTheTolerance) {
    for (const bool at_steps : {false, true})
        for (const double tolerance : {1e-2, at_steps ? 1e-7 : 1e-4}) {
            const Requirements requirements{
                .position_error = tolerance, .at_steps = at_steps, .methods = methods_of({"rk4"})};
            const Advised advised(article_spring, requirements);
            const Advice& advice = advised.advice;
            ASSERT_TRUE(advice.meets);
            Stepping lower = advice.best->stepping;
            lower.rate.steps -= std::max<std::int64_t>(1, lower.rate.steps / 32);
            ASSERT_GE(lower.rate.steps, 30);
            EXPECT_GT(true_error(advised.scene, lower, spring_truth, at_steps ? 1 : 16),
                      0.96 * tolerance)
                << describe(advice.best->stepping);
        }
}

// ---- energy

// Without a damper ½·v² + ½·15·x² stays 7.5e6 J.
TEST(AdviceOnEnergy, IsKept) {
    for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
        const Requirements requirements{.energy_drift = tolerance, .methods = splittings()};
        const Advised advised(undamped_spring, requirements);
        const Advice& advice = advised.advice;
        ASSERT_TRUE(advice.meets);
        World world = make_world(advised.scene, Settings{advice.best->stepping});
        double most = 0;
        while (world.time() < 10) {
            world.step();
            const double x = world.bodies().position(0)[0];
            const double v = world.bodies().velocity(0)[0];
            most = std::max(most, std::abs((v * v + 15 * x * x) / 15e6 - 1));
        }
        EXPECT_LE(most, tolerance) << describe(advice.best->stepping);
        EXPECT_GT(most, 0);
        EXPECT_NEAR(advised.reference.energy_scale, 7.5e6, 0.1);
    }
}

TEST(AdviceOnEnergy, AndPositionKeepsBoth) {
    const Requirements both{.position_error = 10, .energy_drift = 1e-7, .methods = splittings()};
    const Advice advice = advice_on(article_spring, both);
    ASSERT_TRUE(advice.meets);
    EXPECT_FALSE(advice.best->judgement.position_error > 10);
    EXPECT_FALSE(advice.best->judgement.energy_drift > 1e-7);
    const Requirements position{.position_error = 10, .methods = splittings()};
    EXPECT_GT(advice_on(article_spring, position).best->judgement.energy_drift, 1e-7);
}

// ---- time

TEST(AdviceOnTime, AloneIsTheMostAccurateThatFits) {
    const Requirements requirements{
        .ns_per_second = 1e9,
        .max_rate = 800,
        .methods = methods_of({"semi_implicit_euler", "velocity_verlet"})};
    const Advice advice = advice_on(article_spring, requirements);
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "velocity_verlet");
    EXPECT_EQ(advice.best->stepping.rate.steps, 800);
    ASSERT_TRUE(advice.runner_up);
    EXPECT_EQ(advice.runner_up->stepping.method->name, "semi_implicit_euler");
}

// A millionth of a ns is less than any step takes.
TEST(AdviceOnTime, ThatNoSettingMeetsNamesTheTime) {
    for (const std::optional<double>& tolerance : {std::optional<double>(), std::optional(1e-3)}) {
        const Requirements requirements{.position_error = tolerance,
                                        .ns_per_second = 1e-6,
                                        .methods = methods_of({"velocity_verlet", "rk4"})};
        const Advice advice = advice_on(article_spring, requirements);
        EXPECT_FALSE(advice.meets);
        ASSERT_FALSE(advice.obstacles.empty());
        EXPECT_TRUE(holds(advice.obstacles.front(), "time"));
    }
}

// ---- limits of rates

// The stiff spring of a body at rest, 316.2 rad/s, is stable from 158.1 Hz on. The slow body meets
// 0.1 m at any of these rates.
TEST(Advice, KeepsFivePercentFromTheLimitOfStability) {
    const Requirements requirements{.position_error = 0.1,
                                    .methods = methods_of({"velocity_verlet"})};
    const Advice advice = advice_on(
        one_axis + "duration = 5.0\n" + on_spring(1, 1, "slow") + on_spring(0, 1e5, "stiff"),
        requirements);
    ASSERT_TRUE(advice.meets);
    EXPECT_GE(advice.best->stepping.rate.steps, 167);  // 158.1/0.95
    EXPECT_LE(advice.best->stepping.rate.steps, 175);  // the next of a bisection to 1/32
}

// Bodies at rest on springs start with up to 1e-3 m instead. At ω·dt = 1 the phase error of
// velocity Verlet, 2·asin(1/2) − 1 rad per step, reaches half a turn in 67 of 180 steps: then the
// run is on the other side, twice the amplitude away. Its amplitude is right.
TEST(Advice, OfASceneAtRestToleratesTheWrongSideOfAnOscillation) {
    std::string text = one_axis + "duration = 3.0\n";
    for (int i = 0; i < 8; ++i) text += on_spring(0, 3600, "mass " + std::to_string(i));
    const Advice advice = advice_on(
        text, {.position_error = 1e-6, .min_rate = 60, .methods = methods_of({"velocity_verlet"})});
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.rate.steps, 60);
}

TEST(Advice, StaysAboveTheLowestRate) {
    for (const std::int64_t lowest : {30, 99, 130, 250}) {
        const Requirements requirements{
            .position_error = 100, .min_rate = lowest, .methods = splittings()};
        const Advice advice = advice_on(article_spring, requirements);
        ASSERT_TRUE(advice.meets);
        EXPECT_GE(advice.best->stepping.rate.steps, lowest);
        for (const TradeoffRow& tie : advice.ties) EXPECT_GE(tie.stepping.rate.steps, lowest);
        if (advice.runner_up) {
            EXPECT_GE(advice.runner_up->stepping.rate.steps, lowest);
        }
    }
}

TEST(Advice, StaysBelowTheHighestRate) {
    const Requirements requirements{.position_error = 1, .max_rate = 200, .methods = all_methods()};
    const Advice advice = advice_on(article_spring, requirements);
    ASSERT_TRUE(advice.best);
    EXPECT_LE(advice.best->stepping.rate.steps, 200);
}

TEST(Advice, WithoutARateInBetweenIsRefused) {
    const Requirements requirements{
        .position_error = 1, .min_rate = 300, .max_rate = 200, .methods = all_methods()};
    EXPECT_TRUE(
        holds(line_of_error(Exit::usage, [&] { (void)advice_on(article_spring, requirements); }),
              "--min-rate"));
}

// Any rate meets 1000 m: one method at the lowest rate is the cheapest.
TEST(Advice, IsNotBelow30HzUnlessAsked) {
    const auto rate = [](const Requirements& requirements) {
        return advice_on(article_spring, requirements).best->stepping.rate.steps;
    };
    const auto exact = methods_of({"exact"});
    EXPECT_EQ(rate({.position_error = 1e3, .at_steps = true, .methods = exact}), 30);
    EXPECT_EQ(rate({.position_error = 1e3, .at_steps = true, .min_rate = 10, .methods = exact}),
              10);
}

TEST(Advice, IsEmptyIfStopped) {
    const Advice advice =
        advise(spring().scene, spring().reference, {.position_error = 1, .methods = splittings()},
               {.stopped = [] { return true; }});
    EXPECT_FALSE(advice.best);
    EXPECT_FALSE(advice.meets);
}

// All steps cost the same, so that rk4 and exact tie at the rate that their chords need.
TEST(Advice, NamesAMethodOnce) {
    const Requirements requirements{.position_error = 1,
                                    .methods = methods_of({"rk4", "exact", "velocity_verlet"})};
    const Advice advice =
        Advised(article_spring, requirements, made_up_clock([](const Stepping&) { return 1.0; }))
            .advice;
    ASSERT_TRUE(advice.meets);
    std::vector<const Method*> cheapest{advice.best->stepping.method};
    for (const TradeoffRow& tie : advice.ties) cheapest.push_back(tie.stepping.method);
    const auto is_cheapest = [&](const char* name) {
        return std::find(cheapest.begin(), cheapest.end(), &find_method(name)) != cheapest.end();
    };
    EXPECT_TRUE(is_cheapest("rk4"));
    EXPECT_TRUE(is_cheapest("exact"));
    for (const Alternative& alternative : advice.alternatives)
        EXPECT_FALSE(is_cheapest(std::string(alternative.method->name).c_str()))
            << alternative.method->name;
}

TEST(Advice, SaysTheConclusionFirst) {
    const Requirements requirements{.position_error = 1, .methods = all_methods()};
    Advised advised(article_spring, requirements);
    const std::vector<std::string> words = advised.words();
    EXPECT_TRUE(words.front().starts_with(describe(advised.advice.best->stepping) + ": "))
        << words.front();
    EXPECT_TRUE(holds(words.back(), "10 s"));
    EXPECT_TRUE(holds(words.back(), "between steps at any time"));
    advised.requirements.display = 60;
    EXPECT_TRUE(
        holds(advised.words().back(), "between steps at the times of 60 frames per second"));
    EXPECT_EQ(describe(Stepping{&find_method("rk4"), {60}, Precision::double_}),
              "rk4 at 60 Hz in double");
}

TEST(Advice, SaysWhatACostIs) {
    const Requirements requirements{.position_error = 1, .methods = all_methods()};
    Advised advised(article_spring, requirements);
    TradeoffRow& best = *advised.advice.best;
    best.ns_together = best.ns_per_second / 4;
    EXPECT_TRUE(holds(advised.words().back(), "one step per call"));
    EXPECT_TRUE(holds(advised.words().back(),
                      "many steps per call, as with --steps, the advice takes " +
                          describe_time(best.ns_per_second / 4) + " per simulated second."));
    best.ns_together = unknown;
    EXPECT_TRUE(holds(advised.words().back(), "one step per call. Reference"));
}

TEST(Meets, IsWithinAllTolerancesWithSomeToSpare) {
    const Requirements requirements{.position_error = 2, .energy_drift = 3};
    const Judgement both{.position_error = 2, .energy_drift = 3};
    EXPECT_TRUE(meets(both, requirements));
    EXPECT_FALSE(meets(both, requirements, 0.01));
    EXPECT_FALSE(meets({.position_error = 2.001, .energy_drift = 3}, requirements));
    EXPECT_FALSE(meets({.position_error = 2, .energy_drift = 3.001}, requirements));
    EXPECT_TRUE(meets({.position_error = unknown, .energy_drift = 1}, requirements));
    EXPECT_FALSE(meets({.stable = false}, requirements));
    const Judgement drawn{.position_error = 2.5, .step_error = 1.5};
    EXPECT_FALSE(meets(drawn, {.position_error = 2}));
    EXPECT_TRUE(meets(drawn, {.position_error = 2, .at_steps = true}));
}

}  // namespace
}  // namespace oiler::test
