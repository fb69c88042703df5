// SPDX-License-Identifier: MIT
// Times from made-up clocks, so that each number is known.
#include "oiler/lab/ledger/timing.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
using namespace lab;
namespace {

const std::string head = "[scene]\naxes = 1\nrate = 100\n";
const std::string gravity = "[gravity]\nacceleration = [-10.0]\n";
const std::string body = "[[body]]\nname = \"a\"\nposition = [1.0]\n";
const std::string drag = "linear_drag = 0.1\n";
const std::string spring = "[[spring]]\nbody = \"a\"\nanchor = [1.0]\nstiffness = 15.0\n";

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml"); }

bool has(const Bodies& bodies, std::string_view force) {
    const std::vector<Stored> stored = bodies.stored();
    return std::any_of(stored.begin(), stored.end(),
                       [&](const Stored& column) { return column.of == force; });
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
class Three : public testing::Test {
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

    Scene whole_ = scene_of(head + gravity + body + drag);
    Scene weightless_ = scene_of(head + body + drag);
    Scene dragless_ = scene_of(head + gravity + body);
};

using LedgerRace = Three;

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
    const Scene whole = scene_of(head + method + gravity + body);
    const Scene without = scene_of(head + method + body);
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
            scene_of(head + "method = \"" + method + "\"\n" + gravity + body + spring);
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
    const Ledger measured = ledger(scene_of(head + gravity + body + drag), 40, silent, timer);
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
    const Scene scene = scene_of(head + gravity + body);
    Bodies timed = make_world(scene, Settings{scene.stepping}).bodies();
    Bodies plain = timed;
    const Steps steps{scene.stepping.rate, 0, 1000};
    EXPECT_GT(cpu_seconds(timed, *scene.stepping.method, steps), 0);
    EXPECT_FALSE(plain.try_step(*scene.stepping.method, steps));
    EXPECT_EQ(timed.position(0)[0], plain.position(0)[0]);
}

TEST(LedgerClock, ReadsNoTimeOfADivergence) {
    const Scene scene =
        scene_of(head + body + "[[spring]]\nbody = \"a\"\nanchor = [0.0]\nstiffness = 1e9\n");
    Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    const Steps steps{scene.stepping.rate, 0, 2000};
    EXPECT_TRUE(std::isnan(cpu_seconds(bodies, *scene.stepping.method, steps)));
}

}  // namespace
}  // namespace oiler::test
