// SPDX-License-Identifier: MIT
// The pre-flight's warnings of drives and of explosions that no linear limit shows.
#include <numbers>

#include "oiler/sim/bodies.hpp"
#include "support/dice.hpp"
#include "support/explained_step.hpp"
#include "support/oscillator.hpp"
#include "support/springs.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// ---- the edge of the region

// At ω·dt = 2 both eigenvalues are −1, and the amplitude grows by its start each step. At 1.99 it
// stays below 1/√(1 − h²/4) = 10.
TEST(EdgeWarning, IsGivenAtExactlyTwo) {
    for (const char* name : {"semi_implicit_euler", "semi_implicit_euler_drift_kick",
                             "velocity_verlet", "position_verlet"})
        for (const std::int64_t hertz : {1, 7, 60, 240, 1000}) {
            const Method& method = find_method(name);
            const double k = 4 * static_cast<double>(hertz * hertz);
            Bodies bodies(1, Precision::double_);
            bodies.add({.position = {1}, .velocity = {static_cast<double>(hertz)}},
                       Spring{.stiffness = k});
            const auto lines = warnings(bodies, method, {hertz});
            ASSERT_EQ(lines.size(), 1U) << name << hertz;
            EXPECT_TRUE(holds(lines[0], "ω·dt = 2, ") && holds(lines[0], " needs < 1.9999:"))
                << lines[0];
            EXPECT_EQ(rate_in(lines[0]), hertz + 1);
            EXPECT_FALSE(bodies.try_step(method, {{hertz}, 0, 1000}));
            EXPECT_GT(std::abs(bodies.position(0)[0]) +
                          std::abs(bodies.velocity(0)[0]) / static_cast<double>(hertz),
                      500)
                << name << hertz;
            const Bodies slower = oscillator(Precision::double_, 0.99 * k, 0, 1);
            EXPECT_TRUE(warnings(slower, method, {hertz}).empty()) << name << hertz;
        }
}

// ---- drives

/// 1 kg on a spring of `hertz`, driven from rest.
Bodies driven(double hertz, double drive, double damping = 0, double phase = 0) {
    Bodies bodies(1, Precision::double_);
    bodies.add({}, Spring{.stiffness = turn * hertz * turn * hertz, .damping = damping},
               Drive{.amplitude = {10}, .frequency = drive, .phase = phase});
    return bodies;
}

double reach(Bodies bodies, const Method& method, std::int64_t steps) {
    double farthest = 0;
    for (std::int64_t tick = 0; tick < steps; ++tick) {
        EXPECT_FALSE(bodies.try_step(method, {{60}, tick}));
        farthest = std::max(farthest, std::abs(bodies.position(0)[0]));
    }
    return farthest;
}

/// The reach of x'' = −ω²x + 10·sin(Ωt) from rest: 10/(ω² − Ω²)·(sin Ωt − Ω/ω·sin ωt).
double true_reach(double hertz, double drive, double seconds) {
    const double w = turn * hertz;
    const double d = turn * drive;
    double farthest = 0;
    for (double t = 0; t < seconds; t += 0.05 / std::max(hertz, drive))
        farthest = std::max(
            farthest, std::abs(10 / (w * w - d * d) * (std::sin(d * t) - d / w * std::sin(w * t))));
    return farthest;
}

// 61 Hz at 60 steps per second is seen as 1 Hz, the spring's resonance.
TEST(DriveWarning, NamesBothEffectsAndTheRate) {
    const Method& verlet = find_method("velocity_verlet");
    const auto lines = warnings(driven(1, 61), verlet, {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with(
        "drive of body 0: 61 Hz has 0.984 steps per period and moves the body by 6."))
        << lines[0];
    EXPECT_TRUE(lines[0].ends_with("rate ≥ 732 Hz")) << lines[0];
    EXPECT_GT(reach(driven(1, 61), verlet, 512), 1000 * true_reach(1, 61, 512 / 60.0));
    EXPECT_TRUE(warnings(driven(1, 61), verlet, {732}).empty());
}

// The response is right below rate/8, and wrong by 10 % and more above rate/6.
TEST(DriveWarning, IsGivenIfTheReachIsWrong) {
    const Method& verlet = find_method("velocity_verlet");
    for (const double spring : {0.5, 1.0, 2.3})
        for (const double drive : {3.0, 5.0, 7.0, 18.0, 24.0, 29.0, 59.0, 61.0, 62.3, 119.0}) {
            const double ratio =
                reach(driven(spring, drive), verlet, 512) / true_reach(spring, drive, 512 / 60.0);
            EXPECT_EQ(!warnings(driven(spring, drive), verlet, {60}).empty(),
                      std::abs(ratio - 1) > 0.1)
                << spring << " " << drive << " " << ratio;
        }
}

// 0.1 N moves 1 kg by less than 10⁻⁶ m beside a swing of 1 m.
TEST(DriveWarning, IsNotGivenIfTheDriveMovesNothing) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {1}}, Spring{.stiffness = 9},
               Drive{.amplitude = {0.1}, .frequency = 27});
    EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), {60}).empty());
    Bodies without(1, Precision::double_);
    without.add({}, Drive{.amplitude = {}, .frequency = 61});
    EXPECT_TRUE(warnings(without, find_method("velocity_verlet"), {60}).empty());
}

