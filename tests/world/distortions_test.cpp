// SPDX-License-Identifier: MIT
// The pre-flight's lines about runs that hold, but show another motion than the true one.
#include "oiler/sim/bodies.hpp"
#include "oiler/world/world.hpp"
#include "support/explained_step.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

World on_a_spring(const char* method, std::int64_t hertz, double omega, double damping = 0) {
    World world(1, {.method = &find_method(method), .rate = {hertz}});
    world.spawn({.position = {1}}, Spring{.stiffness = omega * omega, .damping = damping});
    return world;
}

// ---- oscillations

/// |R(ih)|², by which a step changes the energy of an undamped oscillation of h = ω·dt.
double energy_kept(const std::string& method, double h) {
    if (method == "implicit_euler") return 1 / (1 + h * h);
    if (method == "rk3_kutta") return std::pow(1 - h * h / 2, 2) + std::pow(h - h * h * h / 6, 2);
    return std::pow(1 - h * h / 2 + std::pow(h, 4) / 24, 2) + std::pow(h - h * h * h / 6, 2);
}

TEST(LostOscillation, IsToldWithTheTimeInWhichItsEnergyHalves) {
    for (const char* name : {"implicit_euler", "rk3_kutta", "rk4", "rk4_38"})
        for (const double h : {0.05, 0.2, 0.6, 1.0, 1.6}) {
            const double half = std::log(0.5) / std::log(energy_kept(name, h)) / 60;
            const auto lines = on_a_spring(name, 60, 60 * h).preflight();
            ASSERT_EQ(lines.size(), half < 20 ? 1U : 0U) << name << h << " " << half;
            if (lines.empty()) continue;
            EXPECT_TRUE(lines[0].starts_with("spring of body 0: " + std::string(name) +
                                             " takes half of the energy of its oscillation of "))
                << lines[0];
            EXPECT_NEAR(number_after(lines[0], "oscillation of "), 60 * h / (2 * std::numbers::pi),
                        0.005 * 60 * h);
            EXPECT_NEAR(number_after(lines[0], " Hz in "), half, 0.006 * half) << lines[0];
            const double rate = number_after(lines[0], "take velocity_verlet, or rate ≥ ");
            const double at_rate = std::log(energy_kept(name, 60 * h / rate)) * rate * 20;
            EXPECT_NEAR(at_rate, std::log(0.5), 0.02) << lines[0];
        }
}

TEST(LostOscillation, IsNotToldOfMethodsThatKeepTheEnergy) {
    for (const char* name :
         {"semi_implicit_euler", "velocity_verlet", "implicit_midpoint", "pefrl"})
        for (const double h : {0.05, 0.6, 1.4})
            EXPECT_TRUE(on_a_spring(name, 60, 60 * h).preflight().empty()) << name << h;
}

// implicit_euler takes ω²·dt = 2.4 /s of the energy.
TEST(LostOscillation, IsNotToldIfDampingTakesMore) {
    EXPECT_EQ(on_a_spring("implicit_euler", 60, 12, 0.5).preflight().size(), 1U);
    EXPECT_TRUE(on_a_spring("implicit_euler", 60, 12, 5).preflight().empty());
}

// A step of implicit_euler leaves 1/(1 + c·dt + h²) of the energy, damping alone e^(−c·dt): the
// difference takes half of it in the time told, but for a part of c·dt.
TEST(LostOscillation, IsToldIfDampingTakesLessThanTwiceAsMuch) {
    for (const double c : {2.0, 3.2, 4.4}) {
        const auto lines = on_a_spring("implicit_euler", 60, 12, c).preflight();
        ASSERT_EQ(lines.size(), 1U) << c;
        const double by_method = std::log(1 + c / 60 + 0.04) * 60 - c;
        EXPECT_NEAR(number_after(lines[0], " Hz in ") * by_method / std::log(2), 1, 3 * c / 60)
            << lines[0];
    }
}

// Of 29 J of two bodies that move against each other, their damper takes 25 J at once. Of the rest,
// at ω = 10 /s, implicit_euler takes half in ln 2/ln(1 + h²) steps.
TEST(LostOscillation, IsNotHiddenByOneThatDampingEnds) {
    World world(1, {.method = &find_method("implicit_euler"), .rate = {60}});
    const Entity a = world.spawn({.velocity = {7}}, Spring{.stiffness = 100});
    const Entity b = world.spawn({.velocity = {-3}}, Spring{.stiffness = 100});
    world.link(a, b, {.stiffness = 72, .damping = 8});
    const auto lines = world.preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NEAR(number_after(lines[0], "oscillation of "), 10 / (2 * std::numbers::pi), 0.005);
    EXPECT_NEAR(number_after(lines[0], " Hz in "), std::log(2) / std::log(1 + 1 / 36.0) / 60, 0.003)
        << lines[0];
}

