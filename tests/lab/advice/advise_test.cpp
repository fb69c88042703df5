// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/advise.hpp"

#include <variant>

#include "lab/advice/advice_on.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/folder.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

// ---- exact motions, from textbooks

/// The exact position of a body at time t.
using Truth = std::function<Vec<Real, 2>(std::size_t row, Real t)>;

/// x = A·e^(−b·t/2)·(cos ωt + b/(2ω)·sin ωt), ω² = k − b²/4
Vec<Real, 2> spring_truth(std::size_t, Real t) {
    constexpr Real b = 0.1L;
    const Real w = std::sqrt(15 - b * b / 4);
    return {1000 * std::exp(-b / 2 * t) * (std::cos(w * t) + b / (2 * w) * std::sin(w * t)), 0};
}

/// Kepler's equation M = E − e·sin E by bisection: gm = a = 1, e = 0.6, from the perihelion.
Vec<Real, 2> orbit_truth(std::size_t, Real t) {
    constexpr Real e = 0.6L;
    Real low = t - 1;
    Real high = t + 1;
    for (int i = 0; i < 80; ++i) {
        const Real middle = (low + high) / 2;
        (middle - e * std::sin(middle) < t ? low : high) = middle;
    }
    return {std::cos(low) - e, std::sqrt(1 - e * e) * std::sin(low)};
}

/// Two masses of 1 kg, springs of 15, 1.5 and 15 N/m: the modes have √15 rad/s in phase and √18
/// rad/s in antiphase. The left mass starts 1 m from its rest at −2 m.
Vec<Real, 2> chain_truth(std::size_t row, Real t) {
    const Real together = std::cos(std::sqrt(Real(15)) * t) / 2;
    const Real apart = std::cos(std::sqrt(Real(18)) * t) / 2;
    return row == 0 ? Vec<Real, 2>{-2 + together + apart, 0}
                    : Vec<Real, 2>{2 + together - apart, 0};
}

