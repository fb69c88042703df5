// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/ledger.hpp"

#include "oiler/scene/read.hpp"
#include "scene/everything.hpp"
#include "support/test.hpp"

namespace oiler::test {
using namespace lab;
namespace {

Ledger ledger_of(const std::string& text, std::int64_t steps = 20) {
    return ledger(parse_scene(text, "test.toml"), steps);
}

const std::string one_axis = "[scene]\naxes = 1\nrate = 100\n";
const std::string two_axes = "[scene]\naxes = 2\nrate = 100\n";

const LedgerPass& pass_of(const Ledger& ledger, const std::string& name) {
    const auto found = std::find_if(ledger.passes.begin(), ledger.passes.end(),
                                    [&](const LedgerPass& pass) { return pass.name == name; });
    if (found == ledger.passes.end()) throw std::invalid_argument("no pass " + name);
    return *found;
}

/// The bytes per body in the columns of one kind.
std::size_t bytes_of(const Ledger& ledger, const std::string& kind) {
    std::size_t bytes = 0;
    for (const LedgerColumn& column : ledger.columns)
        if (column.of == kind) bytes += column.bytes;
    return bytes;
}

std::vector<std::string> names_of_passes(const Ledger& ledger) {
    std::vector<std::string> names;
    for (const LedgerPass& pass : ledger.passes) names.push_back(pass.name);
    return names;
}

using Strings = std::vector<std::string>;

const std::string lone_spring = one_axis +
                                "[[body]]\nname = \"a\"\nposition = [1.0]\n"
                                "[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = 15.0\n";

// x and v of 8 bytes and a handle of 12. Numbers of a lone body are shared.
TEST(Ledger, OfASpringCountsItsBytes) {
    const Ledger ledger = ledger_of(lone_spring);
    EXPECT_EQ(ledger.bytes_per_body(), 8 + 8 + 12);
    EXPECT_EQ(bytes_of(ledger, "spring"), 0U);
    EXPECT_EQ(bytes_of(ledger, "handle"), 12U);
    EXPECT_EQ(ledger.absent, (Strings{"gravity", "linear drag", "quadratic drag", "coil springs",
                                      "attractors", "wind", "drives", "links"}));
    EXPECT_EQ(names_of_passes(ledger), (Strings{"spring", "moving"}));
    EXPECT_EQ(ledger.flags, Strings{});
}

// Two masses, and two springs that differ only in stiffness: one column each.
TEST(Ledger, CountsAColumnForNumbersThatDiffer) {
    const Ledger ledger = ledger_of(lone_spring +
                                    "[[body]]\nname = \"b\"\nmass = 2.0\nposition = [1.0]\n"
                                    "[[spring]]\nbody = \"b\"\nanchor = [0.0]\nstiffness = 40.0\n");
    EXPECT_EQ(bytes_of(ledger, "mass"), 8U);
    EXPECT_EQ(bytes_of(ledger, "spring"), 8U);
    EXPECT_EQ(ledger.bytes_per_body(), 8 + 8 + 8 + 8 + 12);
    const auto& columns = ledger.columns;
    const auto stiffness =
        std::find_if(columns.begin(), columns.end(),
                     [](const LedgerColumn& column) { return column.number == "stiffness"; });
    ASSERT_NE(stiffness, columns.end());
    EXPECT_FALSE(stiffness->shared);
    EXPECT_EQ(stiffness->bodies, 2);
    EXPECT_TRUE((stiffness + 1)->shared);
}

const std::string scatter =
    "[[scatter]]\ncount = 50\nposition_from = [0.0, 0.0]\n"
    "position_to = [1.0, 1.0]\nvelocity_from = [1.0, 2.0]\n";

// In float: 2·4 for x, 2·4 for v, 12 for the handle.
TEST(Ledger, OfProjectilesCountsTheirBytes) {
    const Ledger ledger =
        ledger_of(two_axes + "precision = \"float\"\n[gravity]\nacceleration = [0.0, -9.81]\n" +
                  scatter + "linear_drag = 0.1\n");
    EXPECT_EQ(ledger.bytes_per_body(), 16 + 12);
    EXPECT_EQ(bytes_of(ledger, "position"), 8U);
    EXPECT_EQ(ledger.bodies, 50);
    EXPECT_EQ(ledger.absent, (Strings{"springs", "quadratic drag", "coil springs", "attractors",
                                      "wind", "drives", "links"}));
    EXPECT_EQ(names_of_passes(ledger), (Strings{"gravity", "linear_drag", "moving"}));
}

// A 3 × 2 net has 7 springs; each has two rows and a handle of 4 bytes, and three numbers of 8. It
// hangs from two more; each has a row and a handle, three numbers, and a point of two.
TEST(Ledger, CountsLinksAndAnchoredNodes) {
    const Ledger ledger =
        ledger_of(two_axes +
                  "[[grid]]\ncount = [3, 2]\nspacing = 1.0\nstiffness = 50.0\n"
                  "hang = \"corners\"\nvelocity = [0.1, 0.0]\nrest_length = 0.9\n");
    EXPECT_EQ(ledger.links, 9);
    constexpr double bytes = 7 * 40 + 2 * 48;
    EXPECT_DOUBLE_EQ(ledger.bytes_per_link, bytes / 9);
    EXPECT_EQ(names_of_passes(ledger), (Strings{"hang", "links", "moving"}));
    EXPECT_DOUBLE_EQ(ledger.bytes_per_body(), 16 + 16 + 12 + bytes / 6);
    for (const LedgerColumn& column : ledger.columns) EXPECT_EQ(column.bodies, 6) << column.of;
    EXPECT_GT(pass_of(ledger, "links").changes_position, 0);
    EXPECT_GT(pass_of(ledger, "hang").changes_position, 0);
}

// Semi-implicit Euler adds g·dt to the velocity, then the velocity to the position: after n steps
// g·dt²·(1 + … + n) = ½·g·t·(t + dt). Without gravity the body stays.
TEST(Ledger, ReportsTheEffectOfGravity) {
    const Ledger ledger = ledger_of(two_axes +
                                        "method = \"semi_implicit_euler\"\n"
                                        "[gravity]\nacceleration = [0.0, -9.81]\n" +
                                        scatter,
                                    200);
    EXPECT_EQ(ledger.steps, 200);
    const double t = 2;
    EXPECT_NEAR(pass_of(ledger, "gravity").changes_position, 0.5 * 9.81 * t * (t + 0.01), 1e-10);
}

// Without its only spring, the body stays at 1 m. With it, the body oscillates to −1 m, 2 m away.
TEST(Ledger, ReportsTheLargestChangeOfTheRun) {
    const Ledger ledger = ledger_of(lone_spring, 170);
    EXPECT_NEAR(pass_of(ledger, "spring").changes_position, 2, 0.01);
}

// The last sample is at the last step, for any stride.
TEST(Ledger, ComparesManyBodiesLessOften) {
    const Ledger ledger =
        ledger_of(two_axes +
                      "[gravity]\nacceleration = [0.0, -10.0]\n[[scatter]]\ncount = 300000\n"
                      "position_from = [0.0, 0.0]\nposition_to = [1.0, 1.0]\n",
                  103);
    EXPECT_EQ(ledger.steps, 103);
    EXPECT_LT(ledger.samples, 103);
    EXPECT_NEAR(pass_of(ledger, "gravity").changes_position, 0.5 * 10 * 1.03 * 1.04, 1e-10);
}

TEST(Ledger, TimesAreFinite) {
    const Ledger ledger = ledger_of(std::string(everything) +
                                    "[[spring]]\nbody = 'a'\nanchor = [1, 1]\nstiffness = 3\n");
    EXPECT_EQ(names_of_passes(ledger),
              (Strings{"gravity", "spring", "linear_drag", "quadratic_drag", "coil_spring",
                       "attractor", "wind", "drive", "hang", "links", "planes", "moving"}));
    EXPECT_EQ(ledger.absent, Strings{});
    EXPECT_GT(ledger.ns, 0);
    EXPECT_GE(ledger.spread_ns, 0);
    EXPECT_TRUE(std::isfinite(ledger.spread_ns));
    EXPECT_GE(ledger.timed_steps, 1);
    for (const LedgerPass& pass : ledger.passes) {
        EXPECT_GE(pass.ns, 0) << pass.name;
        EXPECT_TRUE(std::isfinite(pass.ns)) << pass.name;
        if (pass.name == "moving") continue;
        EXPECT_TRUE(std::isfinite(pass.saves_ns)) << pass.name;
        EXPECT_LT(pass.saves_percent, 100) << pass.name;
        EXPECT_GT(pass.changes_position, 0) << pass.name;
    }
    EXPECT_EQ(ledger.flags, Strings{});
}

struct Flagged {
    const char* name;
    std::string scene;
    Strings flags;
};

class WithoutEffect : public testing::TestWithParam<Flagged> {};

TEST_P(WithoutEffect, IsFlagged) { EXPECT_EQ(ledger_of(GetParam().scene).flags, GetParam().flags); }

const std::string flying = "[[body]]\nname = \"a\"\nposition = [1.0]\nvelocity = [1.0]\n";

INSTANTIATE_TEST_SUITE_P(
    All, WithoutEffect,
    testing::Values(
        Flagged{"NoGravity",
                one_axis + "[gravity]\nacceleration = [0.0]\n" + flying,
                {"[gravity] has no effect in 20 steps: leave it out"}},
        Flagged{"ASpringThatDoesNothing",
                lone_spring + "[[spring]]\nbody = \"a\"\nanchor = [3.0]\nstiffness = 0.0\n",
                {"[[spring]] 2 (of \"a\") has no effect in 20 steps: leave it out"}},
        Flagged{"ASpringThatIsNeverStretched",
                lone_spring + "[[body]]\nname = \"b\"\nposition = [3.0]\n"
                              "[[spring]]\nbody = \"b\"\nanchor = [3.0]\nstiffness = 9.0\n",
                {"[[spring]] 2 (of \"b\") has no effect in 20 steps: leave it out"}},
        Flagged{"OneSpringOnce",
                one_axis + flying + "[[spring]]\nbody = \"a\"\nanchor = [3.0]\nstiffness = 0.0\n",
                {"anchored [[spring]] without `rest_length` has no effect in 20 steps: leave it "
                 "out"}},
        Flagged{"DampingTooWeakForABit",
                lone_spring + "damping = 1e-30\n",
                {"`damping` of [[spring]] 1 (of \"a\") has no effect in 20 steps: leave it out"}},
        Flagged{"DampingOfTheSecondSpring",
                lone_spring + "damping = 0.5\n[[spring]]\nbody = \"a\"\nanchor = [3.0]\n"
                              "stiffness = 2.0\ndamping = 1e-30\n",
                {"`damping` of [[spring]] 2 (of \"a\") has no effect in 20 steps: leave it out"}},
        Flagged{"ASpringThatOnlyDamps",
                one_axis + flying +
                    "[[spring]]\nbody = \"a\"\nanchor = [3.0]\nstiffness = 0.0\ndamping = 0.5\n",
                {"[[spring]] 1 (of \"a\") has `stiffness` 0 and only damps: write 0.5 as "
                 "`linear_drag` of the body"}},
        Flagged{"AttractorTooWeakForABit",
                one_axis + flying + "[[attractor]]\ngm = 1e-30\n",
                {"[[attractor]] has no effect in 20 steps: leave it out"}},
        Flagged{"OneOfTwoAttractors",
                one_axis + flying + "[[attractor]]\ngm = 1.0\n[[attractor]]\ngm = 1e-30\n",
                {"[[attractor]] 2 has no effect in 20 steps: leave it out"}},
        Flagged{"DragOfABodyAtRest",
                one_axis + "[[body]]\nlinear_drag = 1.0\n" + flying,
                {"`linear_drag` has no effect in 20 steps: leave it out"}},
        Flagged{"AnAxis",
                two_axes + "[[body]]\nvelocity = [0.0, 1.0]\n",
                {"no body moves along x in 20 steps, at 16 bytes per body: fewer `axes` "
                 "suffice, except for the picture"}},
        Flagged{"Everything",
                two_axes + "[[body]]\n",
                {"no body moves in 20 steps: give a body a `velocity` or a force that acts"}}),
    [](const auto& tested) { return std::string(tested.param.name); });

// With ω·dt = 1, explicit Euler multiplies the amplitude by |1 + i| = √2 per step: it exceeds the
// largest float within 300 steps. With b·dt = 1.5 the factor is √(2 − 1.5).
TEST(Ledger, ReportsDivergenceWithoutAForce) {
    const Ledger ledger =
        ledger_of(one_axis +
                      "method = \"explicit_euler\"\nprecision = \"float\"\n[[body]]\n"
                      "name = \"a\"\nposition = [1.0]\nlinear_drag = 150.0\n"
                      "[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = 1e4\n",
                  400);
    EXPECT_FALSE(ledger.diverged);
    EXPECT_EQ(ledger.steps, 400);
    const LedgerPass& drag = pass_of(ledger, "linear_drag");
    ASSERT_TRUE(drag.diverged);
    EXPECT_NE(drag.diverged->find("step"), std::string::npos) << *drag.diverged;
    EXPECT_TRUE(std::isnan(drag.changes_position));
    EXPECT_TRUE(std::isnan(drag.saves_ns));
    EXPECT_FALSE(pass_of(ledger, "spring").diverged);
    EXPECT_GT(pass_of(ledger, "spring").changes_position, 0);
    EXPECT_TRUE(std::isfinite(pass_of(ledger, "spring").saves_ns));
}

TEST(Ledger, ReportsDivergenceOfTheSceneItself) {
    const Ledger ledger = ledger_of(two_axes +
                                        "[[body]]\nname = \"a\"\nposition = [1.0, 0.0]\n"
                                        "[[spring]]\nbody = \"a\"\nanchor = [0.0, 0.0]\n"
                                        "stiffness = 1e9\n",
                                    2000);
    ASSERT_TRUE(ledger.diverged);
    EXPECT_NE(ledger.diverged->find("step"), std::string::npos) << *ledger.diverged;
    EXPECT_TRUE(std::isnan(ledger.ns));
    for (const LedgerPass& pass : ledger.passes) EXPECT_TRUE(std::isnan(pass.changes_position));
    EXPECT_EQ(ledger.bytes_per_body(), 16 + 16 + 12);
}

TEST(Ledger, RefusesAMethodThatCannotStepTheScene) {
    const std::string scene =
        one_axis + "method = \"exact\"\n[[body]]\nvelocity = [1.0]\nquadratic_drag = 1.0\n";
    EXPECT_THROW(static_cast<void>(ledger_of(scene)), Error);
}

TEST(Ledger, ReportsProgressFrom0To1) {
    std::vector<double> shares;
    static_cast<void>(ledger(parse_scene(lone_spring, "test.toml"), 20,
                             [&](double share) { shares.push_back(share); }));
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.front(), 0);
    EXPECT_LE(shares.back(), 1);
}

}  // namespace
}  // namespace oiler::test
