// SPDX-License-Identifier: MIT
// What a scene pays for. Most times are from made-up clocks, so that each number is known.

#include "oiler/lab/ledger/ledger.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"
#include "scene/everything.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;
using Strings = std::vector<std::string>;

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

Ledger ledger_of(const std::string& text, std::int64_t steps = 20) {
    return ledger(scene_of(text), steps);
}

const std::string one_axis = "[scene]\naxes = 1\nrate = 100\n";
const std::string two_axes = "[scene]\naxes = 2\nrate = 100\n";
const std::string gravity = "[gravity]\nacceleration = [-10.0]\n";
const std::string body = "[[body]]\nname = \"a\"\nposition = [1.0]\n";
const std::string drag = "linear_drag = 0.1\n";
const std::string spring = "[[spring]]\nbody = \"a\"\nanchor = [1.0]\nstiffness = 15.0\n";
const std::string to_origin =
    one_axis + body + "[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = ";
const std::string lone_spring = to_origin + "15.0\n";
const std::string too_stiff = to_origin + "1e9\n";

const LedgerPass& pass_of(const Ledger& ledger, const std::string& name) {
    const auto found = std::ranges::find(ledger.passes, name, &LedgerPass::name);
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

Strings names_of_passes(const Ledger& ledger) {
    Strings names;
    for (const LedgerPass& pass : ledger.passes) names.push_back(pass.name);
    return names;
}

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
    const auto stiffness = std::ranges::find(columns, "stiffness", &LedgerColumn::number);
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

// A 3 × 2 net has 7 springs; each has two rows and a handle of 4 bytes, three numbers of 8 and 8 for its kind. It
// hangs from two more; each has a row and a handle, three numbers, its kind, and a point of two.
TEST(Ledger, CountsLinksAndAnchoredNodes) {
    const Ledger ledger =
        ledger_of(two_axes +
                  "[[grid]]\ncount = [3, 2]\nspacing = 1.0\nstiffness = 50.0\n"
                  "hang = \"corners\"\nvelocity = [0.1, 0.0]\nrest_length = 0.9\n");
    EXPECT_EQ(ledger.links, 9);
    constexpr double bytes = 7 * 48 + 2 * 56;
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
    EXPECT_NEAR(pass_of(ledger_of(lone_spring, 170), "spring").changes_position, 2, 0.01);
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
                       "attractor", "wind", "drive", "hang", "links", "obstacles", "moving"}));
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

// Without the tiles, the ball falls for 1 s: 5 m from 1.25 m. On them it comes to rest at 0.25 m,
// where the sum of both ways is largest at the end.
TEST(Ledger, LeavesOutAllKindsOfObstacles) {
    const Ledger ledger = ledger_of(
        "[scene]\naxes = 2\nmethod = \"velocity_verlet\"\n[gravity]\nacceleration = [0.0, -10.0]\n"
        "[[body]]\nposition = [0.5, 1.25]\ncontact = 0.25\n"
        "[[tiles]]\norigin = [0.0, -1.0]\ntile = 1.0\nrows = [\"#\"]\n"
        "[[plane]]\nnormal = [0.0, 1.0]\noffset = -3.0\n"
        "[[obstacle]]\nshape = \"circle\"\ncentre = [0.5, -2.0]\nradius = 0.5\n"
        "[[chain]]\npoints = [[0.0, -2.5], [1.0, -2.5]]\n",
        100);
    EXPECT_NEAR(pass_of(ledger, "obstacles").changes_position, 0.25 - (1.25 - 5), 1e-9);
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
    const LedgerPass dragged = pass_of(ledger, "linear_drag");
    ASSERT_TRUE(dragged.diverged);
    EXPECT_TRUE(holds(*dragged.diverged, "step"));
    EXPECT_TRUE(std::isnan(dragged.changes_position));
    EXPECT_TRUE(std::isnan(dragged.saves_ns));
    EXPECT_FALSE(pass_of(ledger, "spring").diverged);
    EXPECT_GT(pass_of(ledger, "spring").changes_position, 0);
    EXPECT_TRUE(std::isfinite(pass_of(ledger, "spring").saves_ns));
}

TEST(Ledger, ReportsDivergenceOfTheSceneItself) {
    const Ledger ledger = ledger_of(too_stiff, 2000);
    ASSERT_TRUE(ledger.diverged);
    EXPECT_TRUE(holds(*ledger.diverged, "step"));
    EXPECT_TRUE(std::isnan(ledger.ns));
    for (const LedgerPass& pass : ledger.passes) EXPECT_TRUE(std::isnan(pass.changes_position));
    EXPECT_EQ(ledger.bytes_per_body(), 8 + 8 + 12);
}

TEST(Ledger, RefusesAMethodThatCannotStepTheScene) {
    const std::string scene =
        one_axis + "method = \"exact\"\n[[body]]\nvelocity = [1.0]\nquadratic_drag = 1.0\n";
    EXPECT_THROW(static_cast<void>(ledger_of(scene)), Error);
}

