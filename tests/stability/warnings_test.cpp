// SPDX-License-Identifier: MIT
// Preflight's warnings before a run, compared with the run.
#include "oiler/stability/preflight.hpp"
#include "oiler/stability/stability.hpp"
#include "support/explained_step.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{60};

/// 1 kg at 1 m on a spring of ω·dt = h, 60 Hz.
Bodies swinging(double h) { return oscillator(Precision::double_, h * h * 3600, 0, 1); }

/// The amplitude after 2000 steps relative to the start; infinite if the run diverges.
double growth(Bodies bodies, const Method& method, std::int64_t steps_per_second) {
    const long double before = std::abs(x_of(bodies)) + std::abs(v_of(bodies)) / 60;
    if (bodies.try_step(method, {{steps_per_second}, 0, 2000}))
        return std::numeric_limits<double>::infinity();
    return static_cast<double>((std::abs(x_of(bodies)) + std::abs(v_of(bodies)) / 60) / before);
}

// At 144/s and 73 Hz, x stays below 1/√(1 − h²/4) = 6.1. At 72 Hz h = 2, and semi-implicit Euler
// adds twice the start to x every step.
TEST(Warning, NamesLimitAndLowestRate) {
    const Method& method = find_method("semi_implicit_euler");
    const auto lines = warnings(swinging(2.4), method, rate);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "spring of body 0: ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 73 Hz, or "
              "implicit_midpoint");
    EXPECT_LT(growth(swinging(2.4), method, 73), 20);
    EXPECT_GT(growth(swinging(2.4), method, 72), 3900);
}

// If ω/2 is an integer, that rate is the limit itself, and too low.
TEST(Warning, NamesNoRateAtTheLimit) {
    std::vector<int> at_the_limit;
    for (int omega = 126; omega <= 240; omega += 6) {
        const Bodies bodies = oscillator(Precision::double_, double(omega) * omega, 0, 1);
        const auto lines = warnings(bodies, find_method("semi_implicit_euler"), rate);
        ASSERT_EQ(lines.size(), 1U) << omega;
        if (rate_in(lines[0]) == omega / 2) at_the_limit.push_back(omega);
    }
    EXPECT_EQ(at_the_limit, std::vector<int>());
}

bool is_stable_at(const Method& method, double h) {
    const Oscillation oscillation{h * h, 0};
    return is_stable(step_matrices(method, method.damping, std::span(&oscillation, 1)).front());
}

// The limit is 60.5 Hz. At 61 Hz, motion stays within the method's ellipse, about 100 times as long
// as wide. At 60 Hz, 2000 steps grow by at least e^12, except for the three methods that are stable
// again there and have no warning.
TEST(Warning, NamesARateThatIsStableForEveryMethodAndOneBelowIsNot) {
    int warned = 0;
    for (const Method& method : methods()) {
        const double limit = stability_limit(method, method.damping, {1, 0});
        if (limit == 0 || std::isinf(limit)) continue;
        if (is_stable_at(method, limit * 60.5 / 60)) continue;
        const Bodies bodies = swinging(limit * 60.5 / 60);
        const auto lines = warnings(bodies, method, rate);
        ASSERT_EQ(lines.size(), 1U) << method.name;
        EXPECT_EQ(rate_in(lines[0]), 61) << lines[0];
        EXPECT_TRUE(warnings(bodies, method, {61}).empty()) << method.name;
        EXPECT_LT(growth(bodies, method, 61), 1000) << lines[0];
        EXPECT_GT(growth(bodies, method, 60), 1e4) << lines[0];
        ++warned;
    }
    EXPECT_GE(warned, 27);
}

