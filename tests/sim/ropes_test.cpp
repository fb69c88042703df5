// SPDX-License-Identifier: MIT
// Links that only pull.
#include <random>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"
#include "support/oscillator.hpp"
#include "support/rope_fall.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double g = Fall::g;

constexpr Link rope_of(double stiffness, double damping, double length) {
    return {.stiffness = stiffness, .damping = damping, .rest_length = length, .pulls_only = true};
}

template <class F>
void for_each_way_to_step(F f) {
    for (const Method& method : methods())
        if (!is_exact(method))
            for (const Damping damping : {Damping::in_kick, Damping::in_drift}) f(method, damping);
}

constexpr int falls = 16;
double velocity_of(int fall) { return 1 + 0.055 * fall; }

/// The root mean square error of falls at 1.5 s, in all of which the rope has become taut and slack
/// somewhere within a step.
double error_of(const Link& link, const Method& method, int rate) {
    double squares = 0;
    for (int fall = 0; fall < falls; ++fall) {
        Bodies bodies(1, Precision::double_);
        bodies.set_gravity({-g});
        bodies.add({.velocity = {velocity_of(fall)}});
        bodies.link_to_point(0, {}, link);
        bodies.step(method, {{rate}, 0, 3 * rate / 2});
        const auto exact = Fall(link, velocity_of(fall)).at(1.5L);
        const double d = bodies.position(0)[0] - static_cast<double>(exact[0]);
        squares += d * d;
    }
    return std::sqrt(squares / falls);
}

TEST(Ropes, BecomeTautAndSlackInTheFallsThatMeasureTheirOrder) {
    for (const double damping : {0.0, 4.0})
        for (int fall = 0; fall < falls; ++fall) {
            const auto [taut, slack] = Fall(rope_of(200, damping, 2), velocity_of(fall)).kinks();
            EXPECT_GT(taut, 0.7);
            EXPECT_LT(slack, 1.3);
        }
}

void expect_order(double damping, const std::string& name, double order) {
    const Link link = rope_of(200, damping, 2);
    const double coarse = error_of(link, find_method(name), 256);
    const double fine = error_of(link, find_method(name), 2048);
    EXPECT_NEAR(std::log2(coarse / fine) / 3, order, 0.2) << name << ", damping " << damping;
    EXPECT_LT(coarse, 0.3) << name;
}

// The phases of the kinks within a step are even over the falls, apart from 1/√16 = 25 % of their
// spread, which changes a slope over a factor of 8 by 0.12.
TEST(Ropes, HaveOrder2WithoutDamping) {
    expect_order(0, "semi_implicit_euler", 1);
    expect_order(0, "implicit_euler", 1);
    for (const char* name :
         {"velocity_verlet", "position_verlet", "implicit_midpoint", "rk2_heun", "rk4", "pefrl"})
        expect_order(0, name, 2);
}
TEST(Ropes, HaveOrder1WithDamping) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "implicit_euler",
                             "implicit_midpoint", "rk4", "pefrl"})
        expect_order(4, name, 1);
}

TEST(Ropes, HaveNeitherForceNorDampingNorEnergyUpToTheirLength) {
    for_each_way_to_step([](const Method& method, Damping damping) {
        Bodies bodies(2, Precision::double_);
        const std::size_t a = bodies.add({.position = {2, 3}, .velocity = {-0.5, 0.25}});
        const std::size_t b = bodies.add({.mass = 2});
        const std::size_t just_not_taut = bodies.add({.position = {3, 4}});
        bodies.link(a, b, rope_of(1e6, 1e3, 5));
        bodies.link_to_point(a, {2, 3}, rope_of(1e6, 1e3, 3));
        bodies.link(b, just_not_taut, rope_of(1e6, 1e3, 5));
        const Energy start = bodies.energy();
        EXPECT_EQ(start.potential, 0);
        bodies.step(method, {{8}, 0, 8, damping});
        EXPECT_EQ(bodies.velocity(a), (Vec3{-0.5, 0.25})) << method.name;
        EXPECT_EQ(bodies.velocity(b), Vec3{}) << method.name;
        EXPECT_EQ(bodies.velocity(just_not_taut), Vec3{}) << method.name;
        EXPECT_EQ(bodies.energy().total(), start.total());
    });
}

