// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "oiler/sim/bodies.hpp"

namespace {

using oiler::Bodies;
using oiler::Damping;
using oiler::find_method;
using oiler::Link;
using oiler::Method;
using oiler::methods;
using oiler::Precision;
using oiler::Vec3;

constexpr double round_off = std::numeric_limits<double>::epsilon() / 2;

bool is_exact(const Method& method) { return method.order == oiler::exact_order; }
bool is_splitting(const Method& method) {
    return std::holds_alternative<oiler::Splitting>(method.rule);
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

template <class F>
void for_each_kind(F f) {
    for (const Method& method : methods())
        for (const Precision precision : {Precision::single, Precision::double_})
            if (!is_exact(method)) {
                SCOPED_TRACE(std::string(method.name) + ", " + std::string(name_of(precision)));
                f(method, precision);
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
                       oiler::CoilSpring{.damping = b, .rest_length = 3});
            bodies.step(method, {{32}, 0, steps, Damping::in_drift});
            EXPECT_NEAR(bodies.velocity(0)[0], 3 * std::exp(-b / 2 * 2), 8 * steps * round_off * 3)
                << method.name << ", b = " << b;
        }
}

}  // namespace