// v' = v·(1 − c·dt): the factor is −1.983 at 60 Hz and 0.006 at 180 Hz. It is above −1 from 90 Hz
// on, but turns the body round.
TEST(Warning, IsGivenForDragAloneToo) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.velocity = {1}}, LinearDrag{179});
    const Method& method = find_method("explicit_euler");
    const auto lines = warnings(bodies, method, rate);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "linear drag of body 0: c·dt = 2.983, explicit_euler needs < 1: rate ≥ 180 Hz, or "
              "implicit_euler");
    EXPECT_LT(growth(bodies, method, 90), 1);
    EXPECT_GT(growth(bodies, method, 89), 1e4);
    EXPECT_EQ(warnings(bodies, method, {178}).size(), 1U);
    EXPECT_TRUE(warnings(bodies, method, {180}).empty());
    EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), rate).empty());
}

TEST(Warning, SaysThatNoRateHelps) {
    for (const char* name : {"explicit_euler", "rk2_midpoint", "rk2_heun", "rk2_ralston"}) {
        const auto lines = warnings(swinging(0.1), find_method(name), rate);
        ASSERT_EQ(lines.size(), 1U) << name;
        EXPECT_EQ(
            lines[0],
            "spring of body 0: ω·dt = 0.1, " + std::string(name) +
                " gains energy at any rate: take another method, for example velocity_verlet");
    }
}

TEST(Warning, HasTheWorstFirst) {
    Bodies bodies = swinging(2.1);
    bodies.add({}, Spring{.stiffness = 3600});
    bodies.add({}, Spring{.stiffness = 25 * 3600});
    bodies.add({}, Spring{.stiffness = 9 * 3600});
    const auto lines = warnings(bodies, find_method("velocity_verlet"), rate);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_TRUE(lines[0].starts_with("spring of body 2: ω·dt = 5, ")) << lines[0];
    EXPECT_TRUE(lines[1].starts_with("spring of body 3: ω·dt = 3, ")) << lines[1];
    EXPECT_TRUE(lines[2].starts_with("spring of body 0: ω·dt = 2.1, ")) << lines[2];
}

TEST(Warning, CountsADamperByItsDampingRate) {
    Bodies bodies = swinging(2.1);
    bodies.add({}, Spring{.stiffness = 3600, .damping = 8 * 60});
    const auto lines = warnings(bodies, find_method("explicit_euler"), rate);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_TRUE(lines[0].starts_with("spring of body 1: ω·dt = 1 ")) << lines[0];
}

TEST(Warning, ChangesNothing) {
    for (const Method& method : methods()) {
        Bodies asked = swinging(2.4);
        Bodies unasked = asked;
        for (Bodies* bodies : {&asked, &unasked})
            EXPECT_FALSE(bodies->try_step(method, {rate, 0, 3})) << method.name;
        static_cast<void>(warnings(asked, method, rate));
        EXPECT_EQ(hash_of(asked), hash_of(unasked)) << method.name;
        EXPECT_EQ(asked.evaluations(), unasked.evaluations()) << method.name;
        for (Bodies* bodies : {&asked, &unasked})
            EXPECT_FALSE(bodies->try_step(method, {rate, 3, 3})) << method.name;
        EXPECT_EQ(hash_of(asked), hash_of(unasked)) << method.name;
    }
}

TEST(Warning, IsNotGivenForStableBodies) {
    for (const Method& method : methods()) {
        const double limit = stability_limit(method, method.damping, {1, 0});
        const double h = std::min(0.95 * limit, 1000.0);
        EXPECT_TRUE(warnings(swinging(h), method, rate).empty()) << method.name;
        Bodies forceless(2, Precision::double_);
        forceless.set_gravity({0, -10});
        forceless.add({.velocity = {30, 0}}, QuadraticDrag{1});
        EXPECT_TRUE(warnings(forceless, method, rate).empty()) << method.name;
    }
}