// F·sin(ωt)/m from rest adds F/(mω) to the velocity: the body drifts.
TEST(DriveWarning, KnowsTheEffectOfAnyFrequency) {
    for (const double frequency : {1e3 + 1, 1e6 + 1, 1e9 + 1, 1e12}) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.mass = 2}, Drive{.amplitude = {20}, .frequency = frequency, .phase = 0.1});
        const auto lines = warnings(bodies, find_method("velocity_verlet"), {60});
        ASSERT_EQ(lines.size(), 1U) << frequency;
        const double seconds = 390 / 60.0;  // 512 steps, or as many as are affordable
        const std::string words = "instead of ";
        const double told = std::stod(lines[0].substr(lines[0].find(words) + words.size()));
        const double drift = 10 * std::cos(0.1) / (turn * frequency) * seconds;
        EXPECT_GT(told, drift) << lines[0];
        EXPECT_LT(told, drift * 513 / 390) << lines[0];
    }
}

/// The largest distance from the start of 1 kg that 100 N drive from rest: F/ω·cos(φ)·t −
/// F/ω²·(sin(ωt + φ) − sin φ).
double free_reach(double frequency, double phase, double seconds) {
    const double omega = 2 * std::numbers::pi * frequency;
    double reach = 0;
    for (double t = 0; t < seconds; t += 0.001 / frequency)
        reach = std::max(reach, std::abs(100 / omega * std::cos(phase) * t -
                                         100 / (omega * omega) *
                                             (std::sin(omega * t + phase) - std::sin(phase))));
    return reach;
}

// A drive of the rate itself moves a body between steps only. Samples of a 24th of a period miss
// 0.9 % of a reach.
TEST(DriveWarning, NamesTheTrueReachBetweenSteps) {
    const double half_pi = std::numbers::pi / 2;
    for (const double phase : {0.0, 1.0, half_pi})
        for (const double frequency : {20.0, 29.0, 30.0, 31.0, 60.0}) {
            Bodies bodies(2, Precision::double_);
            bodies.add({}, Drive{.amplitude = {0, 100}, .frequency = frequency, .phase = phase});
            const auto lines = warnings(bodies, find_method("velocity_verlet"), {60});
            ASSERT_EQ(lines.size(), 1U) << frequency;
            const double told = number_after(lines[0], "instead of ");
            EXPECT_NEAR(told / free_reach(frequency, phase, 512 / 60.0), 1, 0.015) << lines[0];
            EXPECT_TRUE(holds(lines[0], " m in 8.53 s instead of ")) << lines[0];
        }
}

// F·sin(ωt + φ), sampled at one end of each step, adds F·sin(φ)·dt/2 to the speed: 2 Hz at 60 Hz
// changes the drift by tan(φ)·ω·dt/2, 24 % at φ = 1.151, and all of it at π/2.
TEST(DriveWarning, OfSlowDrivesIsGivenForMethodsOfOrderOne) {
    for (const Method& method : methods())
        for (const double phase : {0.0, 0.3, 1.151, std::numbers::pi / 2}) {
            if (method.order == exact_order) continue;
            Bodies bodies(1, Precision::double_);
            bodies.add({}, Drive{.amplitude = {100}, .frequency = 2, .phase = phase});
            const double truth = free_reach(2, phase, 512 / 60.0);
            const bool is_wrong = std::abs(reach(bodies, method, 512) / truth - 1) > 0.1;
            EXPECT_EQ(is_wrong, method.order == 1 && phase > 1) << method.name << phase;
            const auto lines = warnings(bodies, method, {60});
            ASSERT_EQ(lines.size(), is_wrong ? 1U : 0U) << method.name << phase;
            if (!is_wrong) continue;
            EXPECT_NEAR(number_after(lines[0], "instead of ") / truth, 1, 0.015) << lines[0];
            EXPECT_TRUE(lines[0].ends_with(is_implicit(method) ? ": take implicit_midpoint"
                                                               : ": take velocity_verlet"))
                << lines[0];
        }
}

