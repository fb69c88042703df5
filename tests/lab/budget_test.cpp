// SPDX-License-Identifier: MIT
#include "oiler/lab/rates/budget.hpp"

#include "lab/measured_scenes.hpp"
#include "lab/motions.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

std::vector<BudgetEntry> checked(const std::string& text, std::int64_t rate = 0,
                                 const char* method = "semi_implicit_euler") {
    const Scene scene = parse_scene(text, "test.toml");
    Settings settings = Settings{scene.stepping};
    if (rate > 0) settings.stepping.rate.steps = {rate};
    settings.stepping.method = &find_method(method);
    return check_budget(scene, settings);
}

std::string with_position(const std::string& most) {
    return article_spring + "[budget]\nposition_error = " + most + "\n";
}

// The reference is made 100 times as accurate as the budget.
TEST(Budget, OfASceneWithoutAClosedFormIsCheckedHoweverTightItIs) {
    const std::string thrown =
        "[scene]\naxes = 2\nrate = 60\nduration = 4.0\nmethod = \"rk4\"\n[gravity]\n"
        "acceleration = [0.0, -9.8]\n[[body]]\nquadratic_drag = 0.1\nvelocity = [20.0, 20.0]\n";
    for (const char* most : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"}) {
        const std::vector<BudgetEntry> lines =
            checked(thrown + "[budget]\nposition_error = " + most + "\n", 60, "rk4");
        ASSERT_EQ(lines.size(), 1U);
        EXPECT_LE(lines[0].floor, lines[0].most);
    }
}

// Errors between steps are known to 1 %.
TEST(Budget, ThatIsKept) {
    const std::vector<BudgetEntry> lines = checked(with_position("25.0"));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].name, "position_error");
    EXPECT_EQ(lines[0].most, 25);
    const double expected = ArticleErrors(100).as_drawn;
    EXPECT_NEAR(lines[0].measured, expected, 0.01 * expected);
    EXPECT_TRUE(lines[0].kept);
    EXPECT_GT(lines[0].floor, 0);
    EXPECT_EQ(lines[0].words, "position_error 19.8 m of 25 m: kept");
}

TEST(Budget, ThatIsExceeded) {
    const std::vector<BudgetEntry> lines = checked(with_position("19.5"));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_FALSE(lines[0].kept);
    EXPECT_EQ(lines[0].words, "position_error 19.8 m of 19.5 m: exceeded");
}

// The settings override the stepping of the scene file.
TEST(Budget, IsCheckedWithTheGivenSettings) {
    const double expected = ArticleErrors(50).as_drawn;
    EXPECT_NEAR(checked(with_position("25.0"), 50)[0].measured, expected, 0.01 * expected);
    EXPECT_FALSE(checked(with_position("25.0"), 50)[0].kept);
}

// Exact steps are connected by chords, which deviate from the oscillation by 1000 m·(1 −
// cos(ω·dt/2)) before the damper takes energy, and by less later.
TEST(Budget, OfPositionsIsThatOfTheDrawnLines) {
    const double chord = 1000 * (1 - std::cos(std::sqrt(15.0) / 200));
    const BudgetEntry line = checked(with_position("1.0"), 100, "exact").at(0);
    EXPECT_LE(line.measured, chord);
    EXPECT_GE(line.measured, 0.98 * chord);
    EXPECT_TRUE(line.kept);
    EXPECT_FALSE(checked(with_position("0.18"), 100, "exact").at(0).kept);
}

// In leapfrog, x is half a step ahead of v: the energy oscillates by ω·h/2·sin 2ωt.
TEST(Budget, OfEnergy) {
    const std::string undamped = undamped_spring + "[budget]\nenergy_drift = ";
    double x = 1000;
    double v = 0;
    double most = 0;
    for (int tick = 0; tick <= 1000; ++tick) {
        most = std::max(most, std::abs((v * v + 15 * x * x) / 15e6 - 1));
        v -= 15 * x * 0.01;
        x += v * 0.01;
    }
    const std::vector<BudgetEntry> lines = checked(undamped + "0.05\n");
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].name, "energy_drift");
    // The scale, the largest kinetic energy, is known to 1e-8.
    EXPECT_NEAR(lines[0].measured, most, 1e-8 * most);
    EXPECT_NEAR(most, std::sqrt(15.0) * 0.01 / 2, 2e-2 * most);
    EXPECT_TRUE(lines[0].kept);
    EXPECT_TRUE(lines[0].words.ends_with(" of 0.05: kept")) << lines[0].words;
    EXPECT_FALSE(checked(undamped + "0.019\n")[0].kept);
}

