// SPDX-License-Identifier: MIT
// Stiffness, masses and timesteps far outside the range of games.
#include "oiler/physics/closed_forms.hpp"
#include "oiler/physics/forces/forces.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double u = round_off_of(Precision::double_);

/// Calls `f` for stiffness from 1e-12 to 1e12 N/m; at 100 Hz ω·dt goes from 1e-8 to 1e4.
template <class F>
void for_each_stiffness(F f) {
    for (int power = -12; power <= 12; power += 2) {
        const double k = std::pow(10.0, power);
        SCOPED_TRACE(testing::Message() << "k = " << k);
        f(k, std::sqrt(static_cast<long double>(k)));
    }
}

TEST(Stiffness, OfAnySizeConservesEnergyWithImplicitMidpoint) {
    const Method& method = find_method("implicit_midpoint");
    constexpr int steps = 1000;
    for_each_stiffness([&](double k, long double omega) {
        Bodies bodies = oscillator(Precision::double_, k, 0, 1);
        bodies.step(method, {{100}, 0, steps});
        EXPECT_NE(x_of(bodies), 1);
        EXPECT_NEAR(amplitude(bodies, omega) / omega, 1, steps * roundings(method) * u);
    });
}

// (1 − h·J)⁻¹ of a quarter turn J shrinks every state by √(1 + h²) and turns it by atan h. For h ≫
// 1 one of x' and v' is a difference of two large numbers, with an error of u·h of the state. The
// error is perpendicular to the state, and only 1/h of it is turned along the state: u.
TEST(Stiffness, OfAnySizeShrinksByTheTheoreticalFactorWithImplicitEuler) {
    const Method& method = find_method("implicit_euler");
    constexpr int steps = 50;
    for_each_stiffness([&](double k, long double omega) {
        const long double h = omega * Rate{100}.dt<double>();
        Bodies bodies = oscillator(Precision::double_, k, 0, 1);
        bodies.step(method, {{100}, 0, steps});
        const long double expected = std::pow(1 + h * h, -steps / 2.0L);
        EXPECT_NEAR(amplitude(bodies, omega) / omega / expected, 1, steps * roundings(method) * u);
    });
}

// The coefficients of a step are right to the last digit. The error of 1000 steps is therefore 1000
// roundings, independent of ω·dt. The time is that of the double dt.
TEST(Stiffness, OfAnySizeIsExactWithTheExactMethod) {
    const Method& method = find_method("exact");
    constexpr int steps = 1000;
    for_each_stiffness([&](double k, long double omega) {
        for (const double damping : {0.0, 0.1}) {
            Bodies bodies = oscillator(Precision::double_, k, damping, 1);
            bodies.step(method, {{100}, 0, steps});
            const auto exact = damped_oscillator<long double>(
                1, k, damping, {1, 0}, steps * static_cast<long double>(Rate{100}.dt<double>()));
            const double tolerance = steps * roundings(method) * u;
            EXPECT_NEAR(x_of(bodies), exact.x, tolerance) << damping;
            EXPECT_NEAR(v_of(bodies) / omega, exact.v / omega, tolerance) << damping;
        }
    });
}

/// dt = 2⁻ⁿ/100 s.
Rate rate_times_power_of_two(int n) { return n >= 0 ? Rate{100LL << n} : Rate{100, 1LL << -n}; }

// In units of dt, a trajectory depends only on ω·dt and c·dt: k·4ⁿ, c·2ⁿ and dt/2ⁿ change no bit of
// a position and multiply velocities by 2ⁿ. Results at one stiffness, such as limits, therefore
// hold at all.
TEST(Stiffness, ScaledWithDtGivesTheSameMotionToTheBit) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            Bodies plain = oscillator(precision, 15, 0.1, 1000);
            plain.step(method, {{100}, 0, 100});
            for (int n = -20; n <= 20; n += 5) {
                Bodies scaled =
                    oscillator(precision, std::ldexp(15, 2 * n), std::ldexp(0.1, n), 1000);
                scaled.step(method, {rate_times_power_of_two(n), 0, 100});
                EXPECT_EQ(x_of(scaled), x_of(plain)) << method.name << ", n = " << n;
                EXPECT_EQ(v_of(scaled), std::ldexp(v_of(plain), n)) << method.name << ", n = " << n;
            }
            EXPECT_NE(x_of(plain), 1000);
        }
}

