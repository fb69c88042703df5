// SPDX-License-Identifier: MIT
#include "oiler/stability/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "oiler/stability/region.hpp"
#include "support/reference.hpp"

namespace {

using oiler::Damping;
using oiler::find_method;
using oiler::Method;
using oiler::spectral_radius;
using oiler::stability_limit;
using oiler::StepMatrix;

// The limit has ten digits, also for an instability 3·10⁻⁴ wide that grows by at most 4·10⁻⁴ per
// step, such as that of blanes_moan_srkn11b from 3.14143 on.
TEST(StabilityLimit, IsWhereTheTraceLeavesItsInterval) {
    const auto limits = reference("stability_limits");
    EXPECT_GE(limits.size(), 30U);
    for (const auto& [name, limit] : limits.items()) {
        const Method& method = find_method(method_named(name));
        // The only table whose coefficients differ from the published ones.
        const double tolerance = name == "calvo_sanz_serna4" ? 1e-9 : 1e-10;
        EXPECT_NEAR(stability_limit(method, method.damping, {1, 0}), number(limit),
                    tolerance * number(limit))
            << name;
    }
}

TEST(StabilityLimit, ScalesWithTheSpring) {
    const Method& method = find_method("rk4");
    EXPECT_NEAR(stability_limit(method, method.damping, {1e6, 0}), std::sqrt(8.0) / 1000, 1e-13);
    EXPECT_NEAR(stability_limit(method, method.damping, {1e-6, 0}), std::sqrt(8.0) * 1000, 1e-7);
}

// With damping alone, explicit methods of order p are stable while their truncated exponential is
// within ±1: z < 2 for p = 1 and 2, and 2.7853 for p = 4 (Hairer & Wanner II, IV.2).
TEST(StabilityLimit, OfDampingAlone) {
    const auto limit = [](const char* name) {
        return stability_limit(find_method(name), Damping::in_kick, {0, 1});
    };
    EXPECT_NEAR(limit("explicit_euler"), 2, 1e-12);
    EXPECT_NEAR(limit("semi_implicit_euler"), 2, 1e-12);
    EXPECT_NEAR(limit("rk2_heun"), 2, 1e-12);
    EXPECT_NEAR(limit("rk4"), 2.785293563405281625, 1e-12);
    EXPECT_TRUE(std::isinf(limit("implicit_euler")));
}

// Velocity Verlet with damping in the drift has the trace 1 + d − z²·(1 − d)/c with d = exp(−c),
// and d as its determinant: it is stable while z·tanh(ζz) < 4ζ, z = ω·dt, however strong the
// damping.
TEST(StabilityLimit, OfOverdampedSprings) {
    const Method& method = find_method("velocity_verlet");
    oiler::Region region(method, Damping::in_drift);
    for (const double zeta : {1.5, 3.0, 10.0, 100.0}) {
        double limit = 4 * zeta;
        for (int i = 0; i < 50; ++i) limit = 4 * zeta / std::tanh(zeta * limit);
        EXPECT_NEAR(stability_limit(method, Damping::in_drift, {1, 2 * zeta}), limit, 1e-9 * limit);
        const auto is_inside = [&](double z) { return region.contains({z, 2 * zeta * z}); };
        EXPECT_TRUE(is_inside(0.99 * limit)) << zeta;
        EXPECT_FALSE(is_inside(1.01 * limit)) << zeta;
        EXPECT_FALSE(is_inside(1e4 * limit)) << zeta;
    }
}

// Explicit Euler on the article's spring is stable for every dt up to b/k = 1/150 s, and for no
// larger one.
TEST(StabilityLimit, OfExplicitEulerOnTheArticlesSpring) {
    EXPECT_NEAR(stability_limit(find_method("explicit_euler"), Damping::in_kick, {15, 0.1}),
                0.1 / 15, 1e-12);
}

TEST(SpectralRadius, IsThatOfTheLargerEigenvalue) {
    EXPECT_NEAR(static_cast<double>(spectral_radius(StepMatrix{0, 1, -1, 0})), 1, 1e-18);
    EXPECT_NEAR(static_cast<double>(spectral_radius(StepMatrix{3, 0, 0, -5})), 5, 1e-18);
    EXPECT_NEAR(static_cast<double>(spectral_radius(StepMatrix{0, 2, -2, 0})), 2, 1e-18);
}

// The spectral radius has an error of the square root of round-off where both eigenvalues meet;
// is_stable does not.
TEST(Stable, IncludesTheEdge) {
    EXPECT_TRUE(oiler::is_stable({1, 0, 0, 1}));
    EXPECT_TRUE(oiler::is_stable({-1, 1, 0, -1}));
    EXPECT_FALSE(oiler::is_stable({1 + 1e-12L, 0, 0, 1}));
    EXPECT_FALSE(oiler::is_stable({0, 1, -1 - 1e-12L, 0}));
}

}  // namespace
