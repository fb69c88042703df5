// SPDX-License-Identifier: MIT
// Springs from a body to a fixed point.
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/preflight.hpp"
#include "support/explained_step.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Vec3 point{2, -1};
constexpr double mass = 0.5;

/// A body that a link pulls along a line of direction (0.6, 0.8), released 1.5 m beyond the rest
/// length.
struct Pendant {
    Link link;
    Bodies bodies{2, Precision::double_};

    explicit Pendant(const Link& its) : link(its) {
        bodies.add({.mass = mass, .position = at(link.rest_length + 1.5)});
        bodies.link_to_point(0, point, link);
    }
    static Vec3 at(double distance) { return {2 + 0.6 * distance, -1 + 0.8 * distance}; }

    /// The distance from the closed form of the damped oscillator, m.
    [[nodiscard]] double error(double t) const {
        const double gamma = link.damping / (2 * mass);
        const double omega = std::sqrt(link.stiffness / mass - gamma * gamma);
        const double stretch = 1.5 * std::exp(-gamma * t) *
                               (std::cos(omega * t) + gamma / omega * std::sin(omega * t));
        return length(bodies.position(0) - at(link.rest_length + stretch));
    }
};

/// The error after 1 s.
double error_of(const Link& link, const std::string& method, int rate) {
    Pendant pendant(link);
    pendant.bodies.step(find_method(method), {Rate{rate}, 0, rate});
    return pendant.error(1);
}

// ω = 9.95/s. At 128 and 256 Hz the next order changes the ratio of the errors by ω·dt ~ 8 %.
TEST(PointLinks, MoveABodyAsTheClosedFormWithTheOrderOfTheMethod) {
    for (const double rest_length : {0.0, 3.0}) {
        const Link link{.stiffness = 50, .damping = 1, .rest_length = rest_length};
        for (const auto& [method, order] : {std::pair{"semi_implicit_euler", 1},
                                            {"velocity_verlet", 2},
                                            {"implicit_midpoint", 2},
                                            {"rk2_heun", 2},
                                            {"rk4", 4}}) {
            const double coarse = error_of(link, method, 128);
            const double fine = error_of(link, method, 256);
            EXPECT_NEAR(std::log2(coarse / fine), order, 0.13) << method << " " << rest_length;
            EXPECT_LT(coarse, order == 1 ? 0.3 : 0.02) << method;
        }
    }
}

// A point is a body of infinite mass: one of 10¹⁸ kg moves by 10⁻¹⁸ of the other's way, which its
// position of 2 m rounds away. Bodies beside the pins are linked, in a run and in a scattered link.
// The links to the heavy body are stepped in another order, and round otherwise: 20 steps of at
// most 37 methods' 13 stages round numbers of up to 10 m (and m/s) by 2⁻⁵³ each.
TEST(PointLinks, PullAsAHeavyBody) {
    for (const Method& method : methods()) {
        if (method.order == exact_order) continue;
        for (const Damping damping : {Damping::in_kick, Damping::in_drift}) {
            Bodies pinned(2, Precision::double_);
            for (int i = 0; i < 5; ++i)
                pinned.add({.mass = 1 + 0.25 * i,
                            .position = {0.9 * i, 0.3 * i * i},
                            .velocity = {std::sin(3.0 * i), 1}});
            for (std::size_t i = 0; i < 3; ++i)
                pinned.link(i, i + 1, {.stiffness = 20, .damping = 0.2, .rest_length = 1});
            pinned.link(4, 1, {.stiffness = 5, .damping = 0.1});
            Bodies heavy = pinned;
            const Link pin{.stiffness = 30, .damping = 0.3, .rest_length = 0.5};
            const Link other{.stiffness = 10, .damping = 0.1};
            pinned.link_to_point(0, point, pin);
            pinned.link_to_point(4, point, other);
            heavy.add({.mass = 1e18, .position = point});
            heavy.link(0, 5, pin);
            heavy.link(4, 5, other);
            const Vec3 start = pinned.position(0);
            const Steps steps{Rate{256}, 0, 20, damping};
            pinned.step(method, steps);
            heavy.step(method, steps);
            // Dampers in another order: each of them commutes up to b²·dt²/m² ~ 1e-6 per step.
            const double tolerance =
                damping == Damping::in_drift && method.order > 0 ? 2e-5 : 20 * 13 * 10 * 1.2e-16;
            for (std::size_t row = 0; row < 5; ++row)
                EXPECT_LT(length(pinned.position(row) - heavy.position(row)), tolerance)
                    << method.name << ", row " << row;
            EXPECT_GT(length(pinned.position(0) - start), 0.01) << method.name;
        }
    }
}

TEST(PointLinks, MoveTheSameInWhateverOrderTheyAreAdded) {
    const auto moved = [](bool backwards) {
        Bodies bodies(2, Precision::single);
        bodies.add({.position = {1, 1}});
        bodies.add({.position = {2, 1}});
        for (int i = 0; i < 6; ++i) {
            const int at = backwards ? 5 - i : i;
            bodies.link_to_point(at % 2 == 0, {0.1 * at, 3.0 - at},
                                 {.stiffness = 7.0 + at, .damping = 0.1 * at});
        }
        bodies.step(find_method("velocity_verlet"), {Rate{60}, 0, 30});
        return hash_of(bodies);
    };
    EXPECT_EQ(moved(false), moved(true));
}