/// 1 kg at 1 m and `mass` at 0, linked by 15 N/m.
Bodies pair(Precision precision, double mass) {
    Bodies bodies(1, precision);
    bodies.add({.position = {1}});
    bodies.add({.mass = mass});
    bodies.link(0, 1, {.stiffness = 15});
    return bodies;
}

long double distance(const Bodies& bodies) { return x_of(bodies, 0) - x_of(bodies, 1); }

constexpr double mass_ratios[] = {1, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12};

// The distance oscillates with ω² = k/μ, μ = m₁m₂/(m₁ + m₂). Velocity Verlet's positions from rest
// are cos(n·θ), sin(θ/2) = ω·dt/2. In float the stored numbers have one rounding, which changes θ
// by the same fraction.
TEST(MassRatio, ALinkOscillatesWithTheReducedMass) {
    constexpr int steps = 1000;
    const Method& method = find_method("velocity_verlet");
    for (const Precision precision : precisions)
        for (const double mass : mass_ratios) {
            Bodies bodies = pair(precision, mass);
            bodies.step(method, {{60}, 0, steps});
            const long double omega = std::sqrt(15 * (1 + 1 / static_cast<long double>(mass)));
            const long double theta = 2 * std::asin(omega / 60 / 2);
            EXPECT_NEAR(distance(bodies), std::cos(steps * theta),
                        steps * roundings(method) * round_off_of(precision))
                << name_of(precision) << ", " << mass;
        }
}

// The mass cancels from each step of the distance, with any method. The impulses on the two bodies
// are opposite to within the roundings of each step. Momentum and the centre of mass, at rest at
// 1/(1 + m), therefore stay to within these roundings.
TEST(MassRatio, EveryMethodMovesALinkAsASpringAndKeepsTheMomentum) {
    constexpr int steps = 300;
    for (const Method& method : methods()) {
        if (is_exact(method)) continue;
        const double tolerance = steps * roundings(method) * u;
        for (const double mass : mass_ratios) {
            SCOPED_TRACE(testing::Message() << method.name << ", " << mass);
            Bodies linked = pair(Precision::double_, mass);
            Bodies single = oscillator(Precision::double_, 15 * (1 + 1 / mass), 0, 1);
            linked.step(method, {{60}, 0, steps});
            single.step(method, {{60}, 0, steps});
            const auto size = static_cast<double>(amplitude(single, std::sqrt(15.0L)));
            EXPECT_NEAR(distance(linked), x_of(single), tolerance * size);
            EXPECT_NEAR(v_of(linked, 0) + mass * v_of(linked, 1), 0, tolerance * size);
            EXPECT_NEAR(x_of(linked, 0) + mass * x_of(linked, 1), 1, tolerance * size);
            EXPECT_NE(v_of(linked, 1), 0);
        }
    }
}

// From 1e-6 to 1e6 kg, in powers of two, so that the quotients are equal to the bit.
TEST(MassRatio, EqualStiffnessPerMassGivesEqualMotion) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            Bodies bodies(1, precision);
            for (int power = -20; power <= 20; ++power) {
                const double mass = std::ldexp(1, power);
                bodies.add({.mass = mass, .position = {1}},
                           Spring{.stiffness = 15 * mass, .damping = 0.1 * mass});
            }
            bodies.step(method, {{60}, 0, 100});
            for (std::size_t row = 1; row < bodies.size(); ++row) {
                ASSERT_EQ(x_of(bodies, row), x_of(bodies)) << method.name;
                ASSERT_EQ(v_of(bodies, row), v_of(bodies)) << method.name;
            }
            EXPECT_NE(x_of(bodies), 1);
        }
}