TEST(Ledger, ReportsProgressFrom0To1) {
    std::vector<double> shares;
    static_cast<void>(
        ledger(scene_of(lone_spring), 20, [&](double share) { shares.push_back(share); }));
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.front(), 0);
    EXPECT_LE(shares.back(), 1);
}

bool has(const Bodies& bodies, std::string_view force) {
    const std::vector<Stored> stored = bodies.stored();
    return std::ranges::find(stored, force, &Stored::of) != stored.end();
}

/// A clock that counts the turns. Single steps before the first round choose the length of turns.
struct Turns {
    static constexpr std::size_t before = 3;
    std::size_t calls = 0;

    template <class Cost>
    StepTimer timer(Cost cost) {
        return [this, cost](Bodies& bodies, const Method& method, const Steps& steps) {
            const double now = calls++ < before ? 1 : cost(bodies, steps, calls - before - 1);
            return bodies.try_step(method, steps) ? LedgerPass::unknown : now;
        };
    }
};

const auto silent = [](double) {};

/// Three scenes: whole, without gravity, without drag.
class LedgerRace : public testing::Test {
protected:
    template <class Cost>
    Timing race_with(Cost cost, std::int64_t steps = 40) {
        Turns turns;
        return race({&whole_, &weightless_, &dragless_}, steps, turns.timer(cost), silent);
    }
    static std::size_t index_of(const Bodies& bodies) {
        if (!has(bodies, "gravity")) return 1;
        return has(bodies, "linear_drag") ? 0 : 2;
    }

    Scene whole_ = scene_of(one_axis + gravity + body + drag);
    Scene weightless_ = scene_of(one_axis + body + drag);
    Scene dragless_ = scene_of(one_axis + gravity + body);
};

TEST_F(LedgerRace, TakesTurnsInRotatingOrder) {
    std::vector<std::size_t> order;
    const Timing timing = race_with([&](const Bodies& bodies, const Steps&, std::size_t) {
        order.push_back(index_of(bodies));
        return 1.0;
    });
    ASSERT_GE(timing.rounds, 9);
    ASSERT_EQ(order.size(), 3 * static_cast<std::size_t>(timing.rounds));
    for (std::size_t turn = 0; turn + 9 <= order.size(); turn += 9) {
        std::set<std::size_t> first;
        for (std::size_t round = turn; round < turn + 9; round += 3) {
            EXPECT_EQ(std::set(&order[round], &order[round] + 3), (std::set<std::size_t>{0, 1, 2}));
            first.insert(order[round]);
        }
        EXPECT_EQ(first.size(), 3U) << turn;
    }
}

double cost_of(std::size_t scene) { return scene == 0 ? 8 : scene == 1 ? 6 : 2; }

// Costs of 8, 6 and 2, times a load that is equal in a round: ratios of 0.75 and 0.25.
TEST_F(LedgerRace, PairsTimesOfARound) {
    const Timing timing = race_with([](const Bodies& bodies, const Steps&, std::size_t turn) {
        const double load = 1.0 + static_cast<double>(turn / 3 * 5 % 7);
        return load * cost_of(index_of(bodies));
    });
    EXPECT_GT(timing.seconds.spread, 0);
    ASSERT_EQ(timing.ratios.size(), 2U);
    EXPECT_DOUBLE_EQ(timing.ratios[0].value, 0.75);
    EXPECT_DOUBLE_EQ(timing.ratios[1].value, 0.25);
    EXPECT_NEAR(timing.ratios[0].spread, 0, 1e-15);
}

TEST_F(LedgerRace, IgnoresRareInterruptions) {
    const Timing timing = race_with([](const Bodies& bodies, const Steps&, std::size_t turn) {
        return cost_of(index_of(bodies)) * (turn % 16 == 5 ? 1000 : 1);
    });
    EXPECT_EQ(timing.seconds.value, 8);
    EXPECT_EQ(timing.ratios[0].value, 0.75);
    EXPECT_EQ(timing.ratios[0].spread, 0);
}

TEST_F(LedgerRace, LeavesOutTurnsThatDiverge) {
    const Timing timing = race_with([](const Bodies& bodies, const Steps&, std::size_t turn) {
        const std::size_t scene = index_of(bodies);
        const bool diverges = scene == 2 || (scene == 1 && turn % 2 == 0);
        return diverges ? LedgerPass::unknown : cost_of(scene);
    });
    EXPECT_EQ(timing.ratios[0].value, 0.75);
    EXPECT_TRUE(std::isnan(timing.ratios[1].value));
}