// A drive at the frequency of the spring moves the body by F/(2ω²)·(sin ωt − ωt·cos ωt).
// velocity_verlet detunes it by h²/24, which loses a tenth of the amplitude from 15 steps per
// period on.
TEST(DriveWarning, IsGivenIfTheMethodLeavesAResonance) {
    const Method& verlet = find_method("velocity_verlet");
    for (const double hertz : {1.0, 2.0, 3.0, 5.0, 6.0, 7.0}) {
        const double omega = turn * hertz;
        double truth = 0;
        for (double t = 0; t < 512 / 60.0; t += 0.01 / hertz)
            truth = std::max(truth,
                             5 / (omega * omega) *
                                 std::abs(std::sin(omega * t) - omega * t * std::cos(omega * t)));
        const double ratio = reach(driven(hertz, hertz), verlet, 512) / truth;
        EXPECT_EQ(std::abs(ratio - 1) > 0.1, hertz > 4) << hertz << " " << ratio;
        EXPECT_EQ(!warnings(driven(hertz, hertz), verlet, {60}).empty(), hertz > 4) << hertz;
    }
}

// Other bodies change neither the line of a driven body nor its length.
TEST(DriveWarning, DependsOnNoOtherBodies) {
    const auto line_among = [](std::size_t others) {
        Bodies bodies(2, Precision::double_);
        for (std::size_t i = 0; i < others; ++i) bodies.add({.velocity = {1, 1}});
        const std::size_t row = bodies.add({}, Drive{.amplitude = {100, 0}, .frequency = 29});
        std::string told;
        for (const Risk& risk : preflight(bodies, find_method("velocity_verlet"), {{60}})) {
            EXPECT_EQ(risk.row, row);
            told += risk.message;
        }
        return told;
    };
    const std::string alone = line_among(0);
    EXPECT_FALSE(alone.empty());
    for (const std::size_t others : {1, 500, 5000}) EXPECT_EQ(line_among(others), alone) << others;
}

// The programs refuse rates above 1,000,000 Hz.
TEST(DriveWarning, NamesOnlyRatesThatThereAre) {
    const Method& verlet = find_method("velocity_verlet");
    for (const double frequency : {50e3 + 1, 83e3 + 1, 84e3 + 1, 1e6 + 1, 1e15}) {
        const auto lines = warnings(driven(1, frequency, 0.3, 0.5), verlet, {60});
        ASSERT_EQ(lines.size(), 1U) << frequency;
        if (frequency < 83.3e3) {
            EXPECT_LE(rate_in(lines[0]), 1'000'000) << lines[0];
        } else {
            EXPECT_TRUE(
                lines[0].ends_with(": no rate up to 1000000 Hz follows it: lower its frequency"))
                << lines[0];
        }
    }
}

// ω² = 2·9000 /s², h = 2.24; 3.4 Hz has 17.6 steps.
TEST(DriveWarning, IsNotGivenIfASpringExplodes) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {1}}, Spring{.stiffness = 18'000},
               Drive{.amplitude = {10}, .frequency = 8});
    const auto lines = warnings(bodies, find_method("position_verlet"), {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("spring of body 0: ")) << lines[0];
}

// ---- remedies

/// Two bodies on springs, with drag that is strong at the speed of the oscillation.
Bodies dragged_springs() {
    Bodies bodies(1, Precision::double_);
    bodies.set_gravity({-4.7361});
    bodies.add({.mass = 0.5736, .position = {2.4073}, .velocity = {0.0071}},
               Spring{.anchor = {-2.068}, .stiffness = 1314.087}, QuadraticDrag{0.4005});
    bodies.add({.mass = 3.2061, .position = {0.1893}, .velocity = {1.5269}},
               Spring{.anchor = {-0.2279}, .stiffness = 1879.545, .damping = 0.0464});
    bodies.link(1, 0, {.stiffness = 399.016});
    return bodies;
}

