// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Vec3 = Vec3;
using State3 = State<Real, 3>;

constexpr double duration = 1;  // s
const State3 start{{2.25L, -1.75L, 0}, {0.5L, 1.25L, 0}};

/// The force with numbers of size 1; on two axes.
template <class Force>
Force assorted() {
    Force force;
    double next = 0.4375;
    for_each_number(force,
                    [&](auto& number) { number = next = next < 1.3 ? next + 0.3125 : 0.75; });
    for_each_field<Force>([&](const auto& field) {
        if constexpr (requires { (force.*field.member).axis; }) (force.*field.member)[2] = 0;
    });
    return force;
}

/// The same force in all digits.
template <class To, class From>
To widened(From from) {
    To to;
    std::array<Real, number_count<From>()> numbers{};
    std::size_t count = 0;
    for_each_number(from, [&](double number) { numbers[count++] = number; });
    count = 0;
    for_each_number(to, [&](Real& number) { number = numbers[count++]; });
    return to;
}

/// The state after the duration by the classical Runge–Kutta method over the force's acceleration.
/// With 4096 steps of rates up to 4/s the error is about (4/4096)⁴/120 = 10⁻¹⁴ m.
template <class Force>
State3 fine_state(const Force& force) {
    constexpr int steps = 4096;
    constexpr Real h = Real{duration} / steps;
    State3 at = start;
    for (int i = 0; i < steps; ++i) {
        const double t = duration * i / steps;
        const auto rate = [&](const State3& state, double c) {
            return State3{state.v, accelerate(force, state, t + c * double(h))};
        };
        const auto plus = [&](const State3& k, Real tau) {
            return State3{at.x + k.x * tau, at.v + k.v * tau};
        };
        const State3 k1 = rate(at, 0);
        const State3 k2 = rate(plus(k1, h / 2), 0.5);
        const State3 k3 = rate(plus(k2, h / 2), 0.5);
        const State3 k4 = rate(plus(k3, h), 1);
        at.x += (k1.x + k2.x * 2.0L + k3.x * 2.0L + k4.x) * (h / 6);
        at.v += (k1.v + k2.v * 2.0L + k3.v * 2.0L + k4.v) * (h / 6);
    }
    return at;
}

template <class Force>
Bodies body_with(const Force& force) {
    Bodies bodies(2, Precision::extended);
    if constexpr (Force::everywhere) {
        bodies.set_gravity(force.acceleration);
        bodies.add({});
    } else {
        bodies.add({}, force);
    }
    bodies.set_state(0, start);
    return bodies;
}

Real error_of(Bodies bodies, const Method& method, Damping damping, int rate, const State3& fine) {
    bodies.step(method, {.rate = {rate}, .count = rate, .damping = damping});
    const State3 end = bodies.state(0);
    return largest(end.x - fine.x) + largest(end.v - fine.v);
}

template <class Force>
int order_of(const Method& method, Damping damping) {
    if constexpr (Damps<Force, State<double, 3>, double>) return dragged_order(method, damping);
    return damped_order(method, damping);
}

/// Calls f(force, the same in all digits) for each kind.
template <class F>
void for_each_kind(F f) {
    for_each_index<force_count>([&](auto kind) {
        using Force = std::tuple_element_t<kind, ForceList<double, 3>>;
        using Wide = std::tuple_element_t<kind, ForceList<Real, 3>>;
        const Force force = assorted<Force>();
        SCOPED_TRACE(std::string(Force::name));
        f(force, widened<Wide>(force));
    });
}