/// A net of 6 × 6 bodies, 1 m apart, some of whose links have numbers of their own.
Bodies net(Precision precision, bool pulls_only, double length) {
    Bodies bodies(2, precision);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            bodies.add({.mass = 1 + 0.1 * row,
                        .position = {1.0 * column + 0.01 * row, 1.0 * row},
                        .velocity = {0.1 * row, 0.05 * column}});
    const auto link = [&](std::size_t a, std::size_t b) {
        const bool is_other = (a + b) % 7 == 0;
        bodies.link(a, b,
                    {.stiffness = is_other ? 9.0 : 5.0,
                     .damping = 0.3,
                     .rest_length = length,
                     .pulls_only = pulls_only});
    };
    for (std::size_t i = 0; i < 36; ++i) {
        if (i % 6 < 5) link(i, i + 1);
        if (i + 6 < 36) link(i, i + 6);
    }
    bodies.link_to_point(
        0, {-1, -1},
        {.stiffness = 5, .damping = 0.3, .rest_length = length, .pulls_only = pulls_only});
    return bodies;
}

// Implicit steps add the damping of ropes after the links: they round otherwise.
TEST(Ropes, ThatStayTautAreLinks) {
    for_each_way_to_step([](const Method& method, Damping damping) {
        Bodies ropes = net(Precision::double_, true, 0.25);
        Bodies links = net(Precision::double_, false, 0.25);
        for (Bodies* bodies : {&ropes, &links}) bodies->step(method, {{64}, 0, 8, damping});
        const double allowed = is_implicit(method) ? 1e-13 : 0;
        EXPECT_LE(ropes.deviation_from(links).distance, allowed) << method.name;
        EXPECT_EQ(ropes.energy().potential > 0, true);
        if (!is_implicit(method)) {
            EXPECT_EQ(ropes.energy().potential, links.energy().potential);
        }
    });
}

/// The accelerations of a net by the formula of the documentation, pair by pair.
std::vector<Vec3> expected_accelerations(const Bodies& bodies) {
    std::vector<Vec3> sums(bodies.size());
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const Link link = bodies.link_at(i);
        const LinkEnds ends = bodies.link_ends(i);
        const Vec3 to = ends.other ? bodies.position(*ends.other) : ends.point;
        const Vec3 moving = ends.other ? bodies.velocity(*ends.other) : Vec3{};
        const Vec3 d = bodies.position(ends.row) - to;
        const double apart = std::hypot(d[0], d[1]);
        if (apart <= link.rest_length) continue;
        const Vec3 u = d * (1 / apart);
        const double pull = link.stiffness * (apart - link.rest_length) +
                            link.damping * dot(bodies.velocity(ends.row) - moving, u);
        sums[ends.row] = sums[ends.row] - u * (pull / bodies.mass(ends.row));
        if (ends.other)
            sums[*ends.other] = sums[*ends.other] + u * (pull / bodies.mass(*ends.other));
    }
    return sums;
}

// Of ropes of 1.003 m, those across are slack and those along the others are slack or taut, within
// one batch of lanes. Each acceleration is the sum of up to 5 forces of less than 1 N.
TEST(Ropes, AreTautOneByOneInABatch) {
    Bodies bodies = net(Precision::double_, true, 1.00003);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        bodies.set_position(i, bodies.position(i) + Vec3{shift(random), shift(random)});
    const std::vector<Vec3> expected = expected_accelerations(bodies);
    const Bodies before = bodies;
    bodies.step(find_method("explicit_euler"), {{1}});
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3 a = bodies.velocity(i) - before.velocity(i);
        EXPECT_LE(length(a - expected[i]), 30 * round_off) << i;
    }
}

/// A player of 70 kg on a hook's rope, thrown towards the hook.
struct Swing {
    static constexpr Vec3 hook{0, 5};
    Bodies bodies{2, Precision::double_};