// The springs alone need 32 Hz; the drag diverges up to 44 Hz.
TEST(RateOfARemedy, IsTried) {
    const Method& method = find_method("rk3_kutta");
    const auto diverges = [&](std::int64_t hertz) {
        Bodies run = dragged_springs();
        return run.try_step(method, {{hertz}, 0, 3000}).has_value();
    };
    EXPECT_TRUE(diverges(32));
    const auto lines = warnings(dragged_springs(), method, {30});
    ASSERT_EQ(lines.size(), 1U);
    const std::int64_t rate = rate_in(lines[0]);
    for (std::int64_t hertz = rate; hertz < 2 * rate; ++hertz)
        EXPECT_FALSE(diverges(hertz)) << hertz << ": " << lines[0];
}

// A rate that is named for an orbit has no warning itself.
TEST(RateOfARemedy, HoldsAnOrbit) {
    for (const char* name : {"pefrl", "velocity_verlet", "ruth3", "position_verlet"})
        for (const std::int64_t hertz : {20, 30, 50}) {
            Bodies bodies(2, Precision::double_);
            bodies.add({.position = {1 - 0.9, 0}, .velocity = {0, std::sqrt(1.9 / (1 - 0.9))}},
                       Attractor{.gm = 1});
            const auto lines = warnings(bodies, find_method(name), {hertz});
            if (lines.empty()) continue;
            const auto at_rate = warnings(bodies, find_method(name), {rate_in(lines[0])});
            EXPECT_TRUE(at_rate.empty()) << lines[0] << " " << at_rate[0];
        }
}

// ---- ropes

// ω = √(1.6·10⁵/1) = 400/s, and velocity_verlet needs ω·dt < 2: more than 200 Hz. So it is while
// the rope is slack, too, because it may become taut later.
TEST(RopeWarning, IsThatOfTheTautRopeAndSaysSo) {
    for (const double position : {0.5, 1.5}) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.position = {position}});
        bodies.link_to_point(0, {}, {.stiffness = 1.6e5, .rest_length = 1, .pulls_only = true});
        const auto lines = warnings(bodies, find_method("velocity_verlet"), {100});
        ASSERT_EQ(lines.size(), 1U);
        EXPECT_TRUE(lines[0].starts_with(
            "taut rope of body 0: ω·dt up to 4, velocity_verlet needs < 2: rate ≥ "))
            << lines[0];
        EXPECT_GT(rate_in(lines[0]), 200);
        EXPECT_LT(rate_in(lines[0]), 400);
        EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), {600}).empty());
    }
}

// A swing on a rope from the height of its point has at most the energy m·g·L = 20 J: its total
// energy stays below 0. An excess of half of it is a spike.
TEST(RopeWarning, NamesNoRateWithASpikeOfEnergy) {
    const Method& euler = find_method("explicit_euler");
    for (const auto& [stiffness, damping] :
         {std::pair{4000.0, 60.0}, {4000.0, 200.0}, {2e4, 200.0}}) {
        Bodies bodies(2, Precision::double_);
        bodies.set_gravity({0, -10});
        bodies.add({.position = {2}});
        bodies.link_to_point(0, {}, {stiffness, damping, 2, true});
        const auto lines = warnings(bodies, euler, {60});
        ASSERT_GE(lines.size(), 1U);
        const Rate rate{rate_in(lines[0])};
        double most = 0;
        for (std::int64_t tick = 0; tick < 10 * rate.steps; ++tick) {
            ASSERT_FALSE(bodies.try_step(euler, {rate, tick}));
            most = std::max(most, bodies.energy().total());
        }
        EXPECT_LT(most, 20) << lines[0];
    }
}

// ---- trials

/// A net of coils of 1 kg, 1 m apart, relaxed at `rest`, with its top row hung up.
Bodies hung_net(std::size_t side, double stiffness, double rest, double gravity) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -gravity});
    for (std::size_t i = 0; i < side * side; ++i)
        bodies.add({.position = {double(i % side), -double(i / side)}});
    const Link link{.stiffness = stiffness, .rest_length = rest};
    for (std::size_t i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) bodies.link(i, i + 1, link);
        if (i + side < side * side) bodies.link(i, i + side, link);
        if (i < side) bodies.link_to_point(i, {double(i), 1}, link);
    }
    return bodies;
}

