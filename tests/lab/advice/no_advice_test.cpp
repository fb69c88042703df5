// SPDX-License-Identifier: MIT
#include "lab/advice/advice_on.hpp"
#include "support/test.hpp"

// Requirements that no setting meets, and those that the reference cannot judge.

namespace oiler::test {
namespace {

TEST(Advice, ThatDoesNotExistNamesTheObstacles) {
    const Requirements requirements{
        .position_error = 1e-6, .max_rate = 1000, .methods = methods_of({"explicit_euler"})};
    const MeasuredScene measured = measured_for(article_spring, requirements);
    const Advice advice =
        advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
    EXPECT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best);
    ASSERT_EQ(advice.obstacles.size(), 2U);
    // Floats between 512 m and 1024 m are 2⁻¹⁴ m apart.
    const std::string rounding = "in float, round-off alone moves bodies by ";
    ASSERT_TRUE(advice.obstacles[0].starts_with(rounding)) << advice.obstacles[0];
    const double moved = std::stod(advice.obstacles[0].substr(rounding.size()));
    EXPECT_LE(moved, 1.001 * std::ldexp(1, -15));
    EXPECT_GE(moved, std::ldexp(1, -16));
    EXPECT_TRUE(holds(advice.obstacles[1], "double"));
    const std::vector<std::string> words =
        describe(advice, measured.scene, measured.reference, requirements);
    EXPECT_TRUE(holds(words.front(), "No setting meets 1e-06 m"));
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
    expect_refused(MeasuredScene(article_spring),
                   {.position_error = 1e-14, .methods = all_methods()}, "1e-14 m");
    expect_refused(MeasuredScene(article_spring), {.energy_drift = 1e-15, .methods = all_methods()},
                   "1e-15");
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
    const MeasuredScene measured = measured_for(article_spring, requirements);
    const Advice advice =
        advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
    ASSERT_FALSE(advice.meets);
    ASSERT_TRUE(advice.best && advice.runner_up);
    const auto error_of = [&](const Stepping& choice) {
        return judge(measured.scene, Settings{choice}, measured.reference).position_error;
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

}  // namespace
}  // namespace oiler::test
