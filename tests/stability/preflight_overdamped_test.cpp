// SPDX-License-Identifier: MIT
// Motions that only brake or creep to their rest never turn. The pre-flight's lines of steps that
// turn them are compared with runs and with closed forms.
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"
#include "support/explained_step.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A place and a speed.
struct At {
    double x, v;
};

/// The first states of a run; fewer if it diverges.
std::vector<At> states_of(Bodies bodies, const Method& method, const Steps& steps, int count) {
    std::vector<At> states;
    for (int tick = 0; tick <= count; ++tick) {
        states.push_back({bodies.position(0)[0], bodies.velocity(0)[0]});
        if (bodies.try_step(method, {steps.rate, tick, 1, steps.damping})) break;
    }
    return states;
}

std::vector<std::string> lines_of(const Bodies& bodies, const Method& method, const Steps& steps) {
    std::vector<std::string> lines;
    for (const Risk& risk : preflight(bodies, method, steps))
        lines.push_back(
            describe(risk, method, steps, [](std::size_t row) { return std::to_string(row); }));
    return lines;
}

/// Calls f(method, steps) for methods of all kinds and both dampings of splittings.
template <class F>
void for_each_damping(F f) {
    for (const char* name :
         {"explicit_euler", "semi_implicit_euler", "implicit_euler", "implicit_midpoint",
          "velocity_verlet", "position_verlet", "rk2_midpoint", "rk3_kutta", "rk4", "ruth3",
          "pefrl", "yoshida6a_kdk"}) {
        const Method& method = find_method(name);
        for (const Damping damping : {Damping::in_kick, Damping::in_drift}) {
            if (!is_splitting(method) && damping == Damping::in_kick) continue;
            SCOPED_TRACE(testing::Message() << method.name << ' ' << name_of(damping));
            f(method, Steps{.rate = {60}, .damping = damping});
        }
    }
}

constexpr double grid[] = {0.95, 1.4, 2.05, 3.5, 9, 30};

// v = exp(−c·t) never turns, and the body never moves back.
TEST(LinearDragWarning, IsGivenIfAnyStepMovesBackOrFaster) {
    int warned = 0;
    for_each_damping([&](const Method& method, const Steps& steps) {
        for (const double damping_dt : grid) {
            Bodies bodies(1, Precision::double_);
            bodies.add({.velocity = {1}}, LinearDrag{60 * damping_dt});
            const std::vector<At> run = states_of(bodies, method, steps, 8);
            bool is_wrong = run.size() < 9;
            for (std::size_t i = 1; i < run.size(); ++i)
                is_wrong = is_wrong || run[i].v * run[i - 1].v < -1e-12 ||
                           run[i].x < run[i - 1].x - 1e-12 || run[i].v > run[i - 1].v + 1e-12;
            EXPECT_EQ(!preflight(bodies, method, steps).empty(), is_wrong) << damping_dt;
            warned += is_wrong;
        }
    });
    EXPECT_GT(warned, 40);
}

// The first kick leaves v·(1 − c·dt/2), which is negative from c·dt = 2 on, and the second one
// makes it positive again. A linear drag of 130/s needs more than 65 Hz, one of 200/s 100 Hz.
TEST(LinearDragWarning, IsGivenIfTheVelocityTurnsTwiceInAStep) {
    const Method& verlet = find_method("velocity_verlet");
    const auto slowed = [](double c) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.velocity = {1}}, LinearDrag{c});
        return bodies;
    };
    for (const auto& [c, hertz] : {std::pair{130.0, 66}, {200.0, 101}, {500.0, 251}}) {
        const auto lines = lines_of(slowed(c), verlet, {.rate = {60}, .damping = Damping::in_kick});
        ASSERT_EQ(lines.size(), 1U) << c;
        EXPECT_TRUE(holds(lines[0], "velocity_verlet needs < 2: rate ≥ ")) << lines[0];
        EXPECT_EQ(rate_in(lines[0]), hertz);
        const Steps named{.rate = {hertz}, .damping = Damping::in_kick};
        EXPECT_GT(states_of(slowed(c), verlet, named, 1).back().x, 0) << c;
        EXPECT_TRUE(lines_of(slowed(c), verlet, named).empty()) << c;
        EXPECT_TRUE(lines_of(slowed(c), verlet, {.rate = {60}}).empty()) << c;
    }
}

