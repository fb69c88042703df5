// SPDX-License-Identifier: MIT
// References of bounces on obstacles against flights in closed form between impacts that are
// bisected here.
#include <fmt/core.h>

#include <functional>

#include "lab/motions.hpp"
#include "oiler/lab/reference/reference.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::test {
namespace {

constexpr Real gravity = 9.81;  // m/s², as the scenes' double
constexpr Real radius = 0.25;   // m, of the ball

/// What the ball meets.
struct Met {
    std::function<Real(const Real3& x, Real t)> gap;  ///< m
    std::function<Real3(const Real3& x, Real t)> normal;
    Real restitution = 0;
    Real friction = 0;
    std::function<Real3(Real t)> velocity = [](Real) { return Real3{}; };  ///< m/s
};

/// x″ = −g·e_y − k·x′: with the terminal velocity w = −g/k·e_y,
/// x(t) = x0 + w·t + (v0 − w)·(1 − e^(−kt))/k.
State3 flown(const State3& from, Real k, Real t) {
    const Real3 g{0, -gravity, 0};
    if (k == 0) return {from.x + from.v * t + g * (t * t / 2), from.v + g * t};
    const Real3 w = g * (1 / k);
    const Real decayed = -std::expm1(-k * t);
    return {from.x + w * t + (from.v - w) * (decayed / k), w + (from.v - w) * (1 - decayed)};
}

/// The normal speed relative to the obstacle turns and keeps the part e; friction takes at most
/// μ·(1 + e) times the normal speed from the speed along it.
State3 bounced(const State3& at, const Met& met, Real t) {
    const Real3 n = met.normal(at.x, t);
    const Real3 u = at.v - met.velocity(t);
    const Real into = -dot(n, u);
    const Real3 along = u + n * into;
    const Real glide = std::sqrt(squared_length(along));
    const Real lost = met.friction * (1 + met.restitution) * into;
    const Real part = lost < glide ? 1 - lost / glide : 0;
    return {at.x, met.velocity(t) + along * part + n * (met.restitution * into)};
}

/// The flights of a ball from 0 s on, by the times at which they begin.
std::vector<std::pair<Real, State3>> flights_of(State3 state, Real k, const std::vector<Met>& all,
                                                Real until) {
    std::vector<std::pair<Real, State3>> flights{{0, state}};
    for (Real t = 0; t < until; t += 0x1p-10L) {
        for (const Met& met : all) {
            const auto gap = [&](Real at) {
                return met.gap(flown(flights.back().second, k, at - flights.back().first).x, at);
            };
            Real low = std::max(t, flights.back().first);
            Real high = t + 0x1p-10L;
            if (gap(high) >= 0) continue;
            for (int i = 0; i < 80; ++i) {
                const Real middle = (low + high) / 2;
                (gap(middle) < 0 ? high : low) = middle;
            }
            const State3 at = flown(flights.back().second, k, low - flights.back().first);
            flights.emplace_back(low, bounced(at, met, low));
        }
    }
    return flights;
}

Scene scene_of(const std::string& position, double drag, double duration,
               const std::string& obstacles) {
    return parse_scene(
        fmt::format("[scene]\naxes = 2\nduration = {}\n[gravity]\nacceleration = [0.0, -9.81]\n"
                    "[[body]]\nposition = [{}]\nlinear_drag = {}\ncontact = 0.25\n{}",
                    duration, position, drag, obstacles),
        "test");
}

/// Expects the flights within the uncertainty of the reference, which is about 10⁻¹² of the extent,
/// the default.
void expect_flights(const Scene& scene, Real k, const std::vector<Met>& met, std::size_t impacts) {
    const Real3 start = to_real(scene.bodies[0].position);
    const auto flights = flights_of({start, {}}, k, met, scene.duration);
    ASSERT_EQ(flights.size(), impacts + 1);
    const Reference reference = make_reference(scene, {});
    EXPECT_EQ(reference.why_no_longer, "");
    const double uncertainty = reference.uncertainties.back().position;
    EXPECT_LE(uncertainty, 1e-11 * reference.extent) << reference.words;
    constexpr int samples = 100;
    for (int i = 1; i <= samples; ++i) {
        const Real t = static_cast<Real>(scene.duration) * i / samples;
        auto flight = flights.end() - 1;
        while (flight->first > t) --flight;
        const State3 truth = flown(flight->second, k, t - flight->first);
        ASSERT_LE(distance(reference.motion->at(0, t).x, truth.x), uncertainty)
            << t << ": " << reference.words;
    }
}

Met circle(const Real3& centre, Real size, Real restitution) {
    return {
        .gap = [=](const Real3& x,
                   Real) { return std::sqrt(squared_length(x - centre)) - size - radius; },
        .normal = [=](const Real3& x,
                      Real) { return (x - centre) * (1 / std::sqrt(squared_length(x - centre))); },
        .restitution = restitution};
}

/// A face through the origin.
Met face(const Real3& normal, Real restitution, Real friction = 0) {
    return {.gap = [=](const Real3& x, Real) { return dot(normal, x) - radius; },
            .normal = [=](const Real3&, Real) { return normal; },
            .restitution = restitution,
            .friction = friction};
}

TEST(FlightsOfObstaclesTest, AreThoseOfAReferenceOf40Digits) {
    // On a circle of 20 m with e = 0.9 and k = 0.5/s: t of the impacts are roots of
    // |x(t) − c| = 20.25 m, and v⁺ = v − 1.9·(n·v)·n.
    const auto flights =
        flights_of({{0.2L, 1.5L, 0}, {}}, 0.5L, {circle({0, -20, 0}, 20, 0.9L)}, 2.2L);
    ASSERT_EQ(flights.size(), 4U);
    EXPECT_NEAR(flights[3].first, 1.9368195402287367L, 1e-15L);
    const State3 last = flown(flights[3].second, 0.5L, 2.2L - flights[3].first);
    EXPECT_NEAR(last.x[0], 0.38086990067350561L, 1e-15L);
    EXPECT_NEAR(last.x[1], 0.56748966669512736L, 1e-15L);
}

TEST(ReferenceOfObstacles, OnACircle) {
    const Scene scene =
        scene_of("0.25, 1.5", 0.5, 2.25,
                 "[[obstacle]]\nshape = \"circle\"\ncentre = [0.0, -20.0]\nradius = 20.0\n"
                 "restitution = 0.9\n");
    expect_flights(scene, 0.5L, {circle({0, -20, 0}, 20, 0.9)}, 3);
}

TEST(ReferenceOfObstacles, OnATurnedBoxWithFriction) {
    const Scene scene = scene_of("0.5, 1.5", 0.5, 0.9375,
                                 "[[obstacle]]\nshape = \"box\"\ncentre = [0.0, 0.0]\n"
                                 "size = [4.0, 0.5]\nangle = 0.25\nrestitution = 0.5\n"
                                 "friction = 0.125\n");
    const Real angle = 0.25L;
    Met met = face({-std::sin(angle), std::cos(angle), 0}, 0.5L, 0.125L);
    met.gap = [gap = met.gap](const Real3& x, Real t) { return gap(x, t) - 0.25L; };
    expect_flights(scene, 0.5L, {met}, 2);
}

// The joint at (0, 1) stands out; the ball leaves it to the left and meets the floor.
TEST(ReferenceOfObstacles, OnAJointOfAChain) {
    const Scene scene = scene_of("-0.125, 2.5", 0.5, 1.5,
                                 "[[chain]]\npoints = [[1.0, 0.875], [0.0, 1.0], [-0.0625, 0.5]]\n"
                                 "restitution = 0.875\n"
                                 "[[obstacle]]\nshape = \"box\"\ncentre = [0.0, -1.0]\n"
                                 "size = [80.0, 2.0]\nrestitution = 0.875\n");
    expect_flights(scene, 0.5L, {circle({0, 1, 0}, 0, 0.875L), face({0, 1, 0}, 0.875L)}, 2);
}

TEST(ReferenceOfObstacles, OnAMovingBoxWithFriction) {
    const Scene scene = scene_of("0.0, 1.5", 0.5, 1.5,
                                 "[[obstacle]]\nshape = \"box\"\ncentre = [0.0, -0.5]\n"
                                 "size = [40.0, 1.0]\nvelocity = [1.0, 0.5]\n"
                                 "restitution = 0.625\nfriction = 0.0625\n");
    Met met = face({0, 1, 0}, 0.625L, 0.0625L);
    met.gap = [](const Real3& x, Real t) { return x[1] - 0.5L * t - radius; };
    met.velocity = [](Real) { return Real3{1, 0.5L, 0}; };
    expect_flights(scene, 0.5L, {met}, 3);
}

// The top moves by 0.25 m·sin(2πt/1.5 s).
TEST(ReferenceOfObstacles, OnASwingingPlatform) {
    const Scene scene = scene_of("0.0, 2.25", 0, 2.25,
                                 "[[obstacle]]\nshape = \"box\"\ncentre = [0.0, -0.5]\n"
                                 "size = [4.0, 1.0]\nswing = [0.0, 0.25]\nperiod = 1.5\n"
                                 "restitution = 0.75\n");
    const Real omega = 2 * std::acos(Real(-1)) / 1.5L;
    Met met = face({0, 1, 0}, 0.75L);
    met.gap = [=](const Real3& x, Real t) { return x[1] - 0.25L * std::sin(omega * t) - radius; };
    met.velocity = [=](Real t) { return Real3{0, 0.25L * omega * std::cos(omega * t), 0}; };
    expect_flights(scene, 0, {met}, 3);
}

}  // namespace
}  // namespace oiler::test