// Half the step divides the error by 2^p. A flow that is never called, or a field that is left out,
// leaves an error that no step makes smaller. The next order may change the quotient by a third at
// dt = 1/24 s.
TEST(EveryForce, IsSteppedByEveryMethodWithItsOrder) {
    for_each_kind([]<class Force, class Wide>(const Force& force, const Wide& wide) {
        const State3 fine = fine_state(wide);
        const Bodies bodies = body_with(force);
        for (const Method& method : methods())
            for (const Damping damping : {Damping::in_kick, Damping::in_drift}) {
                if (method.order == exact_order) continue;
                const Real coarse = error_of(bodies, method, damping, 24, fine);
                const Real half = error_of(bodies, method, damping, 48, fine);
                const int order = order_of<Force>(method, damping);
                if (half < 1e-12L) continue;
                EXPECT_GT(coarse / half, std::pow(2.0L, order) * 2 / 3)
                    << method.name << ", damping in the " << name_of(damping) << ": " << coarse
                    << ", " << half;
            }
    });
}

// Rounding of some 100 steps and of the fine solution.
TEST(EveryForce, IsSteppedExactlyIfItIsLinear) {
    const Method& exact = find_method("exact");
    for_each_kind([&]<class Force, class Wide>(const Force& force, const Wide& wide) {
        Bodies bodies = body_with(force);
        if (Linear<Force>) {
            EXPECT_LT(error_of(bodies, exact, Damping::in_drift, 24, fine_state(wide)), 1e-13L);
        } else {
            EXPECT_THROW(bodies.step(exact, {.rate = {24}}), Error);
        }
    });
}

// A force in a block with others, and with rows that have none, acts as on a body alone.
TEST(EveryForce, ActsInABlockOfOtherForces) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "implicit_midpoint"})
        for (const Precision precision : {Precision::single, Precision::double_}) {
            const Method& method = find_method(name);
            Bodies all(2, precision);
            for (int i = 0; i < 5; ++i) all.add({.position = {1.0 + i, 2}});
            for_each_kind([&]<class Force, class Wide>(const Force& force, const Wide&) {
                if constexpr (Force::everywhere)
                    return;
                else
                    all.add({.position = {2.25, -1.75}, .velocity = {0.5, 1.25}}, force);
            });
            all.step(method, {.rate = {64}, .count = 70});
            std::size_t row = 5;
            for_each_kind([&]<class Force, class Wide>(const Force& force, const Wide&) {
                if constexpr (!Force::everywhere) {
                    Bodies alone(2, precision);
                    alone.add({.position = {2.25, -1.75}, .velocity = {0.5, 1.25}}, force);
                    alone.step(method, {.rate = {64}, .count = 70});
                    EXPECT_EQ(all.position(row), alone.position(0)) << name;
                    EXPECT_EQ(all.velocity(row++), alone.velocity(0)) << name;
                }
            });
            EXPECT_EQ(all.position(4), (Vec3{5, 2, 0}));
        }
}

// After hours, a frequency that is rounded to float is off by up to 2⁻²⁴ of 10⁵ turns. One kick
// adds F·sin(2π·f·t + φ)·dt; the fraction of f·t is right to 10⁻¹⁴ in 64 digits.
TEST(Drive, KeepsItsPhaseForHours) {
    const Method& euler = find_method("semi_implicit_euler");
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const double frequency : {0.7588, 1.1, 3.3, 61.7, 1.5})
            for (const std::int64_t hours : {0, 12, 30, 1000}) {
                const std::int64_t first = hours * 3600 * 60 + 7;
                Bodies bodies(2, precision);
                bodies.add({.mass = 2}, Drive{{8, 0}, frequency, 0.5});
                bodies.step(euler, {.rate = {60}, .first = first});
                const Real turns = std::fmod(Real(frequency) * Real(first) / 60, 1.0L);
                const Real kick = 4 * std::sin(2 * std::numbers::pi_v<Real> * turns + 0.5L) / 60;
                const double u = precision == Precision::single ? 6e-8 : 1.2e-16;
                // Time is rounded to double, and a phase to u; an angle has up to 7 rad.
                const double phase = 7 * (10 * u + frequency * double(first) / 60 * 1.2e-16);
                EXPECT_NEAR(bodies.velocity(0)[0], double(kick), (phase + 10 * u) * 4 / 60)
                    << frequency << " Hz after " << hours << " h";
            }
}

}  // namespace
}  // namespace oiler::test
