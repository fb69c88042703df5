// SPDX-License-Identifier: MIT
#include "oiler/physics/closed_forms.hpp"
#include "support/convergence.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// Six bodies of 0.3 to 13 kg in a ring of damped springs, every other one with a rest length, and
/// one spring across the ring.
Bodies ring(Precision precision) {
    Bodies bodies(2, precision);
    const std::array<double, 6> masses{1, 0.3, 2.5, 13, 0.7, 1.9};
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const auto angle = static_cast<double>(i);
        bodies.add({.mass = masses[i],
                    .position = {2 * std::cos(angle), 2 * std::sin(angle)},
                    .velocity = {std::sin(3 * angle), std::cos(5 * angle)}});
    }
    for (std::size_t i = 0; i < masses.size(); ++i)
        bodies.link(i, (i + 1) % masses.size(),
                    {.stiffness = 20, .damping = 0.5, .rest_length = i % 2 == 0 ? 0.0 : 1.5});
    bodies.link(0, 3, {.stiffness = 5, .damping = 1});
    return bodies;
}

struct Momentum {
    Vec3 sum{};
    double mass = 0;
    double fastest = 0;  ///< m/s
};

Momentum momentum_of(const Bodies& bodies) {
    Momentum total;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const Vec3 v = bodies.velocity(row);
        total.sum = total.sum + v * bodies.mass(row);
        total.mass += bodies.mass(row);
        total.fastest = std::max(total.fastest, largest(v));
    }
    return total;
}

// A link gives its two bodies opposite impulses, apart from unbiased roundings: per kick two of
// velocities no larger than the fastest, and two of the changes by a link.
TEST(Links, ConserveMomentum) {
    constexpr int steps = 200;
    for (const Method& method : methods())
        for (const auto& [precision, unit] :
             {std::pair(Precision::double_, round_off), {Precision::single, 0x1p-24}}) {
            if (is_exact(method)) continue;
            Bodies bodies = ring(precision);
            const Momentum start = momentum_of(bodies);
            double fastest = start.fastest;
            for (int i = 0; i < steps; ++i) {
                bodies.step(method, {{256}, i, 1});
                fastest = std::max(fastest, momentum_of(bodies).fastest);
            }
            const double roundings = 4.0 * steps * (method.evaluations + 2);
            EXPECT_LT(largest(momentum_of(bodies).sum - start.sum),
                      std::sqrt(roundings) * unit * start.mass * fastest)
                << method.name << ", " << name_of(precision);
            EXPECT_LT(bodies.energy().total(), 0.95 * ring(precision).energy().total());
        }
}

/// 1 kg and 4 kg on a link along a line, stretched by 1 m and separating, with a moving centre of
/// mass. The reciprocals of the masses are binary fractions.
struct Pair {
    double k;
    double b;
    double length;

    [[nodiscard]] Bodies bodies(Precision precision) const {
        Bodies pair(1, precision);
        pair.add({.mass = 1, .position = {1 + length}, .velocity = {2.5}});
        pair.add({.mass = 4, .position = {0}, .velocity = {2}});
        pair.link(0, 1, {.stiffness = k, .damping = b, .rest_length = length});
        return pair;
    }
    /// The relative motion has the reduced mass 1·4/(1 + 4).
    [[nodiscard]] Motion<Real> relative(Real t) const {
        return damped_oscillator<Real>(0.8L, k, b, {1, 0.5L}, t);
    }
    /// The energy: ½·5·2.1² of the centre of mass plus that of the relative motion.
    [[nodiscard]] Real energy(Real t) const {
        const auto [x, v] = relative(t);
        return 2.5L * 2.1L * 2.1L + 0.4L * v * v + 0.5L * k * x * x;
    }
    /// The error after 1 s.
    [[nodiscard]] Real error(const Method& method, int steps_per_second) const {
        Bodies pair = bodies(Precision::extended);
        pair.step(method, {{steps_per_second}, 0, steps_per_second});
        const auto a = pair.state(0);
        const auto b_ = pair.state(1);
        const auto exact = relative(1);
        return std::max(std::abs(a.x[0] - b_.x[0] - length - exact.x),
                        std::abs(a.v[0] - b_.v[0] - exact.v));
    }
};

/// The error below which the order is measured. It is small enough for the leading term to
/// dominate, which is late with damping around a method of higher order, and large enough that
/// implicit methods do not take seconds.
Real ceiling_for(const Method& method, int order) {
    constexpr std::array<Real, 5> ceilings{0, 3e-2L, 1e-4L, 1e-7L, 1e-9L};
    if (order > 4) return 1e-12L;
    return ceilings.at(static_cast<std::size_t>(order)) * (order < method.order ? 0.1L : 1);
}

void expect_pair(const Method& method, const Pair& pair, int order) {
    SCOPED_TRACE(std::string(method.name) + ", b = " + std::to_string(pair.b));
    const auto error = [&](int steps) { return pair.error(method, steps); };
    const Real omega = std::sqrt(pair.k / 0.8L);
    expect_convergence(method, order, error, 32, {omega, 50 * omega}, ceiling_for(method, order));
}

