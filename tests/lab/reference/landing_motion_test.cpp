// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/landing_motion.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

using namespace lab;

constexpr long double g = 9.81L;

/// The heights of the bounces of a ball that falls from h: h·e^(2n), at times that add up flights.
TEST(LandingMotion, OfABallHasTheKnownHeightsAndTimes) {
    const long double e = 0.8L;
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 2, 0}, {1, 0, 0}}};
    const Plane floor{.normal = {0, 2, 0}, .offset = 1, .restitution = 0.8};
    const auto motion = landing_motion(free, std::span(&floor, 1), 0.25L, 60);
    ASSERT_TRUE(motion);
    const long double height = 2 - 0.75L;
    const long double u = std::sqrt(2 * g * height);
    long double t = u / g;
    for (int n = 1; n <= 20; ++n) {
        // restitution is rounded to double.
        const long double speed = u * std::pow(e, static_cast<long double>(n));
        const auto apex = motion->at(t + speed / g);
        EXPECT_NEAR(static_cast<double>(apex.x[1]),
                    static_cast<double>(0.75L + speed * speed / (2 * g)), 1e-15)
            << n;
        // g·t, with t ≤ 3 s, and restitution rounded to double in n impacts
        EXPECT_NEAR(static_cast<double>(apex.v[1]), 0, 1.2e-16 * g * 3 * n) << n;
        EXPECT_NEAR(static_cast<double>(apex.x[0]), static_cast<double>(t + speed / g), 1e-15);
        t += 2 * speed / g;
    }
    // All bounces are over after u/g + 2·u·e/(g·(1 − e)); then it glides on.
    const long double rest = u / g + 2 * u * e / (g * (1 - e));
    EXPECT_NEAR(static_cast<double>(motion->at(rest + 1e-6L).x[1]), 0.75, 1e-16);
    EXPECT_EQ(static_cast<double>(motion->at(rest + 1).v[1]), 0);
    EXPECT_NEAR(static_cast<double>(motion->at(50).x[0]), 50, 1e-13);
}

// u/(μg) after 4 bounces of no restitution: it slides u²/(2μg) and stays.
TEST(LandingMotion, OfASlideEnds) {
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 0, 0}, {-2, 0, 0}}};
    const Plane floor{.normal = {0, 1, 0}, .friction = 0.5};
    const auto motion = landing_motion(free, std::span(&floor, 1), 0, 10);
    ASSERT_TRUE(motion);
    EXPECT_NEAR(static_cast<double>(motion->at(9).x[0]), static_cast<double>(-4 / g), 1e-17);
    EXPECT_EQ(static_cast<double>(motion->at(9).v[0]), 0);
    const long double half = 1 / g * 2;
    EXPECT_NEAR(static_cast<double>(motion->at(half).v[0]), -1, 1e-17);
}

TEST(LandingMotion, IsUnknownBelowAPlaneAndInACorner) {
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 1, 0}, {}}};
    const Plane above{.normal = {0, 1, 0}, .offset = 2};
    EXPECT_FALSE(landing_motion(free, std::span(&above, 1), 0, 10));
    const Plane corner[] = {{.normal = {1, 1, 0}}, {.normal = {-1, 1, 0}}};
    EXPECT_FALSE(landing_motion(free, corner, 0, 10));
}

}  // namespace
}  // namespace oiler::test