// With g·dt = 0.1 m/s, the whole scene has v = −0.1·tick. An ablation takes the state from the
// whole scene's run, then one step without gravity.
TEST(LedgerRaceOfAFall, BeginsWithAStateOfTheWholeScene) {
    const std::string method = "method = \"semi_implicit_euler\"\n";
    const Scene whole = scene_of(one_axis + method + gravity + body);
    const Scene without = scene_of(one_axis + method + body);
    std::set<std::int64_t> ticks;
    Turns turns;
    const StepTimer timer = turns.timer([&](const Bodies& bodies, const Steps& steps, std::size_t) {
        const auto fallen = static_cast<double>(steps.first - (has(bodies, "gravity") ? 0 : 1));
        EXPECT_NEAR(bodies.velocity(0)[0], -0.1 * fallen, 1e-12) << steps.first;
        EXPECT_GE(steps.first, 2);
        EXPECT_LE(steps.first + steps.count, 40);
        ticks.insert(steps.first);
        return 1.0;
    });
    const Timing timing = race({&whole, &without}, 40, timer, silent);
    EXPECT_GE(timing.steps_per_turn, 1);
    EXPECT_GT(ticks.size(), 1U);
}

/// A clock that reads the evaluations of the forces.
double evaluations_of(Bodies& bodies, const Method& method, const Steps& steps) {
    const std::int64_t before = bodies.evaluations();
    if (bodies.try_step(method, steps)) return LedgerPass::unknown;
    return static_cast<double>(bodies.evaluations() - before);
}

// From rest, the ablation is in equilibrium, and its implicit steps need one evaluation instead of
// two: half of the cost would be gravity's.
TEST(LedgerOfAnImplicitMethod, ComparesTheSameMotion) {
    for (const char* method : {"implicit_midpoint", "implicit_euler"}) {
        const Scene scene =
            scene_of(one_axis + "method = \"" + method + "\"\n" + gravity + body + spring);
        const Ledger measured = ledger(scene, 200, silent, evaluations_of);
        EXPECT_EQ(measured.passes.front().name, "gravity");
        EXPECT_EQ(measured.passes.front().saves_percent, 0) << method;
        EXPECT_EQ(measured.passes.front().spread_percent, 0) << method;
    }
}

// Gravity costs 5 of 15, drag nothing; costs vary by up to 1.
TEST(LedgerTimes, HaveASpread) {
    Turns turns;
    const StepTimer timer = turns.timer([](const Bodies& bodies, const Steps&, std::size_t turn) {
        const double noise = static_cast<double>(turn * 5 % 7) / 3 - 1;
        return noise + (has(bodies, "gravity") ? 15 : 10);
    });
    const Ledger measured = ledger(scene_of(one_axis + gravity + body + drag), 40, silent, timer);
    const LedgerPass& of_gravity = measured.passes.at(0);
    const LedgerPass& of_drag = measured.passes.at(1);
    EXPECT_NEAR(of_gravity.saves_percent, 100.0 / 3, 100.0 / 15);
    EXPECT_FALSE(of_gravity.is_within_spread());
    EXPECT_EQ(of_drag.name, "linear_drag");
    EXPECT_TRUE(of_drag.is_within_spread()) << of_drag.saves_percent;
    EXPECT_LT(of_drag.spread_percent, 100.0 * 2 / 15);
    EXPECT_GT(measured.spread_ns, 0);
    EXPECT_EQ(measured.rounds, static_cast<std::int64_t>(turns.calls - Turns::before) / 4);
}

// Sorted: 1, 2, 3, 4 and 100. The median is 3, the quartiles are 2 and 4.
TEST(LedgerMedian, IsThatOfTheFiniteValues) {
    const Median median = median_of({4, 1, NAN, 100, 3, INFINITY, 2});
    EXPECT_EQ(median.value, 3);
    EXPECT_EQ(median.spread, 1);
    EXPECT_EQ(median_of({10, 20}).value, 15);
    EXPECT_EQ(median_of({10, 20}).spread, 2.5);
    EXPECT_TRUE(std::isnan(median_of({NAN}).value));
}

TEST(LedgerClock, TimesTheStepsThatItTakes) {
    const Scene scene = scene_of(one_axis + gravity + body);
    Bodies timed = make_world(scene, Settings{scene.stepping}).bodies();
    Bodies plain = timed;
    const Steps steps{scene.stepping.rate, 0, 1000};
    EXPECT_GT(cpu_seconds(timed, *scene.stepping.method, steps), 0);
    EXPECT_FALSE(plain.try_step(*scene.stepping.method, steps));
    EXPECT_EQ(timed.position(0)[0], plain.position(0)[0]);
}

TEST(LedgerClock, ReadsNoTimeOfADivergence) {
    const Scene scene = scene_of(too_stiff);
    Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    const Steps steps{scene.stepping.rate, 0, 2000};
    EXPECT_TRUE(std::isnan(cpu_seconds(bodies, *scene.stepping.method, steps)));
}

}  // namespace
}  // namespace oiler::test