// Dampers along lines of directions u and w take the parts lost·(v·u)·u and lost·(v·w)·w, in half a
// step before the drift and, in the reverse order, after it. Another order changes the velocity by
// lost²·v ~ 1e-2 m/s.
TEST(PointLinks, DampInTheReportedOrder) {
    constexpr double dt = 1.0 / 64;
    Bodies bodies(2, Precision::double_);
    bodies.add({.mass = mass, .position = {0.5, 0.25}, .velocity = {3, -2}});
    for (const Vec3& to : {Vec3{5, 1}, Vec3{-3, 2}, Vec3{1, 4}})
        bodies.link_to_point(0, to, {.damping = 12 + to[0], .rest_length = 1});
    Vec3 x = bodies.position(0);
    Vec3 v = bodies.velocity(0);
    const auto damp = [&](std::size_t i) {
        const Vec3 u = normalised(x - bodies.link_ends(i).point);
        const double lost = -std::expm1(-bodies.link_at(i).damping / mass * dt / 2);
        v -= u * (lost * dot(u, v));
    };
    const std::vector<std::size_t> order = bodies.damping_order();
    std::for_each(order.begin(), order.end(), damp);
    x += v * dt;
    std::for_each(order.rbegin(), order.rend(), damp);
    bodies.step(find_method("velocity_verlet"), {Rate{64}, 0, 1, Damping::in_drift});
    EXPECT_LT(length(bodies.velocity(0) - v), 1e-14);
    EXPECT_LT(length(bodies.position(0) - x), 1e-14);
}

TEST(PointLinks, HoldEnergyAndAreNoLongerFeltWhenUnlinked) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.mass = 2, .position = {4, 3}, .velocity = {1, 0}});
    const LinkHandle coil =
        bodies.link_to_point(0, {}, {.stiffness = 10, .damping = 1, .rest_length = 3});
    const LinkHandle spring = bodies.link_to_point(0, {4, 1}, {.stiffness = 6});
    // ½·10·(5 − 3)² and ½·6·2².
    EXPECT_DOUBLE_EQ(bodies.energy().potential, 20 + 12);
    bodies.unlink(coil);
    EXPECT_DOUBLE_EQ(bodies.energy().potential, 12);
    EXPECT_FALSE(bodies.alive(coil));
    EXPECT_TRUE(bodies.alive(spring));
    bodies.unlink(spring);
    bodies.step(find_method("rk4"), {Rate{10}, 0, 10});
    EXPECT_DOUBLE_EQ(bodies.position(0)[0], 5);
    EXPECT_EQ(bodies.link_count(), 0U);
}

// A damped body halves its amplitude every 0.1 s or faster, so that it is below the smallest normal
// number within 1100 of these times. Undamped, it oscillates on.
TEST(PointLinks, BringADampedBodyToRestOnTheirPoint) {
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const char* method : {"semi_implicit_euler", "velocity_verlet", "rk4"})
            for (const bool drag : {false, true}) {
                Bodies bodies(2, precision);
                bodies.add({.position = {1, 0.5}});
                bodies.add({.position = {1e-25, 0}});
                if (drag) bodies.attach(0, LinearDrag{16});
                bodies.link_to_point(0, {}, {.stiffness = 70, .damping = drag ? 0.0 : 16.0});
                bodies.link_to_point(1, {}, {.stiffness = 70});
                bodies.step(find_method(method), {Rate{64}, 0, 110 * 64});
                EXPECT_EQ(bodies.position(0), Vec3{}) << method;
                EXPECT_EQ(bodies.velocity(0), Vec3{}) << method;
                EXPECT_GT(length(bodies.position(1) * 1e20) + length(bodies.velocity(1) * 1e20),
                          method == std::string("rk4") ? 0 : 1e-6)
                    << method;
            }
}

// A body at rest on its point swings about the new one: x = 8·(1 − cos ω·t), ω = 10/s.
TEST(PointLinks, PullToWhereTheirPointIsMoved) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.mass = mass});
    bodies.link_to_point(0, {}, {.stiffness = 0});
    const LinkHandle pin = bodies.link_to_point(0, {}, {.stiffness = 50});
    bodies.move_point(pin, {0, 8});
    EXPECT_EQ(bodies.link_ends(1).point, (Vec3{0, 8}));
    EXPECT_EQ(bodies.link_ends(0).point, Vec3{});
    bodies.step(find_method("rk4"), {Rate{1024}, 0, 1024});
    // The error of rk4 in the angle is (ω·dt)⁴/120 per radian: 7.6e-11 per radian, 10 radians.
    EXPECT_NEAR(bodies.position(0)[1], 8 * (1 - std::cos(10.0)), 8 * 7.6e-10);
    EXPECT_EQ(bodies.position(0)[0], 0);
}

TEST(PointLinks, RefuseNumbersThatAreNotFinite) {
    Bodies bodies(2, Precision::double_);
    bodies.add({});
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto link_to = [&bodies](const Vec3& to, const Link& link) {
        return line_of_error(Exit::usage, [&] { bodies.link_to_point(0, to, link); });
    };
    EXPECT_NE(link_to({nan}, {.stiffness = 1}), "");
    EXPECT_NE(link_to({}, {.stiffness = nan}), "");
    EXPECT_NE(link_to({}, {.stiffness = -1}), "");
    EXPECT_NE(link_to({}, {.stiffness = 1, .damping = -1}), "");
    EXPECT_NE(link_to({0, 0, 1}, {.stiffness = 1}), "");
    EXPECT_EQ(bodies.link_count(), 0U);
}

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

void expect_in(const std::string& part, const std::string& line) { EXPECT_TRUE(holds(line, part)); }

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
        explained_step(copy, verlet, {{12}, 0, 100'000});
    });
    expect_in("link of bodies 0 and 1", line);
    expect_in("ω·dt up to 2.083, velocity_verlet needs < 2: rate ≥ 13 Hz", line);
    Bodies copy = bodies;
    copy.step(verlet, {{13}, 0, 100'000});
    EXPECT_LT(copy.energy().total(), 100 * bodies.energy().total());
}

}  // namespace
}  // namespace oiler::test