/// The kinetic energy at its largest in a run; infinite if it diverges.
double largest_kinetic(Bodies bodies, const Method& method, std::int64_t steps) {
    double largest = 0;
    for (std::int64_t tick = 0; tick < steps; tick += 20) {
        if (bodies.try_step(method, {{60}, tick, 20}))
            return std::numeric_limits<double>::infinity();
        largest = std::max(largest, bodies.energy().kinetic);
    }
    return largest;
}

// The energy that a net releases bounds its kinetic energy. A net whose steps are stable at first
// may gain more energy, when it swings.
TEST(NetWarning, IsGivenIfANetGainsEnergyLater) {
    const Method& verlet = find_method("velocity_verlet");
    int late = 0;
    for (const std::size_t side : {3, 4, 5})
        for (const double rest : {0.8, 1.0, 1.1})
            for (const double stiffness : {800, 1500, 1700, 1900, 2100, 2400}) {
                const Bodies bodies = hung_net(side, stiffness, rest, 20);
                // A tenth of the steps, at ten times the rate.
                Bodies fine = bodies;
                double bound = 0;
                for (std::int64_t tick = 0; tick < 60'000; tick += 50) {
                    ASSERT_FALSE(fine.try_step(find_method("rk4"), {{600}, tick, 50}));
                    bound = std::max(bound, fine.energy().kinetic);
                }
                const bool exploded = largest_kinetic(bodies, verlet, 6000) > 10 * bound;
                const bool soon = largest_kinetic(bodies, verlet, 100) > 10 * bound;
                late += exploded && !soon;
                const bool warned = !preflight(bodies, verlet, {{60}}).empty();
                const std::string where = std::to_string(side) + " bodies, rest length " +
                                          std::to_string(rest) + ", " + std::to_string(stiffness);
                EXPECT_TRUE(warned || !exploded) << "missed: " << where;
                if (warned) {
                    EXPECT_GT(largest_kinetic(bodies, verlet, 60'000), 2 * bound) << where;
                }
            }
    EXPECT_GE(late, 3);
}

// Two attractors: a passage throws the body out, although its start is slow enough.
TEST(TrialWarning, IsGivenIfAPassageThrowsTheBodyOut) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {2.973, 0}, .velocity = {0, 3.084}}, Attractor{.gm = 43.64});
    bodies.attach_at(1, 0, Attractor{.centre = {6.944, -2.736}, .gm = 21.82});
    const Method& method = find_method("kahan_li8_kdk");
    EXPECT_FALSE(warnings(bodies, method, {4}).empty());
    Bodies run = bodies;
    EXPECT_FALSE(run.try_step(method, {{4}, 0, 200}));
    EXPECT_GT(std::sqrt(squared_length(run.position(0))), 1000);
    EXPECT_TRUE(warnings(bodies, method, {1000}).empty());
}

// A passage at 2.5 mm after 35 s throws the body out with each of these methods, and at 600 Hz.
TEST(TrialWarning, NamesNoMethodWhereNoneHelps) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {2, 0}, .velocity = {0, 3}}, Attractor{.gm = 20});
    bodies.attach_at(1, 0, Attractor{.centre = {6, 0}, .gm = 3});
    for (const char* name : {"velocity_verlet", "rk4", "blanes_moan_srkn6b", "pefrl"}) {
        const auto lines = warnings(bodies, find_method(name), {60});
        ASSERT_EQ(lines.size(), 1U) << name;
        EXPECT_TRUE(holds(lines[0],
                          ": no rate or method that was tried holds: give the body "
                          "another position or velocity"));
    }
}

// With −0.927 J/kg, 2.167/r₁ + 1.083/r₂ ≥ 0.927 holds the body within 7.91 m of the first
// attractor. explicit_euler keeps only −0.13 J/kg. After 20 s, a close passage gives energy to
// finer steps, too.
TEST(TrialWarning, IsGivenIfABodyIsBoundLessThanHalf) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {2.109, 0}, .velocity = {0, 0.8221}}, Attractor{.gm = 2.167});
    bodies.attach_at(1, 0, Attractor{.centre = {5.374, -3.176}, .gm = 1.083});
    const Method& method = find_method("explicit_euler");
    EXPECT_EQ(warnings(bodies, method, {4}).size(), 1U);
    EXPECT_NEAR(bodies.energy().total(), -0.927, 1e-3);
    Bodies run = bodies;
    EXPECT_FALSE(run.try_step(method, {{4}, 0, 300}));
    EXPECT_GT(std::sqrt(squared_length(run.position(0))), 10);
    EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), {1000}).empty());
}

}  // namespace
}  // namespace oiler::test