TEST(Budget, OfBothHasALineForEach) {
    const std::vector<BudgetEntry> lines =
        checked(with_position("25.0") + "energy_drift = 0.001\n");
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].name, "position_error");
    EXPECT_TRUE(lines[0].kept);
    EXPECT_EQ(lines[1].name, "energy_drift");
    EXPECT_FALSE(lines[1].kept);
}

TEST(Budget, OfASceneWithoutOneHasNoLines) { EXPECT_TRUE(checked(article_spring).empty()); }

TEST(Budget, OfAnUnstableRunIsExceeded) {
    const std::vector<BudgetEntry> lines = checked(with_position("25.0"), 1);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_FALSE(lines[0].kept);
    EXPECT_TRUE(std::isinf(lines[0].measured));
    EXPECT_EQ(lines[0].words, "position_error of 25 m: exceeded, the run is unstable");
}

// Free motion is straight, and 3 kg round forces per kg to double: the closed form is accurate to 8
// roundings of 3 m and 3 more on the way, which a run in double does not exceed by 100 times.
TEST(Budget, BelowTheFloorIsKept) {
    const std::vector<BudgetEntry> lines = checked(
        "[scene]\naxes = 1\nrate = 60\nduration = 3.0\n[[body]]\nmass = 3.0\nvelocity = [1.0]\n"
        "[budget]\nposition_error = 1e-6\n");
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].kept);
    EXPECT_EQ(lines[0].measured, lines[0].floor);
    EXPECT_NEAR(lines[0].floor, 2700 * std::numeric_limits<double>::epsilon(), 1e-14);
    EXPECT_TRUE(holds(lines[0].words, "position_error below "));
}

TEST(Budget, OfASceneAtRestHasAnErrorOfZero) {
    const std::vector<BudgetEntry> lines = checked(
        "[scene]\naxes = 1\nrate = 60\nduration = 4.0\n[[body]]\nname = \"b\"\n[[spring]]\n"
        "body = \"b\"\nanchor = [0.0]\nstiffness = 1.0\n[budget]\nposition_error = 1.0\n");
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].words, "position_error 0 m of 1 m: kept");
    EXPECT_FALSE(lines[0].is_limit());
}

TEST(Budget, ThatIsTooTightIsRefused) {
    for (const auto& [text, named] :
         {std::pair{with_position("1e-14"), "position_error"},
          std::pair{article_spring + "[budget]\nenergy_drift = 1e-15\n", "energy_drift = 1e-15"}}) {
        const std::string line =
            line_of_error(Exit::usage, [&scene = text] { (void)checked(scene); });
        EXPECT_TRUE(holds(line, "[budget]"));
        EXPECT_TRUE(holds(line, named));
        EXPECT_FALSE(holds(line, "\n"));
    }
}

/// 3 kg is no power of two, so forces per kg are rounded to double.
const std::string heavy_spring =
    one_axis +
    "duration = 10.0\n[[body]]\nname = \"mass\"\nmass = 3.0\nposition = [1000.0]\n[[spring]]\n"
    "body = \"mass\"\nanchor = [0.0]\nstiffness = 45.0\n";