// The second kick of c·|v|·dt = 3.4 makes −0.7 m/s to 0.13 m/s; the body has moved back by 0.7·dt.
TEST(QuadraticDragWarning, IsGivenIfTheVelocityTurnsTwiceInAStep) {
    Bodies bodies(1, Precision::double_);
    bodies.add({.velocity = {1}}, QuadraticDrag{60 * 3.4});
    const Method& verlet = find_method("velocity_verlet");
    const Steps steps{.rate = {60}, .damping = Damping::in_kick};
    const At next = states_of(bodies, verlet, steps, 1).back();
    EXPECT_NEAR(next.x, -0.7 / 60, 1e-12);
    EXPECT_NEAR(next.v, -0.7 * (1 - 1.7 * 0.7), 1e-12);
    EXPECT_EQ(lines_of(bodies, verlet, steps).size(), 1U);
}

/// The true speed of an overdamped body that starts at rest at 1 m: k/(λ₁ − λ₂)·(e^λ₂t − e^λ₁t).
double true_speed(double omega, double damping_ratio, double t) {
    const double root = std::sqrt(damping_ratio * damping_ratio - 1);
    const double fast = omega * (damping_ratio + root);
    const double slow = omega / (damping_ratio + root);
    return omega * omega / (fast - slow) * (std::exp(-fast * t) - std::exp(-slow * t));
}

// A body creeps to its rest: it is never faster than the truth in the other direction, nor moves
// back, by more than 1 % of the true motion.
TEST(OverdampedWarning, IsGivenIfStepsTurnACreepingBody) {
    int warned = 0;
    for_each_damping([&](const Method& method, const Steps& steps) {
        for (const double damping_ratio : {1.2, 3.0, 30.0})
            for (const double damping_dt : grid) {
                const double omega = 60 * damping_dt / (2 * damping_ratio);
                const Bodies bodies =
                    oscillator(Precision::double_, omega * omega, 60 * damping_dt, 1);
                const std::vector<At> run = states_of(bodies, method, steps, 64);
                double fastest = 0;
                for (int i = 1; i <= 64; ++i)
                    fastest = std::max(fastest, -true_speed(omega, damping_ratio, i / 60.0));
                bool is_wrong = run.size() < 65;
                for (std::size_t i = 1; i < run.size(); ++i)
                    is_wrong = is_wrong || run[i].v > 0.01 * fastest ||
                               run[i].x - run[i - 1].x > 0.01 * std::min(fastest / 60, 1.0) ||
                               run[i].x < -1;
                EXPECT_EQ(!preflight(bodies, method, steps).empty(), is_wrong)
                    << "ζ " << damping_ratio << ", c·dt " << damping_dt;
                warned += is_wrong;
            }
    });
    EXPECT_GT(warned, 100);
}

