// SPDX-License-Identifier: MIT
// Zero mass, zero stiffness, zero length, numbers that are not finite.
#include "oiler/stability/stability.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Rate rate{64};

/// Two linked bodies on springs, after steps that have filled the caches.
Bodies moving(Precision precision) {
    Bodies bodies(2, precision);
    bodies.set_gravity({0, -1});
    bodies.add({.position = {1, 2}}, Spring{.stiffness = 3}, LinearDrag{0.1});
    bodies.add({.mass = 2, .velocity = {1, 2}}, Spring{.stiffness = 5, .damping = 1});
    bodies.link(0, 1, {.stiffness = 7, .damping = 0.5, .rest_length = 1});
    bodies.step(find_method("velocity_verlet"), {rate, 0, 10});
    return bodies;
}

/// Expects `change` to throw with a remedy and to leave the bodies unchanged.
template <class Change>
void expect_refused(Change change) {
    for (const Precision precision : precisions) {
        const Bodies untouched = moving(precision);
        Bodies bodies = untouched;
        const std::string line = line_of_error(Exit::usage, [&] { change(bodies); });
        EXPECT_TRUE(holds(line, ": give a ") || holds(line, ": give 0 or more")) << line;
        Bodies expected = untouched;
        bodies.step(find_method("velocity_verlet"), {rate, 10, 10});
        expected.step(find_method("velocity_verlet"), {rate, 10, 10});
        EXPECT_EQ(hash_of(bodies), hash_of(expected)) << line;
        EXPECT_EQ(bodies.link_count(), 1U) << line;
        EXPECT_EQ(bodies.energy().total(), expected.energy().total()) << line;
    }
}

TEST(Refused, AMassThatIsNotPositiveAndFinite) {
    for (const double mass : {0.0, -0.0, -1.0, -5e-324, -infinity, infinity, not_a_number}) {
        expect_refused([&](Bodies& bodies) { bodies.add({.mass = mass}); });
        expect_refused([&](Bodies& bodies) {
            bodies.add({.mass = mass}, Spring{.stiffness = 1}, LinearDrag{1});
        });
    }
}

TEST(Refused, AMotionThatIsNotFinite) {
    for (const double bad : {infinity, -infinity, not_a_number})
        for (const Vec3& vector : {Vec3{bad, 0, 0}, Vec3{0, bad, 0}}) {
            expect_refused([&](Bodies& bodies) { bodies.add({.position = vector}); });
            expect_refused([&](Bodies& bodies) { bodies.add({.velocity = vector}); });
            expect_refused([&](Bodies& bodies) { bodies.set_position(1, vector); });
            expect_refused([&](Bodies& bodies) { bodies.set_velocity(1, vector); });
            expect_refused([&](Bodies& bodies) { bodies.set_gravity(vector); });
        }
}

template <class... Force>
void expect_forces_refused(const Force&... force) {
    (expect_refused([&](Bodies& bodies) { bodies.attach(1, force); }), ...);
    (expect_refused([&](Bodies& bodies) { bodies.add({}, force); }), ...);
}

TEST(Refused, AForceThatIsNotFinite) {
    for (const double bad : {infinity, -infinity, not_a_number})
        expect_forces_refused(Spring{.anchor = {0, bad}}, Spring{.stiffness = bad}, LinearDrag{bad},
                              QuadraticDrag{bad}, CoilSpring{.anchor = {bad}},
                              CoilSpring{.damping = bad}, CoilSpring{.rest_length = bad},
                              Attractor{.centre = {bad}}, Attractor{.gm = bad});
}

TEST(Refused, ALinkThatIsNotFinite) {
    for (const double bad : {infinity, -infinity, not_a_number})
        for (const Link& link : {Link{.stiffness = bad}, {.damping = bad}, {.rest_length = bad}})
            expect_refused([&](Bodies& bodies) { bodies.link(0, 1, link); });
    expect_refused([](Bodies& bodies) { bodies.link(0, 1, {.rest_length = -1}); });
}

// The force is finite, but the acceleration of the small mass is not.
TEST(Refused, AForceThatOverflowsPerMass) {
    expect_refused([](Bodies& bodies) { bodies.add({.mass = 1e-300}, Spring{.stiffness = 1e10}); });
    expect_refused([](Bodies& bodies) { bodies.add({.mass = 1e-300}, LinearDrag{1e10}); });
}

template <class... Force>
Bodies flying(Precision precision, const Force&... force) {
    Bodies bodies(2, precision);
    bodies.add({.position = {1, 2}, .velocity = {3, -5}}, force...);
    return bodies;
}

// 3 m/s · 100/64 s. The displacement of a step, and half of it, are dyadic.
TEST(NoStiffness, IsFreeFlight) {
    for (const Precision precision : precisions)
        for (const char* name :
             {"explicit_euler", "semi_implicit_euler", "semi_implicit_euler_drift_kick",
              "implicit_euler", "implicit_midpoint", "velocity_verlet", "position_verlet",
              "rk2_midpoint", "rk2_heun", "exact"}) {
            Bodies bodies = flying(precision, Spring{.anchor = {9, 9}});
            bodies.step(find_method(name), {rate, 0, 100});
            EXPECT_EQ(bodies.position(0), (Vec3{1 + 3 * 100 / 64.0, 2 - 5 * 100 / 64.0})) << name;
            EXPECT_EQ(bodies.velocity(0), (Vec3{3, -5})) << name;
        }
}