// Implicit midpoint turns overdamped motions, here from k = 10¹²/s² on, back in every step.
TEST(Warning, IsNeverGivenForImplicitAndExactMethodsThatTurnNothing) {
    for (const char* name : {"implicit_euler", "implicit_midpoint", "exact"})
        for (const double k : {0.0, 1e-300, 15.0, 1e12, 1e40})
            for (const double damping : {0.0, 1e-300, 0.1, 1e12, 1e290})
                EXPECT_EQ(
                    warnings(oscillator(Precision::double_, k, damping, 1), find_method(name), rate)
                        .empty(),
                    name != std::string_view("implicit_midpoint") || k != 1e12 || damping != 1e12)
                    << name << k << " " << damping;
}

/// Bodies on a coil spring. A splitting applies its damper in exact half-steps around the step, and
/// no drift runs it backwards.
Bodies on_a_coil(double stiffness, double damping) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {2}}, CoilSpring{{}, stiffness, damping, 0});
    return bodies;
}
Bodies on_a_link(double stiffness, double damping) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {2}});
    bodies.add({.mass = 1e9});
    bodies.link(0, 1, {.stiffness = stiffness, .damping = damping});
    return bodies;
}

/// The number of warnings, or the message that preflight throws.
std::string outcome(const Bodies& bodies, const Method& method, const Steps& steps) {
    try {
        return std::to_string(preflight(bodies, method, steps).size()) + " lines";
    } catch (const Error& error) {
        return error.what();
    }
}

// These runs are stable: they have no warning and are not refused.
TEST(WarningOfADamperBetween, IsNotGivenIfTheRunIsStable) {
    for (const double damping : {1e3, 1e6, 1e12})
        for (const Bodies& bodies : {on_a_coil(15, damping), on_a_link(15, damping)})
            for (const char* name : {"velocity_verlet", "forest_ruth4", "yoshida4_kdk"}) {
                const Steps steps{rate, 0, 1000, Damping::in_drift};
                Bodies run = bodies;
                EXPECT_FALSE(run.try_step(find_method(name), steps));
                EXPECT_EQ(outcome(bodies, find_method(name), steps), "0 lines")
                    << name << ", b = " << damping;
            }
}

// If each step starts from rest, velocity Verlet has x' = (1 − h²/2)·x: −3.5·x at h = 3.
TEST(WarningOfADamperBetween, IsGivenIfTheRunDiverges) {
    for (const Bodies& bodies : {on_a_coil(9 * 3600, 1200), on_a_link(9 * 3600, 1200)}) {
        const Method& method = find_method("velocity_verlet");
        Bodies run = bodies;
        EXPECT_TRUE(run.try_step(method, {rate, 0, 1000}));
        EXPECT_FALSE(warnings(bodies, method, rate).empty());
    }
}

// The run ends with a divergence, not with a usage error.
TEST(WarningOfADamperBetween, DoesNotReplaceADivergence) {
    for (Bodies bodies : {on_a_coil(9 * 3600, 1e7), on_a_link(9 * 3600, 1e7)}) {
        const std::string line = line_of_error(Exit::diverged, [&] {
            explained_step(bodies, find_method("forest_ruth4"), {rate, 0, 10'000});
        });
        EXPECT_TRUE(line.starts_with("diverged at step ")) << line;
    }
}

// Preflight accepts all numbers that a step accepts.
TEST(Warning, IsComputedForAnyNumbers) {
    const Method& method = find_method("velocity_verlet");
    for (const Rate at : {Rate{1'000'000'000}, Rate{1, 10}})
        for (const double k : {-15.0, 5e-324, 1e12, 1.7e308})
            EXPECT_NO_THROW(
                static_cast<void>(warnings(oscillator(Precision::double_, k, 0, 1), method, at)))
                << "k = " << k << ", dt = " << at.dt();
}

// 5e19 Hz is too large for a rate.
TEST(Warning, NamesNoInvalidRate) {
    for (const std::string& line : warnings(swinging(1e18), find_method("velocity_verlet"), rate))
        EXPECT_FALSE(holds(line, "rate ≥ -"));
}

}  // namespace
}  // namespace oiler::test