// λ₂ = −9900/s: implicit midpoint multiplies it by (1 − λ₂·dt/2)/(1 + λ₂·dt/2), which is negative
// below 4950 Hz.
TEST(OverdampedWarning, NamesARateAndAMethodThatTurnNothing) {
    const Bodies bodies = oscillator(Precision::double_, 1e6, 1e4, 1);
    const Method& midpoint = find_method("implicit_midpoint");
    const auto lines = warnings(bodies, midpoint, {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with(
        "spring of body 0: c·dt = 166.7, implicit_midpoint turns it back and needs < 2.0"))
        << lines[0];
    EXPECT_TRUE(lines[0].ends_with(" Hz, or implicit_euler")) << lines[0];
    EXPECT_NEAR(static_cast<double>(rate_in(lines[0])), 4950, 50);
    for (const At& at : states_of(bodies, midpoint, {.rate = {rate_in(lines[0])}}, 300))
        EXPECT_LT(at.v, 1);  // 1 % of the true speed, k/c
    for (const At& at : states_of(bodies, find_method("implicit_euler"), {.rate = {60}}, 60))
        EXPECT_LE(at.v, 0);
    EXPECT_TRUE(warnings(bodies, find_method("implicit_euler"), {60}).empty());
    EXPECT_TRUE(warnings(oscillator(Precision::double_, 1e6, 1e4, 0), midpoint, {60}).empty())
        << "it rests";
    EXPECT_TRUE(warnings(oscillator(Precision::double_, 1e6, 10, 1), midpoint, {60}).empty())
        << "it oscillates";
}

/// Two bodies of 1 kg, 1.5 m apart, on a link of 1 m.
Bodies pair_of(const Link& link) {
    Bodies bodies(2, Precision::double_);
    bodies.add({});
    bodies.add({.position = {1.5}});
    bodies.link(0, 1, link);
    return bodies;
}

// The distance of the two, of mass 1/2 kg, creeps.
TEST(OverdampedWarning, IsGivenForLinks) {
    const Link link{.stiffness = 1e6, .damping = 1e4, .rest_length = 1};
    const auto lines = warnings(pair_of(link), find_method("implicit_midpoint"), {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(
        lines[0].starts_with("link of bodies 0 and 1: c·dt up to 333.3, implicit_midpoint "
                             "turns it back and needs < 2.0"))
        << lines[0];
    EXPECT_TRUE(warnings(pair_of(link), find_method("implicit_euler"), {60}).empty());
    const auto stiff = warnings(pair_of(link), find_method("velocity_verlet"), {60});
    ASSERT_EQ(stiff.size(), 1U);
    EXPECT_TRUE(stiff[0].ends_with(", or implicit_euler")) << stiff[0];
    Bodies relaxed = pair_of(link);
    relaxed.set_position(1, {1});
    EXPECT_TRUE(warnings(relaxed, find_method("implicit_midpoint"), {60}).empty());
}

/// A hanging net of `side`² bodies on ropes or links, stretched by a tenth.
Bodies damped_net(std::size_t side, double damping, bool ropes) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -9.81});
    for (std::size_t i = 0; i < side * side; ++i)
        bodies.add({.position = {1.1 * double(i % side), -1.1 * double(i / side)}});
    const Link link{1e5, damping, 1, ropes};
    for (std::size_t i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) bodies.link(i, i + 1, link);
        if (i + side < side * side) bodies.link(i, i + side, link);
        if (i < side) bodies.link_to_point(i, {1.1 * double(i), 1.1}, link);
    }
    return bodies;
}

/// The largest part of all bodies' speed that changes its sign from step to step, relative to the
/// largest speed of implicit Euler, which damps it, in the steps from 32 to 64.
double alternation(Bodies bodies, const Method& method) {
    const std::size_t count = bodies.size();
    std::vector<Vec3> before(count), middle(count);
    double most = 0;
    for (std::int64_t tick = 0; tick < 64; ++tick) {
        if (bodies.try_step(method, {{60}, tick})) return INFINITY;
        for (std::size_t row = 0; row < count; ++row) {
            const Vec3 now = bodies.velocity(row);
            if (tick >= 32) most = std::max(most, length(now - middle[row] * 2 + before[row]) / 4);
            before[row] = middle[row];
            middle[row] = now;
        }
    }
    return most;
}

// Nets of 18 and 242 freedoms: implicit midpoint rings, implicit Euler does not.
TEST(OverdampedWarning, IsGivenForNetsAndRopes) {
    const Method& midpoint = find_method("implicit_midpoint");
    const Method& euler = find_method("implicit_euler");
    for (const std::size_t side : {std::size_t{3}, std::size_t{11}})
        for (const bool ropes : {false, true}) {
            const Bodies net = damped_net(side, 2e4, ropes);
            const auto lines = warnings(net, midpoint, {60});
            ASSERT_EQ(lines.size(), 1U) << side;
            EXPECT_TRUE(holds(lines[0], "implicit_midpoint turns it back and needs")) << lines[0];
            EXPECT_TRUE(holds(lines[0], "implicit_euler")) << lines[0];
            EXPECT_GT(alternation(net, midpoint), 20 * alternation(net, euler)) << side;
            EXPECT_TRUE(warnings(net, euler, {60}).empty()) << side;
        }
}

}  // namespace
}  // namespace oiler::test