    Swing() {
        bodies.set_gravity({0, -g});
        bodies.add({.mass = 70, .position = {-3, 3}, .velocity = {3, 4}});
        bodies.link_to_point(0, hook, rope_of(40'000, 600, 4));
    }
    [[nodiscard]] double stretch() const { return length(bodies.position(0) - hook) - 4; }
};

// Until the rope is taut, the flight is a parabola, which velocity_verlet follows but for
// round-off. The energy of the motion never grows. √(k/m) = 23.9/s: at 240 Hz that of
// velocity_verlet, in which the kinetic energy oscillates by (ω·dt)²/4 = 0.25 % while the rope
// holds any, exceeds it by that part of the largest kinetic energy.
TEST(Ropes, SwingAPlayerWhoFlewTowardsTheHook) {
    Swing swing;
    const Vec3 from = swing.bodies.position(0);
    const Vec3 thrown = swing.bodies.velocity(0);
    double least = swing.bodies.energy().total();
    const double kinetic = least - 70 * g * (5 - 4 - 2);
    int taut_at = 0;
    for (int tick = 0; tick < 5 * 240; ++tick) {
        swing.bodies.step(find_method("velocity_verlet"), {{240}, tick, 1});
        const double t = (tick + 1) / 240.0;
        const Vec3 flown = from + thrown * t + Vec3{0, -g * t * t / 2};
        if (taut_at == 0 && swing.stretch() <= 0) {
            EXPECT_LE(length(swing.bodies.position(0) - flown), 1e-12);
        }
        if (taut_at == 0 && swing.stretch() > 0) taut_at = tick;
        const double energy = swing.bodies.energy().total();
        EXPECT_LE(energy, least + 0.0025 * kinetic) << tick;
        least = std::min(least, energy);
    }
    EXPECT_GT(taut_at, 100);
    EXPECT_LT(taut_at, 400);
    // In the end the damped rope carries the player: it is stretched by at least their weight at
    // rest, m·g/k = 17 mm, on average.
    EXPECT_GT(swing.stretch(), 0);
    EXPECT_LT(swing.stretch(), 0.1);
}

// Implicit steps exist at any rate, although damping begins with a jump, and never add energy.
// implicit_euler minimises |w − v|²/2 + the potential, whose minimum is below the start's.
TEST(Ropes, HaveImplicitStepsThatNeverAddEnergy) {
    for (const double damping : {0.0, 30.0, 3000.0})
        for (int fall = 0; fall < 200; ++fall) {
            Bodies bodies(2, Precision::double_);
            bodies.add({.mass = 1, .velocity = {1 + 0.1 * fall, 0.3}});
            bodies.add({.mass = 3, .position = {0.5, 0.5}});
            bodies.link(0, 1, rope_of(1e5, damping, 1));
            bodies.link_to_point(0, {}, rope_of(1e4, damping, 2));
            double before = bodies.energy().total();
            for (int tick = 0; tick < 60; ++tick) {
                bodies.step(find_method("implicit_euler"), {{30}, tick, 1});
                const double now = bodies.energy().total();
                ASSERT_LE(now, before * (1 + 1e-9)) << damping << " " << fall << " " << tick;
                before = now;
            }
        }
}

// The highest oscillation has ω·dt = 20 at 10 Hz. Beyond that, and by implicit_midpoint from there
// on, Newton's iteration may cycle between the sides of kinks.
TEST(Ropes, HangAsChainsOfManyUnderImplicitMethods) {
    for (const auto& [method, rate] : {std::pair{"implicit_euler", 10},
                                       {"implicit_euler", 60},
                                       {"implicit_midpoint", 60},
                                       {"implicit_midpoint", 240}}) {
        Bodies bodies(2, Precision::double_);
        bodies.set_gravity({0, -g});
        for (int i = 0; i < 20; ++i) {
            bodies.add({.mass = 0.2, .position = {0.5 * (i + 1), 0.3 * (i % 3)}});
            const auto row = static_cast<std::size_t>(i);
            if (i > 0) bodies.link(row - 1, row, rope_of(2000, 2, 0.6));
        }
        bodies.link_to_point(0, {}, rope_of(2000, 2, 0.6));
        EXPECT_FALSE(bodies.try_step(find_method(method), {{rate}, 0, 10 * rate}))
            << method << " at " << rate;
    }
}

TEST(Ropes, NeedALength) {
    Bodies bodies(1, Precision::double_);
    bodies.add({});
    EXPECT_EQ(line_of_error(Exit::usage, [&] { bodies.link_to_point(0, {}, rope_of(1, 0, 0)); }),
              "a link that pulls only has a rest length of 0 m and would never be slack: give its "
              "length, or leave pulls_only out");
    bodies.link_to_point(0, {}, rope_of(1, 2, 3));
    EXPECT_TRUE(bodies.link_at(0).pulls_only);
    EXPECT_EQ(bodies.link_at(0).rest_length, 3);
}

}  // namespace
}  // namespace oiler::test
