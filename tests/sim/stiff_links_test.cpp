// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/preflight.hpp"
#include "support/explained_step.hpp"

namespace {

using oiler::Bodies;
using oiler::Error;
using oiler::Exit;
using oiler::find_method;
using oiler::Method;
using oiler::Precision;
using oiler::Spring;
using oiler::Vec3;

constexpr double round_off = std::numeric_limits<double>::epsilon() / 2;

/// 1 kg and 4 kg on a line.
Bodies pair(double stiffness) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.mass = 1, .position = {1}});
    bodies.add({.mass = 4});
    bodies.link(0, 1, {.stiffness = stiffness});
    return bodies;
}

/// Ten bodies of 1 to 4 kg on a line, 1.01 m apart, on stiff links.
Bodies stiff_chain(int axes, double length) {
    Bodies bodies(axes, Precision::double_);
    for (std::size_t i = 0; i < 10; ++i) {
        const auto x = static_cast<double>(i);
        bodies.add({.mass = 1 + x / 3, .position = {1.01 * x}});
        if (i > 0) bodies.link(i - 1, i, {.stiffness = 1e8, .rest_length = length});
    }
    return bodies;
}

// ω·dt is up to 2·√(1e8)/60 = 333. A step rounds v and, by dt·v, the positions; springs amplify
// this by ω·dt. Bodies at rest also tremble in their last bits, 10 m · 1e-16.
TEST(ImplicitMethods, HoldLinearStiffLinks) {
    constexpr int steps = 600;
    Bodies midpoint = stiff_chain(1, 0);
    Bodies euler = midpoint;
    const double start = midpoint.energy().total();
    double least = start;
    for (int i = 0; i < steps; ++i) {
        midpoint.step(find_method("implicit_midpoint"), {{60}, i, 1});
        euler.step(find_method("implicit_euler"), {{60}, i, 1});
        ASSERT_NEAR(midpoint.energy().total(), start, (i + 1) * 333 * 4 * round_off * start);
        ASSERT_LE(euler.energy().total(), least + 1e-18);
        least = std::min(least, euler.energy().total());
    }
    EXPECT_LT(least, 1e-6 * start);
}

// The chain hangs from its first body. At most 250 N stretch a link by 3e-6 m.
TEST(ImplicitMethods, EulersHoldsASwingingStiffChain) {
    Bodies bodies = stiff_chain(2, 1);
    bodies.set_gravity({0, -9.81});
    bodies.attach(0, Spring{.stiffness = 1e8});
    bodies.step(find_method("implicit_euler"), {{60}, 0, 300});
    for (std::size_t i = 1; i < bodies.size(); ++i) {
        const Vec3 d = bodies.position(i) - bodies.position(i - 1);
        EXPECT_NEAR(std::hypot(d[0], d[1]), 1, 1e-4) << i;
    }
    EXPECT_LT(bodies.position(9)[1], -3);
}

template <class F>
std::string line_of_error(Exit exit, F f) {
    try {
        f();
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), exit);
        return error.what();
    }
    ADD_FAILURE() << "nothing thrown";
    return {};
}

void expect_in(const std::string& part, const std::string& line) {
    EXPECT_NE(line.find(part), std::string::npos) << line;
}

TEST(Links, AreRefusedByTheExactMethod) {
    Bodies bodies = pair(20);
    const std::string line =
        line_of_error(Exit::usage, [&] { bodies.step(find_method("exact"), {{60}}); });
    expect_in("method exact", line);
    expect_in("linked", line);
    EXPECT_EQ(bodies.position(0), (Vec3{1, 0, 0}));
    bodies.remove(1);
    EXPECT_NO_THROW(bodies.step(find_method("exact"), {{60}}));
}

// 1 kg and 4 kg have ω = √(k/0.8 kg) = 25 s⁻¹. Velocity Verlet needs ω·dt < 2, or 12.5 steps per
// second.
TEST(Preflight, NamesALinkAndItsLimit) {
    const Bodies bodies = pair(500);
    const Method& verlet = find_method("velocity_verlet");
    EXPECT_TRUE(preflight(bodies, verlet, {{13}}).empty());
    const auto risks = preflight(bodies, verlet, {{12}});
    ASSERT_EQ(risks.size(), 1U);
    EXPECT_EQ(risks[0].row, 0U);
    EXPECT_EQ(risks[0].linked, 1U);
    EXPECT_NEAR(risks[0].omega_dt, 25 / 12.0, 4 * round_off * 25 / 12);
    const std::string line = line_of_error(Exit::diverged, [&] {
        Bodies copy = bodies;
        oiler::test::explained_step(copy, verlet, {{12}, 0, 100'000});
    });
    expect_in("link of bodies 0 and 1", line);
    expect_in("ω·dt up to 2.083, velocity_verlet needs < 2: rate ≥ 13 Hz", line);
    Bodies copy = bodies;
    copy.step(verlet, {{13}, 0, 100'000});
    EXPECT_LT(copy.energy().total(), 100 * bodies.energy().total());
}

}  // namespace