// 0.981 m below its anchor a body of ω² = 10 /s² rests.
TEST(LostOscillation, IsNotToldOfABodyAtRest) {
    for (const double drop : {0.981, 0.5}) {
        World world(1, {.method = &find_method("implicit_euler"), .rate = {60}});
        world.set_gravity({-9.81});
        world.spawn({.position = {-drop}}, Spring{.stiffness = 10});
        EXPECT_EQ(world.preflight().size(), drop == 0.981 ? 0U : 1U) << drop;
    }
}

// Two bodies of 1 kg on a link of 72 N/m oscillate with ω = 12 /s, h = 0.2.
TEST(LostOscillation, IsToldOfLinkedBodies) {
    World world(2, {.method = &find_method("implicit_euler"), .rate = {60}});
    const Entity a = world.spawn({.position = {0, 0}, .velocity = {5, 1}});
    const Entity b = world.spawn({.position = {1.5, 0}, .velocity = {5, 1}});
    world.link(a, b, {.stiffness = 72});
    const auto lines = world.preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("link of bodies 0 and 1: implicit_euler takes ")) << lines[0];
    EXPECT_NEAR(number_after(lines[0], " Hz in "), std::log(2) / std::log(1.04) / 60, 0.002);
}

/// A body of 1 kg on a coil of 1 m and 144 N/m, 1.5 m below its anchor, with another that rests.
World on_a_coil(const char* method) {
    World world(2, {.method = &find_method(method), .rate = {60}});
    world.spawn({.position = {0, -1.5}}, CoilSpring{.stiffness = 144, .rest_length = 1});
    world.spawn({.position = {5, 5}});
    return world;
}

// 18 J, of which the run has less than half from 1/60·ln 2/ln(1 + h²) s on, h = 0.2.
TEST(LostOscillation, OfACoilIsToldFromATrial) {
    const auto lines = on_a_coil("implicit_euler").preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("springs of all bodies: implicit_euler takes half of "))
        << lines[0];
    EXPECT_TRUE(lines[0].ends_with(": take velocity_verlet")) << lines[0];
    EXPECT_NEAR(number_after(lines[0], "motion in "), std::log(2) / std::log(1.04) / 60, 0.02);
    EXPECT_TRUE(on_a_coil("velocity_verlet").preflight().empty());
    EXPECT_TRUE(on_a_coil("rk4").preflight().empty()) << "half of it in 3.6 hours";
}

/// A pendulum of 1 kg on a coil of 1.4 m with 30 N/m and a damper of 4 N·s/m, 49° aside.
World on_a_damped_coil(const char* method) {
    World world(2, {.method = &find_method(method), .rate = {60}});
    world.set_gravity({0, -9.81});
    world.spawn({.position = {1.07, -0.91}},
                CoilSpring{.stiffness = 30, .damping = 4, .rest_length = 1.4});
    return world;
}

/// Its largest kinetic energy between 13 s and 20 s by explicit midpoint steps of 0.1 ms, whose
/// error is below 10⁻⁶.
double true_kinetic_energy() {
    Vec3 x{1.07, -0.91};
    Vec3 v{};
    const auto acceleration = [](const Vec3& at, const Vec3& speed) {
        const double size = std::sqrt(squared_length(at));
        const Vec3 along = at / size;
        return Vec3{0, -9.81} - along * (30 * (size - 1.4) + 4 * dot(along, speed));
    };
    double most = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double dt = 1e-4;
        const Vec3 half_x = x + v * (dt / 2);
        const Vec3 half_v = v + acceleration(x, v) * (dt / 2);
        x = x + half_v * dt;
        v = v + acceleration(half_x, half_v) * dt;
        if (i > 130'000) most = std::max(most, squared_length(v) / 2);
    }
    return most;
}