// Equal to the bit to motion without a force, for the coefficients of every method.
TEST(NoStiffness, EqualsNoForce) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            SCOPED_TRACE(testing::Message() << method.name << " in " << name_of(precision));
            Bodies free = flying(precision);
            free.step(method, {rate, 0, 100});
            EXPECT_EQ(free.velocity(0), (Vec3{3, -5}));
            EXPECT_NEAR(free.position(0)[0], 1 + 3 * 100 / 64.0,
                        100 * roundings(method) * round_off_of(precision) * 6);
            Bodies spring = flying(precision, Spring{.anchor = {9, 9}}, LinearDrag{0});
            spring.step(method, {rate, 0, 100});
            EXPECT_EQ(hash_of(spring), hash_of(free));
            if (is_exact(method)) continue;
            Bodies coil = flying(precision, CoilSpring{.rest_length = 1}, QuadraticDrag{0});
            coil.step(method, {rate, 0, 100});
            EXPECT_EQ(hash_of(coil), hash_of(free));
        }
}

template <class F>
void for_each_kind_and_axes(F f) {
    for_each_kind([&](const Method& method, Precision precision) {
        for (const int axes : {1, 2, 3}) {
            SCOPED_TRACE(testing::Message() << axes << " axes");
            f(method, precision, axes);
        }
    });
}

Vec3 first_of(const Vec3& all, int axes) {
    Vec3 some{};
    for (int i = 0; i < axes; ++i) some[i] = all[i];
    return some;
}

constexpr double dampings[] = {0, 1, 1e12};

// The force has no direction and is therefore 0. The squares of 1e-24 m in float and of 1e-170 m in
// double underflow to 0 too.
TEST(Coincident, ACoilSpringAtItsAnchorRests) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        const double short_of = precision == Precision::single ? 1e-24 : 1e-170;
        for (const double damping : dampings)
            for (const Vec3& at : {Vec3{1, 2, 3}, Vec3{}, Vec3{short_of, short_of, short_of}}) {
                const Vec3 anchor = at[0] < 1 ? Vec3{} : first_of(at, axes);
                Bodies bodies(axes, precision);
                bodies.add({.position = first_of(at, axes)}, CoilSpring{anchor, 15, damping, 1});
                const std::uint64_t before = hash_of(bodies);
                ASSERT_FALSE(bodies.try_step(method, {rate, 0, 10}));
                EXPECT_EQ(hash_of(bodies), before) << damping;
            }
    });
}

// Two bodies of different mass fly together like one body without a link.
TEST(Coincident, LinkedBodiesFlyAsOne) {
    for_each_kind_and_axes([](const Method& method, Precision precision, int axes) {
        for (const double damping : dampings) {
            const Body body{.position = first_of({1, 2, 3}, axes),
                            .velocity = first_of({3, -5, 7}, axes)};
            Bodies bodies(axes, precision);
            bodies.add(body);
            bodies.add({.mass = 1000, .position = body.position, .velocity = body.velocity});
            bodies.link(0, 1, {.stiffness = 15, .damping = damping, .rest_length = 1});
            Bodies free(axes, precision);
            free.add(body);
            ASSERT_FALSE(bodies.try_step(method, {rate, 0, 100}));
            ASSERT_FALSE(free.try_step(method, {rate, 0, 100}));
            for (const std::size_t row : {0, 1}) {
                EXPECT_EQ(bodies.velocity(row), body.velocity) << damping;
                EXPECT_EQ(bodies.position(row), free.position(0)) << damping;
            }
        }
    });
}

// Half-steps of a huge damper make every step start from rest. The step is then that of the
// undamped method, about h²/2 of the distance, for any large damping. That is far more than the
// k·dt/b of true creep; sleep_test covers damping in the drifts.
TEST(HugeDamping, OfACoilSpringMakesEveryStepOfASplittingStartFromRest) {
    constexpr int steps = 60;
    const Oscillation oscillation{15 * rate.dt() * rate.dt(), 0};
    for (const Method& method : methods()) {
        if (!is_splitting(method)) continue;
        const auto matrix =
            step_matrices(method, Damping::in_drift, std::span(&oscillation, 1)).front();
        for (const Precision precision : precisions) {
            Bodies bodies(1, precision);
            bodies.add({.position = {2}, .velocity = {1}}, CoilSpring{{}, 15, 1e12, 1});
            bodies.step(method, {rate, 0, steps, Damping::in_drift});
            EXPECT_NEAR(x_of(bodies), 1 + std::pow(matrix.xx, steps),
                        steps * roundings(method) * round_off_of(precision))
                << method.name << " in " << name_of(precision);
            EXPECT_LT(std::abs(v_of(bodies)), 1e-6);
        }
    }
}

TEST(HugeDamping, OfACoilSpringLetsImplicitEulerCreep) {
    constexpr int steps = 60;
    Bodies bodies(1, Precision::double_);
    bodies.add({.position = {2}}, CoilSpring{{}, 15, 1e12, 1});
    bodies.step(find_method("implicit_euler"), {rate, 0, steps});
    EXPECT_NEAR((2 - x_of(bodies)) / (15e-12 * steps / 64), 1, 1e-3);
}

// 1 kg at 4 m/s and 3 kg at rest become one mass at 1 m/s: exactly with a splitting, and to
// 1/(b·dt) with implicit Euler.
TEST(HugeDamping, OfALinkMakesOneBodyOfTwo) {
    for (const Method& method : methods()) {
        if (!is_splitting(method) && method.name != "implicit_euler") continue;
        Bodies bodies(1, Precision::double_);
        bodies.add({.velocity = {4}});
        bodies.add({.mass = 3});
        bodies.link(0, 1, {.damping = 1e12});
        bodies.step(method, {rate, 0, 60, Damping::in_drift});
        EXPECT_NEAR(v_of(bodies, 0), 1, 1e-9) << method.name;
        EXPECT_NEAR(v_of(bodies, 1), 1, 1e-9) << method.name;
    }
}

}  // namespace
}  // namespace oiler::test