// The closed form's energies are accurate to 8 roundings of double, its positions to some roundings
// of 1000 m. Each limit has a floor of its own.
TEST(Budget, OfEnergyIsComparedWithTheFloorOfEnergy) {
    const double floor = 100 * 8 * std::numeric_limits<double>::epsilon();
    const std::vector<BudgetEntry> energy =
        checked(heavy_spring + "[budget]\nenergy_drift = 1e-11\n", 0, "exact");
    ASSERT_EQ(energy.size(), 1U);
    EXPECT_DOUBLE_EQ(energy[0].floor, floor);
    const std::vector<BudgetEntry> both = checked(
        heavy_spring + "[budget]\nposition_error = 1e-6\nenergy_drift = 1e-11\n", 0, "exact");
    ASSERT_EQ(both.size(), 2U);
    EXPECT_DOUBLE_EQ(both[1].floor, floor);
    // At 1000 m, 100 × 8 roundings are 1.8e-10 m.
    EXPECT_GE(both[0].floor, 1000 * floor);
    EXPECT_THROW((void)checked(heavy_spring + "[budget]\nposition_error = 1e-11\n"), Error);
}

/// A reference of one sample with the given own errors.
Reference uncertain(double position, double energy) {
    Reference reference;
    reference.samples = {.per_second = 60, .count = 1};
    reference.uncertainties = {{.position = position, .energy = energy}};
    return reference;
}

bool is_judgeable(const Requirements& requirements, const Reference& reference) try {
    require_judgeable(Scene{}, reference, requirements);
    return true;
} catch (const Error&) {
    return false;
}

// Tolerances are accepted from 100 × the reference's own error on: 1 m, or 1e-3 of the energy.
TEST(RequireJudgeable, ComparesEachToleranceWithItsOwnFloor) {
    const Reference reference = uncertain(0.01, 1e-5);
    EXPECT_TRUE(is_judgeable({.position_error = 1.01}, reference));
    EXPECT_FALSE(is_judgeable({.position_error = 0.99}, reference));
    EXPECT_TRUE(is_judgeable({.energy_drift = 1.01e-3}, reference));
    EXPECT_FALSE(is_judgeable({.energy_drift = 0.99e-3}, reference));
    EXPECT_TRUE(is_judgeable({.position_error = 1.01, .energy_drift = 1.01e-3}, reference));
    EXPECT_FALSE(is_judgeable({.position_error = 1.01, .energy_drift = 0.99e-3}, reference));
    EXPECT_FALSE(is_judgeable({.position_error = 0.99, .energy_drift = 1.01e-3}, reference));
}

TEST(Summary, HasTheOwnErrorsOfTheLastMeaningfulSample) {
    Reference reference = uncertain(0, 0);
    reference.samples.count = 3;
    reference.meaningful_until = 1.0 / 60;
    reference.uncertainties = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    const ReferenceSummary own = summary(reference);
    EXPECT_EQ(own.position_error, 4);
    EXPECT_EQ(own.velocity_error, 5);
    EXPECT_EQ(own.floor.energy, 600);
}

// The reference must use the bodies that the scatter makes with the run's seed. Chords of 1/60 s
// deviate from the parabola by g·dt²/8.
TEST(Budget, OfAScatterHoldsForEverySeed) {
    const Scene scene = parse_scene(
        "[scene]\naxes = 2\nrate = 60\nduration = 2.0\n[gravity]\nacceleration = [0.0, -9.81]\n"
        "[[scatter]]\ncount = 10\nposition_from = [0.0, 0.0]\nposition_to = [100.0, 0.0]\n"
        "velocity_from = [1.0, 2.0]\n[budget]\nposition_error = 0.01\n",
        "test.toml");
    Settings settings = Settings{scene.stepping};
    settings.stepping.method = &find_method("velocity_verlet");
    for (const std::uint64_t seed : {0U, 1U, 2U}) {
        settings.seed = seed;
        const std::vector<BudgetEntry> lines = check_budget(scene, settings);
        ASSERT_EQ(lines.size(), 1U);
        EXPECT_NEAR(lines[0].measured, 9.81 / 8 / 3600, 1e-9) << seed;
    }
}

TEST(Budget, HasNoLinesIfStopped) {
    const Scene scene = parse_scene(with_position("25.0"), "test.toml");
    EXPECT_TRUE(check_budget(scene, Settings{scene.stepping}, [] { return true; }).empty());
}

}  // namespace
}  // namespace oiler::test