TEST(Links, MoveAPairWithTheMethodsOrder) {
    for (const Method& method : methods())
        for (const double length : {0.0, 8.0}) {
            if (is_exact(method)) continue;
            expect_pair(method, {20, 0, length}, method.order);
            expect_pair(method, {20, 0.7, length}, dragged_order(method, method.damping));
        }
}

// A step of RK4 has an error of (ω·dt)⁵/120 of the amplitude: 2.4e-11 with ω = 5/s and 1024 steps
// per second. The relative error of the energy of 11 J about the centre of mass is twice that.
TEST(Links, KeepAPairsEnergyAndDampItLikeTheRelativeMotion) {
    for (const double b : {0.0, 0.7})
        for (const double length : {0.0, 8.0}) {
            const Pair pair{20, b, length};
            Bodies bodies = pair.bodies(Precision::double_);
            EXPECT_NEAR(bodies.energy().total(), static_cast<double>(pair.energy(0)), 1e-14 * 22);
            for (int second = 1; second <= 3; ++second) {
                bodies.step(find_method("rk4"), {{1024}, (second - 1) * 1024, 1024});
                EXPECT_NEAR(bodies.energy().total(), static_cast<double>(pair.energy(second)),
                            second * 2 * 2.4e-11 * 11);
            }
        }
}

/// Two bodies of 1 kg on springs of 15 N/m, coupled by a link of 3 N/m and 0.2 N·s/m.
Bodies coupled() {
    Bodies bodies(3, Precision::double_);
    bodies.add({.position = {1, 2, -3}, .velocity = {0, 1, 4}}, Spring{.stiffness = 15});
    bodies.add({.position = {0, 5, 1}, .velocity = {-2, 1, 0}}, Spring{.stiffness = 15});
    bodies.link(0, 1, {.stiffness = 3, .damping = 0.2});
    return bodies;
}
/// The normal modes: sum and difference of the two bodies, which are independent.
Bodies modes_of(const Bodies& coupled) {
    Bodies modes(3, Precision::double_);
    const Vec3 a = coupled.position(0);
    const Vec3 b = coupled.position(1);
    const Vec3 va = coupled.velocity(0);
    const Vec3 vb = coupled.velocity(1);
    modes.add({.position = a + b, .velocity = va + vb}, Spring{.stiffness = 15});
    modes.add({.position = a - b, .velocity = va - vb},
              Spring{.stiffness = 15 + 2 * 3, .damping = 2 * 0.2});
    return modes;
}

// Linked and single bodies are stepped by different code. The numbers of this motion stay below 30
// (m or m/s), and a stage makes at most 8 unbiased roundings of them. With damping in the kicks,
// springs and links are damped alike.
TEST(Links, MoveAsTheirNormalModesDo) {
    constexpr int steps = 640;
    for (const Method& method : methods()) {
        if (is_exact(method)) continue;
        Bodies bodies = coupled();
        Bodies modes = modes_of(bodies);
        bodies.step(method, {{64}, 0, steps, Damping::in_kick});
        modes.step(method, {{64}, 0, steps, Damping::in_kick});
        const Bodies after = modes_of(bodies);
        const double roundings = 8.0 * steps * (method.evaluations + 2);
        const double tolerance = std::sqrt(roundings) * round_off * 30;
        for (const std::size_t row : {0U, 1U}) {
            EXPECT_LT(largest(after.position(row) - modes.position(row)), tolerance) << method.name;
            EXPECT_LT(largest(after.velocity(row) - modes.velocity(row)), tolerance) << method.name;
        }
    }
}

// Dampers on a common body do not commute. Half-steps before the stages and, in reverse order,
// after them have order 2; without the reversal the order is 1. The error of RK4 with the smallest
// dt below is less than 1e-9.
TEST(Links, DampARingWithOrder2) {
    Bodies truth = ring(Precision::double_);
    truth.step(find_method("rk4"), {{1024}, 0, 1024});
    for (const Method& method : methods()) {
        if (dragged_order(method, Damping::in_drift) != 2) continue;
        const auto error = [&](int steps) {
            Bodies bodies = ring(Precision::double_);
            bodies.step(method, {{steps}, 0, steps, Damping::in_drift});
            Real largest_error = 0;
            for (std::size_t row = 0; row < bodies.size(); ++row)
                largest_error = std::max<Real>(largest_error,
                                               largest(bodies.position(row) - truth.position(row)));
            return largest_error;
        };
        SCOPED_TRACE(method.name);
        expect_convergence(method, 2, error, 32, {16, 50}, 1e-5L);
    }
}

// Bodies at (0, 0) and (3, 4) on a link of length L: ½k·(5 − L)².
TEST(LinkForce, HasAPotential) {
    for (const auto& [length, potential] : {std::pair(0.0, 50.0), {3.0, 8.0}, {5.0, 0.0}}) {
        Bodies bodies(2, Precision::double_);
        bodies.add({});
        bodies.add({.mass = 3, .position = {3, 4}});
        bodies.link(0, 1, {.stiffness = 4, .rest_length = length});
        EXPECT_EQ(bodies.energy().potential, potential);
    }
}

