// SPDX-License-Identifier: MIT
// Attracted bodies that obstacles keep away from the attractor have no warning of its centre.
#include "oiler/sim/bodies.hpp"
#include "support/explained_step.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A body of radius 0.1 m at 3 m from an attractor of 1 m³/s² with a speed across of `speed`.
Bodies falling(double speed, const std::vector<Obstacle>& obstacles) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {3}, .velocity = {0, speed}, .contact = Contact{0.1}},
               Attractor{.gm = 1});
    for (const Obstacle& obstacle : obstacles) bodies.add_obstacle(obstacle);
    return bodies;
}

/// The least and the largest distance from the attractor in 60 s at 60 Hz.
std::pair<double, double> distances(Bodies bodies, const Method& method) {
    double least = INFINITY, most = 0;
    for (std::int64_t tick = 0; tick < 3600; ++tick) {
        if (bodies.try_step(method, {{60}, tick})) return {0, INFINITY};
        least = std::min(least, length(bodies.position(0)));
        most = std::max(most, length(bodies.position(0)));
    }
    return {least, most};
}

constexpr std::array tried{"velocity_verlet", "rk4", "explicit_euler", "implicit_midpoint"};

// The body lands on the obstacle, at a distance that each shape gives, and stays within 3 m.
TEST(LandingBody, HasNoWarningOfTheCentre) {
    struct Case {
        Obstacle obstacle;
        double least;  ///< m
    };
    const std::vector<Case> cases{
        {{.shape = CircleShape{{0, 0}, 0.5}, .restitution = 0.5}, 0.6},
        {{.shape = CircleShape{{0, 0}, 0.01}}, 0.11},
        {{.shape = BoxShape{{0, 0}, {1, 1}, 0.3}, .restitution = 0.5}, 0.6},
        {{.shape = HalfSpaceShape{{1, 0}, 0.5}, .friction = 1}, 0.6},
        {{.shape = SegmentShape{{1, -2}, {1, 2}}, .one_way = Vec3{1, 0}}, 1.1},
    };
    for (const char* name : tried)
        for (const double speed : {0.0, 0.05})
            for (const Case& one : cases) {
                const Method& method = find_method(name);
                if (method.order == 1 && one.least < 0.5 && speed > 0) continue;  // it misses
                const Bodies bodies = falling(speed, {one.obstacle});
                const auto [least, most] = distances(bodies, method);
                EXPECT_GT(least, one.least - 0.01) << name;
                EXPECT_LT(most, 3.01) << name;
                EXPECT_TRUE(preflight(bodies, method, {{60}}).empty())
                    << name << ' ' << one.least << ' ' << speed;
                EXPECT_FALSE(preflight(falling(speed, {}), method, {{60}}).empty()) << name;
            }
}

// It passes an obstacle that is elsewhere, behind, one-way in its direction, an area, or one that
// may have moved away.
TEST(FallingBody, KeepsItsWarningIfAnObstacleMayNotStopIt) {
    const std::vector<Obstacle> cases{
        {.shape = CircleShape{{0, 5}, 0.5}},
        {.shape = HalfSpaceShape{{1, 0}, -0.5}},
        {.shape = SegmentShape{{1, -2}, {1, 2}}, .one_way = Vec3{-1, 0}},
        {.shape = CircleShape{{0, 0}, 0.5}, .solid = false},
        {.shape = CircleShape{{0, 0}, 0.5}, .velocity = {0.1, 0}},
        {.shape = CircleShape{{0, 0}, 0.5}, .swing = Swing{{2, 0}, 3}},
    };
    for (const char* name : tried)
        for (const double speed : {0.0, 0.05})
            for (std::size_t i = 0; i < cases.size(); ++i)
                EXPECT_FALSE(
                    preflight(falling(speed, {cases[i]}), find_method(name), {{60}}).empty())
                    << name << ' ' << i;
    Bodies ghost = falling(0, {{.shape = CircleShape{{0, 0}, 0.5}}});
    ghost.set_contact(0, {});
    EXPECT_FALSE(warnings(ghost, find_method("velocity_verlet"), {60}).empty());
}

}  // namespace
}  // namespace oiler::test