// The damper ends the oscillation along the coil. It hardly damps the oscillation across, of which
// the run has less than half.
TEST(LostOscillation, AcrossADampedCoilIsTold) {
    World run = on_a_damped_coil("implicit_euler");
    double most = 0;
    for (int tick = 0; tick < 1200; ++tick) {
        run.step();
        if (tick > 780) most = std::max(most, squared_length(run.bodies().velocity(0)) / 2);
    }
    EXPECT_LT(most, true_kinetic_energy() / 2);
    const auto lines = on_a_damped_coil("implicit_euler").preflight();
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("spring of body 0: implicit_euler takes half of "))
        << lines[0];
    EXPECT_TRUE(on_a_damped_coil("velocity_verlet").preflight().empty());
}

// ---- orbits

/// The farthest distance from the attractor in 5 revolutions.
double farthest(World world, std::int64_t hertz) {
    double most = 0;
    for (int i = 0; i < 10 * std::numbers::pi * static_cast<double>(hertz); ++i) {
        world.step();
        most = std::max(most, std::sqrt(squared_length(world.bodies().position(0))));
    }
    return most;
}

/// An ellipse of eccentricity e with a = 1 m and gm = 1 m³/s², from its closest point.
World orbiting(const char* method, std::int64_t hertz, double e) {
    World world(2, {.method = &find_method(method), .rate = {hertz}});
    world.spawn({.position = {1 - e, 0}, .velocity = {0, std::sqrt((1 + e) / (1 - e))}},
                Attractor{.gm = 1});
    return world;
}

TEST(DistortedOrbit, IsToldWithItsFarthestPoint) {
    for (const char* name : {"semi_implicit_euler", "semi_implicit_euler_drift_kick",
                             "velocity_verlet", "implicit_midpoint", "pefrl"})
        for (const double e : {0.0, 0.5, 0.9})
            for (const std::int64_t hertz : {20, 120, 200, 400}) {
                const World world = orbiting(name, hertz, e);
                const auto lines = world.preflight();
                if (!lines.empty() && !holds(lines[0], " leads it as far as ")) continue;
                const double run = farthest(world, hertz);
                const double wrong = std::abs(run / (1 + e) - 1);
                if (lines.empty()) {
                    EXPECT_LT(wrong, 0.25) << name << e << " " << hertz;
                    continue;
                }
                EXPECT_GT(wrong, 0.2) << lines[0];
                EXPECT_NEAR(number_after(lines[0], "as far as "), run, 0.1 * run) << lines[0];
                EXPECT_NEAR(number_after(lines[0], "instead of "), 1 + e, 0.005) << lines[0];
                const auto rate = static_cast<std::int64_t>(number_after(lines[0], "rate ≥ "));
                EXPECT_NEAR(farthest(orbiting(name, rate, e), rate), 1 + e, 0.22 * (1 + e))
                    << lines[0];
            }
    EXPECT_TRUE(holds(orbiting("semi_implicit_euler_drift_kick", 120, 0.9).preflight().at(0),
                      "as far as 2.91 m from the attractor instead of 1.9 m"));
}

// ---- float

World far_out(double x, double amplitude, Precision precision) {
    World world(1,
                {.method = &find_method("velocity_verlet"), .rate = {60}, .precision = precision});
    world.spawn({.position = {x + amplitude}}, Spring{.anchor = {x}, .stiffness = 10});
    return world;
}

// Half of the last place is 0.031 m at 10⁶ m: shorter steps, near the turning points, are lost.
TEST(DepartingFloat, IsToldIfAnOscillationIsFarOut) {
    for (const double x : {1e3, 1e5, 1e6})
        for (const double amplitude : {0.25, 1.0, 5.0}) {
            World run = far_out(x, amplitude, Precision::single);
            double most = 0;
            for (int i = 1; i <= 512; ++i) {
                run.step();
                const double true_x = x + amplitude * std::cos(std::sqrt(10.0) * i / 60);
                most = std::max(most, std::abs(run.bodies().position(0)[0] - true_x));
            }
            const auto lines = far_out(x, amplitude, Precision::single).preflight();
            const bool wrong = most > 0.2 * amplitude;
            ASSERT_EQ(lines.size(), wrong ? 1U : 0U) << x << " " << amplitude << " " << most;
            EXPECT_TRUE(far_out(x, amplitude, Precision::double_).preflight().empty());
            if (!wrong) continue;
            EXPECT_NEAR(number_after(lines[0], "s it is "), most, 0.1 * most + 0.06) << lines[0];
            EXPECT_NEAR(number_after(lines[0], "motion of "), 2 * amplitude, 0.06) << lines[0];
        }
}

}  // namespace
}  // namespace oiler::test