/// Expects no force, to the bit, on two bodies on a link with a rest length of 5 m.
void expect_no_force(const Vec3& other, const Vec3& velocity) {
    for_each_kind([&](const Method& method, Precision precision) {
        Bodies bodies(2, precision);
        bodies.add({.mass = 2, .velocity = velocity});
        bodies.add({.mass = 3, .position = other, .velocity = velocity});
        bodies.link(0, 1, {.stiffness = 1e4, .damping = 30, .rest_length = 5});
        bodies.step(method, {{64}, 0, 64});
        const Vec3 moved = velocity;  // in one second
        EXPECT_EQ(bodies.position(0), moved);
        EXPECT_EQ(bodies.position(1), other + moved);
        EXPECT_EQ(bodies.velocity(0), velocity);
        EXPECT_EQ(bodies.velocity(1), velocity);
    });
}

TEST(LinkForce, IsZeroAtTheRestLength) {
    expect_no_force({3, 4}, {});
    expect_no_force({5, 0}, {});
}

// A link with a rest length has no direction there.
TEST(LinkForce, IsZeroForCoincidentBodies) { expect_no_force({0, 0}, {}); }

/// Velocities of 2 kg at (5, 0) and 4 kg at (0, 0) after 1/4 s, calculated by hand in binary
/// fractions. The first body starts with (8, 16) m/s.
void expect_damping(const Link& link, const Vec3& first, const Vec3& second) {
    for (const char* name : {"explicit_euler", "semi_implicit_euler"}) {
        Bodies bodies(2, Precision::single);
        bodies.add({.mass = 2, .position = {5, 0}, .velocity = {8, 16}});
        bodies.add({.mass = 4});
        bodies.link(0, 1, link);
        bodies.step(find_method(name), {{4}});
        EXPECT_EQ(bodies.velocity(0), first) << name;
        EXPECT_EQ(bodies.velocity(1), second) << name;
    }
}

// b·8 along the line: −4 m/s² and 2 m/s².
TEST(LinkForce, WithALengthDampsAlongItsLine) {
    expect_damping({.damping = 1, .rest_length = 5}, {7, 16}, {0.5, 0});
}
// b·8 along the line as above, and b·16 across it: −8 m/s² and 4 m/s².
TEST(LinkForce, WithoutALengthDampsInAllDirections) {
    expect_damping({.damping = 1}, {7, 14}, {0.5, 1});
}

// −(k/m)·(5 − 3) = −8 m/s² and 4 m/s².
TEST(LinkForce, PullsTowardsItsRestLength) {
    expect_damping({.stiffness = 8, .rest_length = 3}, {6, 16}, {1, 0});
    expect_damping({.stiffness = 8, .rest_length = 7}, {10, 16}, {-1, 0});
}

// One link alone is damped exactly at any dt, by e^(−b·(1/m₁ + 1/m₂)·t). A half-step subtracts the
// loss from the velocities with four roundings. A stiff damper removes the whole relative velocity.
TEST(LinkForce, DampsVelocityExactlyInTheDrifts) {
    constexpr int steps = 64;
    for (const Method& method : methods())
        for (const double length : {0.0, 3.0})
            for (const double b : {0.1, 2.0, 1e6}) {
                if (!is_splitting(method)) continue;
                Bodies bodies(1, Precision::double_);
                bodies.add({.mass = 2, .position = {100}, .velocity = {3}});
                bodies.add({.mass = 8, .velocity = {-1}});
                bodies.link(0, 1, {.damping = b, .rest_length = length});
                bodies.step(method, {{32}, 0, steps, Damping::in_drift});
                const double left = 4 * std::exp(-b * 0.625 * 2);
                EXPECT_NEAR(bodies.velocity(0)[0] - bodies.velocity(1)[0], left,
                            8 * steps * round_off * 4)
                    << method.name << ", b = " << b;
                EXPECT_NEAR(bodies.velocity(0)[0], -0.2 + 0.8 * left, 8 * steps * round_off * 4);
            }
}

// With an anchor in place of the second body the factor is e^(−b/m·t).
TEST(CoilSpring, DampsVelocityExactlyInTheDrifts) {
    constexpr int steps = 64;
    for (const Method& method : methods())
        for (const double b : {0.1, 2.0, 1e6}) {
            if (!is_splitting(method)) continue;
            Bodies bodies(2, Precision::double_);
            bodies.add({.mass = 2, .position = {100}, .velocity = {3}},
                       CoilSpring{.damping = b, .rest_length = 3});
            bodies.step(method, {{32}, 0, steps, Damping::in_drift});
            EXPECT_NEAR(bodies.velocity(0)[0], 3 * std::exp(-b / 2 * 2), 8 * steps * round_off * 3)
                << method.name << ", b = " << b;
        }
}

}  // namespace
}  // namespace oiler::test