constexpr Rate timesteps[] = {{1'000'000'000}, {1'000'000}, {1000}, {60}, {1}, {1, 10}};

// With ω·dt = 0.1, the positions for dt from 1 ns to 10 s are those for 1 s. k, dt and so ω·dt have
// a relative error of a rounding, which becomes a phase error of 1000 · 0.1 roundings in 1000
// steps.
TEST(Timestep, FromANanosecondToTenSecondsGivesEqualMotion) {
    constexpr int steps = 1000;
    for (const Method& method : methods()) {
        Bodies plain = oscillator(Precision::double_, 0.01, 0, 1);
        plain.step(method, {{1}, 0, steps});
        const double tolerance = steps * roundings(method) * u;
        const auto size = static_cast<double>(amplitude(plain, 0.1L)) / 0.1;
        for (const Rate rate : timesteps) {
            const double dt = rate.dt();
            Bodies bodies = oscillator(Precision::double_, 0.01 / (dt * dt), 0, 1);
            bodies.step(method, {rate, 0, steps});
            EXPECT_NEAR(x_of(bodies), x_of(plain), tolerance * size) << method.name << dt;
            EXPECT_NEAR(v_of(bodies) * dt, v_of(plain), tolerance * size) << method.name << dt;
        }
    }
}

// 5000 steps of 1 ns move the article's mass by 0.19 µm. The error of a method of order 1 is up to
// dt·v in x, v = 0.075 m/s, and up to dt·t·a' in v, a' = 0.1·15000 m/s³, plus roundings of 1000 m
// and of v.
TEST(Timestep, OfANanosecondIsNotLost) {
    constexpr int steps = 5000;
    constexpr Rate rate{1'000'000'000};
    EXPECT_EQ(rate.time(steps), 5e-6);
    const auto exact = damped_oscillator<long double>(1, 15, 0.1L, {1000, 0}, 5e-6L);
    for (const Method& method : methods()) {
        Bodies bodies = oscillator(Precision::double_, 15, 0.1, 1000);
        bodies.step(method, {rate, 0, steps});
        const double rounded = steps * roundings(method) * u;
        EXPECT_NEAR(x_of(bodies), exact.x, 1e-9 * 0.075 + rounded * 1000) << method.name;
        EXPECT_NEAR(v_of(bodies), exact.v, 1e-9 * 5e-6 * 1500 + rounded * 0.075) << method.name;
    }
}

// 38 rad per step; the damper reduces the amplitude by e^(−0.5) per step.
TEST(Timestep, OfTenSecondsIsExactWithTheExactMethod) {
    Bodies bodies = oscillator(Precision::double_, 15, 0.1, 1000);
    for (int tick = 0; tick < 9; ++tick) {
        bodies.step(find_method("exact"), {{1, 10}, tick, 1});
        const long double t = 10.0L * (tick + 1);
        const auto exact = damped_oscillator<long double>(1, 15, 0.1, {1000, 0}, t);
        EXPECT_NEAR(x_of(bodies), exact.x, 8 * (tick + 1) * u * 1000);
        EXPECT_NEAR(v_of(bodies), exact.v, 8 * (tick + 1) * u * 1000 * std::sqrt(15));
    }
}

template <class T>
class Precise : public testing::Test {};
using Precisions = testing::Types<float, double, Real>;
TYPED_TEST_SUITE(Precise, Precisions);

// Also for a d other than 0 whose |d|² underflows to 0.
TYPED_TEST(Precise, DirectionsOfZeroAreZero) {
    for (const TypeParam x : {TypeParam(0), std::numeric_limits<TypeParam>::min() / 4}) {
        const Direction<TypeParam, 3> nowhere({x, -x, 0});
        EXPECT_EQ(nowhere.length, 0);
        EXPECT_EQ(nowhere.inverse_length, 0);
        EXPECT_EQ(nowhere.unit, (Vec<TypeParam, 3>{0, 0, 0}));
    }
    const Direction<TypeParam, 2> somewhere({3, -4});
    EXPECT_EQ(somewhere.length, 5);
    EXPECT_EQ(somewhere.inverse_length, TypeParam(1) / 5);
}

TYPED_TEST(Precise, ACoilSpringHasNoForceAtItsAnchor) {
    using T = TypeParam;
    const CoilSpringForce<T, 2> coil{{1, 2}, 7, 3, 4};
    State<T, 2> state{{1, 2}, {5, 6}};
    EXPECT_EQ(coil.accelerate(state, 0), (Vec<T, 2>{0, 0}));
    EXPECT_EQ(coil.field(state.x, 0), (Vec<T, 2>{0, 0}));
    EXPECT_EQ(coil.potential(state), T(0.5) * 7 * 16);
    EXPECT_EQ(coil.jacobian(state).dx.row, (Matrix<T, 2>::scalar(-7).row));
    EXPECT_EQ(coil.jacobian(state).dv.row, (Matrix<T, 2>{}.row));
    coil.damp(state, T(0.5));
    EXPECT_EQ(state.v, (Vec<T, 2>{5, 6}));
}

TYPED_TEST(Precise, QuadraticDragDoesNotMoveABodyAtRest) {
    using T = TypeParam;
    const QuadraticDragForce<T, 2> drag{3};
    State<T, 2> state{{1, 2}, {0, 0}};
    EXPECT_EQ(drag.accelerate(state, 0), (Vec<T, 2>{0, 0}));
    EXPECT_EQ(drag.jacobian(state).dv.row, (Matrix<T, 2>{}.row));
    drag.damp(state, 1);
    EXPECT_EQ(state.v, (Vec<T, 2>{0, 0}));
}

/// Expects no effect of all-zero forces, which the columns hold for bodies that lack a force.
template <class T>
void expect_nothing(const State<T, 2>& state) {
    const auto expect_of = [&]<class Force>(const Force& force) {
        SCOPED_TRACE(std::string(Force::name));
        EXPECT_EQ(accelerate(force, state, 0), (Vec<T, 2>{0, 0}));
        EXPECT_EQ(potential(force, state), 0);
        EXPECT_EQ(jacobian(force, state).dx.row, (Matrix<T, 2>{}.row));
        EXPECT_EQ(jacobian(force, state).dv.row, (Matrix<T, 2>{}.row));
        State<T, 2> damped = state;
        if constexpr (requires { force.damp(damped, T(0)); }) force.damp(damped, T(0));
        EXPECT_EQ(damped.v, state.v);
    };
    std::apply([&](const auto&... force) { (expect_of(force), ...); }, ForceList<T, 2>{});
}

TYPED_TEST(Precise, ZeroForcesDoNothing) {
    expect_nothing<TypeParam>({{3, -4}, {1, 2}});
    expect_nothing<TypeParam>({{3, -4}, {0, 0}});
}

// Includes the attractor's 0/|d|³.
TYPED_TEST(Precise, ZeroForcesDoNothingAtTheOrigin) { expect_nothing<TypeParam>({{0, 0}, {1, 2}}); }

// The sun itself has no attractor.
TEST(Attractor, DoesNotMoveASunInItsCentre) {
    for (const char* name : {"velocity_verlet", "rk4", "implicit_midpoint"}) {
        Bodies bodies(2, Precision::double_);
        bodies.add({.position = {1}, .velocity = {0, 1}}, Attractor{.gm = 1});
        bodies.add({.mass = 1e6});
        EXPECT_EQ(bodies.energy().potential, -1);
        bodies.step(find_method(name), {{64}, 0, 64});
        EXPECT_EQ(bodies.position(1), (Vec3{0, 0, 0}));
    }
}

}  // namespace
}  // namespace oiler::test