/// The largest distance from the truth at any step of the scene and, with points, at so many times
/// on the straight line of each step.
double error_of(const Scene& scene, const Stepping& choice, const Truth& truth, int points = 1) {
    World world = make_world(scene, Settings{choice});
    const auto rate = static_cast<Real>(choice.rate.steps);
    const Real end = scene.duration;
    Real most = 0;
    for (std::int64_t tick = 0; static_cast<Real>(tick) / rate < end; ++tick) {
        std::vector<Vec3> before;
        for (std::size_t row = 0; row < world.bodies().size(); ++row)
            before.push_back(world.bodies().position(row));
        world.step();
        for (int point = 1; point <= points; ++point) {
            const Real share = static_cast<Real>(point) / points;
            const Real t = (static_cast<Real>(tick) + share) / rate;
            if (t > end) break;
            for (std::size_t row = 0; row < before.size(); ++row) {
                const Vec3 after = world.bodies().position(row);
                const Vec<Real, 2> right = truth(row, t);
                Real squares = 0;
                for (int axis = 0; axis < 2; ++axis) {
                    const Real from = before[row][axis];
                    const Real off = from + share * (after[axis] - from) - right[axis];
                    squares += off * off;
                }
                most = std::max(most, std::sqrt(squares));
            }
        }
    }
    return static_cast<double>(most);
}

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
    static void expect_within_tolerance(const std::string& text, const Truth& truth,
                                        const std::vector<const Method*>& methods) {
        const Requirements requirements = among(methods);
        const MeasuredScene measured = measured_for(text, requirements);
        const Advice advice =
            advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
        ASSERT_TRUE(advice.best);
        ASSERT_TRUE(advice.meets) << advice.obstacles.front();
        EXPECT_TRUE(advice.obstacles.empty());
        const int points = GetParam().at_steps ? 1 : 16;
        const auto error = [&](const TradeoffRow& row) {
            return error_of(measured.scene, row.stepping, truth, points);
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
        const Requirements requirements = among(all_methods());
        const MeasuredScene measured = measured_for(text, requirements);
        const Advice advice =
            advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
        ASSERT_TRUE(advice.meets);
        World world = make_world(measured.scene, Settings{advice.best->stepping});
        for (const nlohmann::json& state : run.at("states")) {
            world.step(advice.best->stepping.rate.steps);
            const Vec3 at = world.bodies().position(0);
            EXPECT_LE(std::hypot(at[0] - number<Real>(state.at("x")),
                                 at[1] - number<Real>(state.at("y"))),
                      GetParam().error)
                << describe(advice.best->stepping) << " after " << state.at("t");
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
    const MeasuredScene measured(article_spring);
    for (const double tolerance : {1e-3, 1e-6}) {
        const Advice advice = advise(
            measured.scene, measured.reference,
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
        const MeasuredScene measured = measured_for(article_spring, requirements);
        Tradeoff tradeoff = start_tradeoff(measured.scene, measured.reference, plan);
        sweep(tradeoff, measured.scene, measured.reference, plan, {});
        double fewest = INFINITY;
        for (const TradeoffRow* row : tradeoff.rows())
            if (row->judgement.stable && !(row->judgement.step_error > tolerance))
                fewest = std::min(fewest, row->judgement.evaluations);
        const Advice advice =
            advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
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
            const MeasuredScene measured = measured_for(article_spring, requirements);
            const Advice advice =
                advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
            ASSERT_TRUE(advice.meets);
            Stepping lower = advice.best->stepping;
            lower.rate.steps -= std::max<std::int64_t>(1, lower.rate.steps / 32);
            ASSERT_GE(lower.rate.steps, 30);
            EXPECT_GT(error_of(measured.scene, lower, spring_truth, at_steps ? 1 : 16),
                      0.96 * tolerance)
                << describe(advice.best->stepping);
        }
}

// ---- energy

// Without a damper ½·v² + ½·15·x² stays 7.5e6 J.
TEST(AdviceOnEnergy, IsKept) {
    const std::string undamped =
        one_axis +
        "duration = 10.0\n[[body]]\nname = \"mass\"\nposition = [1000.0]\n[[spring]]\n"
        "body = \"mass\"\nanchor = [0.0]\nstiffness = 15.0\n";
    for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
        const Requirements requirements{.energy_drift = tolerance, .methods = splittings()};
        const MeasuredScene measured = measured_for(undamped, requirements);
        const Advice advice =
            advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
        ASSERT_TRUE(advice.meets);
        World world = make_world(measured.scene, Settings{advice.best->stepping});
        double most = 0;
        while (world.time() < 10) {
            world.step();
            const double x = world.bodies().position(0)[0];
            const double v = world.bodies().velocity(0)[0];
            most = std::max(most, std::abs((v * v + 15 * x * x) / 15e6 - 1));
        }
        EXPECT_LE(most, tolerance) << describe(advice.best->stepping);
        EXPECT_GT(most, 0);
        EXPECT_NEAR(measured.reference.energy_scale, 7.5e6, 0.1);
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
        one_axis + "duration = 5.0\n[[body]]\nname = \"slow\"\nposition = [1.0]\n[[spring]]\n" +
            "body = \"slow\"\nanchor = [0.0]\nstiffness = 1.0\n[[body]]\nname = \"stiff\"\n" +
            "[[spring]]\nbody = \"stiff\"\nanchor = [0.0]\nstiffness = 100000.0\n",
        requirements);
    ASSERT_TRUE(advice.meets);
    EXPECT_GE(advice.best->stepping.rate.steps, 167);  // 158.1/0.95
    EXPECT_LE(advice.best->stepping.rate.steps, 175);  // the next of a bisection to 1/32
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
    const MeasuredScene measured(article_spring);
    const Advice advice =
        advise(measured.scene, measured.reference, {.position_error = 1, .methods = splittings()},
               {.stopped = [] { return true; }});
    EXPECT_FALSE(advice.best);
    EXPECT_FALSE(advice.meets);
}

// All steps cost the same, so that rk4 and exact tie at the rate that their chords need.
TEST(Advice, NamesAMethodOnce) {
    const Requirements requirements{.position_error = 1,
                                    .methods = methods_of({"rk4", "exact", "velocity_verlet"})};
    const MeasuredScene measured = measured_for(article_spring, requirements);
    const Advice advice = advise(measured.scene, measured.reference, requirements,
                                 made_up_clock([](const Stepping&) { return 1.0; }));
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
    const MeasuredScene measured = measured_for(article_spring, requirements);
    const Advice advice =
        advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
    const std::vector<std::string> words =
        describe(advice, measured.scene, measured.reference, requirements);
    EXPECT_TRUE(words.front().starts_with(describe(advice.best->stepping) + ": ")) << words.front();
    EXPECT_TRUE(holds(words.back(), "10 s"));
    EXPECT_TRUE(holds(words.back(), "between steps at any time"));
    Requirements displayed = requirements;
    displayed.display = 60;
    EXPECT_TRUE(holds(describe(advice, measured.scene, measured.reference, displayed).back(),
                      "between steps at the times of 60 frames per second"));
    EXPECT_EQ(describe(Stepping{&find_method("rk4"), {60}, Precision::double_}),
              "rk4 at 60 Hz in double");
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
