// SPDX-License-Identifier: MIT
#include "oiler/stability/stability.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stiffest.hpp"
#include "support/oscillator.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

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

// Backward drifts of strongly damped springs grow until they overflow, which is no error.
TEST(StabilityLimit, IsKnownWhereABackwardDriftOverflows) {
    for (const char* name : {"blanes_moan_srkn14a", "kahan_li8_kdk"})
        for (const double zeta : {20.0, 100.0}) {
            const Method& method = find_method(name);
            const double limit = stability_limit(method, Damping::in_drift, {1, 2 * zeta});
            ASSERT_TRUE(limit > 0 && std::isfinite(limit)) << name << zeta << " " << limit;
            const auto grows = [&](double dt) {
                Bodies bodies(1, Precision::double_);
                bodies.add({.position = {1}, .velocity = {1}},
                           Spring{.stiffness = dt * dt, .damping = 2 * zeta * dt});
                return bodies.try_step(method, {{1}, 0, 100'000, Damping::in_drift}) ||
                       std::abs(bodies.position(0)[0]) > 1e3;
            };
            EXPECT_FALSE(grows(0.99 * limit)) << name << zeta;
            EXPECT_TRUE(grows(1.01 * limit)) << name << zeta;
        }
}

// Velocity Verlet with damping in the drift has the trace 1 + d − z²·(1 − d)/c with d = exp(−c),
// and d as its determinant: it is stable while z·tanh(ζz) < 4ζ, z = ω·dt, however strong the
// damping.
TEST(StabilityLimit, OfOverdampedSprings) {
    const Method& method = find_method("velocity_verlet");
    Region region(method, Damping::in_drift);
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
    EXPECT_TRUE(is_stable({1, 0, 0, 1}));
    EXPECT_TRUE(is_stable({-1, 1, 0, -1}));
    EXPECT_FALSE(is_stable({1 + 1e-12L, 0, 0, 1}));
    EXPECT_FALSE(is_stable({0, 1, -1 - 1e-12L, 0}));
}

// The limits of the methods are those of the literature: semi-implicit Euler ω·dt = 2, rk4 2√2,
// explicit Euler ω·dt = 2ζ up to ζ = 1.

Stiffest stiffest(const Bodies& bodies, const char* method, std::int64_t rate = 100) {
    StiffestFinder finder;
    const Stepping stepping{.method = &find_method(method), .rate = {rate}};
    const auto found = finder.find(StiffestFinder::suspects_of(bodies, stepping), stepping);
    EXPECT_TRUE(found);
    return found.value_or(Stiffest{});
}

// ω = √(1600/1) = 40/s and √(900/0.5) = 42.4/s.
Bodies two_springs() {
    Bodies bodies(1, Precision::double_);
    bodies.add(Body{}, Spring{.stiffness = 1600});
    bodies.add(Body{.mass = 0.5}, Spring{.stiffness = 900});
    return bodies;
}

TEST(Stiffest, IsTheFastestSpring) {
    const Stiffest found = stiffest(two_springs(), "semi_implicit_euler");
    EXPECT_EQ(found.row, 1U);
    EXPECT_FALSE(found.linked);
    EXPECT_NEAR(found.measure, std::sqrt(1800) / 100, 1e-12);
    EXPECT_NEAR(found.limit, 2, 1e-9);
    EXPECT_NEAR(stiffest(two_springs(), "rk4").limit, 2 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(stiffest(two_springs(), "rk4", 50).measure, std::sqrt(1800) / 50, 1e-12);
}

TEST(Stiffest, HasNoLimitOrAlwaysExceedsIt) {
    EXPECT_EQ(stiffest(two_springs(), "explicit_euler").limit, 0);
    EXPECT_TRUE(std::isinf(stiffest(two_springs(), "implicit_midpoint").limit));
    const Bodies alone(1, Precision::double_);
    StiffestFinder finder;
    EXPECT_FALSE(finder.find(StiffestFinder::suspects_of(alone, {}), {}));
}

// ω = 10/s with ζ = 0.5 has c = 10/s: explicit Euler is stable up to ω·dt = 1. ζ = 0.25 has the
// limit 0.5, and is closer to it with ω = 8/s.
TEST(Stiffest, IsTheOneThatIsClosestToItsLimit) {
    Bodies bodies(1, Precision::double_);
    bodies.add(Body{}, Spring{.stiffness = 100, .damping = 10});
    EXPECT_NEAR(stiffest(bodies, "explicit_euler").measure, 0.1, 1e-12);
    EXPECT_NEAR(stiffest(bodies, "explicit_euler").limit, 1, 1e-9);
    bodies.add(Body{}, Spring{.stiffness = 64, .damping = 4});
    EXPECT_EQ(stiffest(bodies, "explicit_euler").row, 1U);
    EXPECT_NEAR(stiffest(bodies, "explicit_euler").limit, 0.5, 1e-9);
}

// Two masses of 1 kg on a spring of 100 N/m swing against each other with ω² = 2·100.
TEST(Stiffest, NamesBothEndsOfALink) {
    Bodies bodies(1, Precision::double_);
    bodies.add(Body{.position = {0}});
    bodies.add(Body{.position = {1}});
    bodies.link(0, 1, Link{.stiffness = 100, .rest_length = 1});
    const Stiffest found = stiffest(bodies, "semi_implicit_euler");
    EXPECT_EQ(found.row + *found.linked, 1U);
    EXPECT_NEAR(found.measure, std::sqrt(200) / 100, 1e-12);
}

// Three masses of 1 kg on three springs of 100 N/m: a triangle breathes with ω² = 3·100, in
// whatever direction it lies. The sum of the springs at two ends would be 4·100. The other
// oscillations have ω² = 1.5·100 twice and 0 three times. The told value may be up to 1 % above.
TEST(Stiffest, IsTheFastestOscillationOfWhatLinksConnect) {
    Bodies bodies(2, Precision::double_);
    for (const double angle : {0.3, 0.3 + 2.0943951023931953, 0.3 + 4.1887902047863905})
        bodies.add(Body{.position = {std::cos(angle), std::sin(angle)}});
    for (const auto& [a, b] : {std::pair{0U, 1U}, {1U, 2U}, {2U, 0U}})
        bodies.link(a, b, Link{.stiffness = 100, .rest_length = std::sqrt(3.0)});
    bodies.add(Body{.position = {9}}, Spring{.stiffness = 250});
    const Stiffest found = stiffest(bodies, "semi_implicit_euler");
    EXPECT_TRUE(found.linked);
    EXPECT_GE(found.measure, std::sqrt(300) / 100 * (1 - 1e-9));
    EXPECT_LE(found.measure, std::sqrt(300) / 100 * 1.01);
    EXPECT_NEAR(found.limit, 2, 1e-9);
}

// Two masses of 1 kg on a damper of 80 N·s/m alone: their distance decays with c = 2·80, and
// explicit Euler is stable up to c·dt = 2.
TEST(Stiffest, IsADamperWithoutASpring) {
    Bodies bodies(1, Precision::double_);
    bodies.add(Body{.position = {0}});
    bodies.add(Body{.position = {1}});
    bodies.link(0, 1, Link{.damping = 80, .rest_length = 1});
    const Stiffest found = stiffest(bodies, "explicit_euler");
    EXPECT_EQ(found.row + *found.linked, 1U);
    EXPECT_NEAR(found.measure, 1.6, 1e-9);
    EXPECT_NEAR(found.limit, 2, 1e-9);
}

// With ζ = 3 and 20, velocity Verlet with damping in the drift is stable while z·tanh(ζz) < 4ζ,
// which is z = 4ζ here. Limits are kept for damping ratios of three digits.
TEST(Stiffest, AnOverdampedSpringHasALimit) {
    for (const double zeta : {3.0, 20.0}) {
        Bodies bodies(1, Precision::double_);
        bodies.add(Body{}, Spring{.stiffness = 1e6, .damping = 2000 * zeta});
        const Stiffest found = stiffest(bodies, "velocity_verlet", 60);
        EXPECT_FALSE(found.is_damper);
        EXPECT_NEAR(found.measure, 1000 / 60.0, 1e-9);
        EXPECT_NEAR(found.limit, 4 * zeta, 0.04 * zeta);
    }
    Bodies bodies(1, Precision::double_);
    bodies.add(Body{}, Spring{.damping = 5});
    EXPECT_TRUE(stiffest(bodies, "explicit_euler").is_damper);
}

// Without a limit, the one that swings faster is named.
TEST(Stiffest, IsTheFasterOneIfAnyIsStable) {
    EXPECT_EQ(stiffest(two_springs(), "implicit_midpoint").row, 1U);
}

// ---- 10⁻⁶ on either side of the stability limit of each method, on the undamped spring. Only ω·dt
// matters: dt = 1 s, ω = h.

constexpr double u = round_off_of(Precision::double_);
constexpr double near_limit = 1e-6;

/// The stability limit; each is measured once, because it takes some tens of milliseconds.
double limit_of(const Method& method) {
    static std::map<std::string_view, double> known;
    const auto [at, is_new] = known.try_emplace(method.name);
    if (is_new) at->second = stability_limit(method, method.damping, {1, 0});
    return at->second;
}

StepMatrix matrix_of(const Method& method, double h) {
    const Oscillation oscillation{h * h, 0};
    return step_matrices(method, method.damping, std::span(&oscillation, 1)).front();
}

/// Row 0 starts with x = 1, row 1 with equal energy in v.
Bodies swinging(double h) {
    Bodies bodies = oscillator(Precision::double_, h * h, 0, 1, 0);
    bodies.add({.velocity = {h}}, Spring{.stiffness = h * h});
    return bodies;
}

struct Size {
    long double x = 0;
    long double v_over_h = 0;
};

/// The largest x and v in steps of det = 1 from (x, v). The form Q = (−vx, xx − vv, xv) of the step
/// matrix obeys MᵀQM = det·Q (see energy_test). If the eigenvalues are complex, its level sets are
/// ellipses that extend by √(Q_vv·Q(x, v)/D) along x and by √(Q_xx·Q(x, v)/D) along v, where
/// D = det − (trace/2)². At the limit of a symplectic method D → 0, and the ellipses grow as
/// 1/√(distance from the limit).
Size extent(const StepMatrix& m, double h, long double x, long double v) {
    const long double d = m.determinant() - m.trace() * m.trace() / 4;
    const long double q = -m.vx * x * x + (m.xx - m.vv) * x * v + m.xv * v * v;
    return {std::sqrt(m.xv * q / d), std::sqrt(-m.vx * q / d) / h};
}

/// The largest x and v of each row in 1000 samples, at prime intervals so that no phase recurs.
std::array<Size, 2> largest_seen(const Method& method, double h) {
    constexpr int per_call = long_run / 1000 - 3;
    Bodies bodies = swinging(h);
    std::array<Size, 2> seen;
    for (int tick = 0; tick < long_run; tick += per_call) {
        bodies.step(method, {{1}, tick, per_call});
        for (const std::size_t row : {0, 1}) {
            seen[row].x = std::max(seen[row].x, std::abs(x_of(bodies, row)));
            seen[row].v_over_h = std::max(seen[row].v_over_h, std::abs(v_of(bodies, row)) / h);
        }
    }
    return seen;
}

void expect_filled(const Method& method, const Size& seen, const Size& most) {
    const auto longest = static_cast<double>(std::max(most.x, most.v_over_h));
    const double rounded = 10 * long_run * roundings(method) * u * longest;
    EXPECT_LE(seen.x, most.x * (1 + rounded)) << method.name;
    EXPECT_LE(seen.v_over_h, most.v_over_h * (1 + rounded)) << method.name;
    if (long_run < 1'000'000) return;
    EXPECT_GT(seen.x, most.x * 0.9999) << method.name;
    EXPECT_GT(seen.v_over_h, most.v_over_h * 0.9999) << method.name;
}

bool has_finite_limit(const Method& method) {
    return limit_of(method) > 0 && std::isfinite(limit_of(method));
}

// Every rounding may start another ellipse, larger than the rounding by the ratio of the motion's
// extent to its start. Within a step of many stages, numbers may be about ten times larger. A
// thousand phases come within (π/1000)²/2 of the ends of the ellipse, so that the bound is also a
// lower one.
TEST(StabilityLimit, JustBelowItMotionFillsTheMethodsEllipse) {
    int symplectic = 0;
    for (const Method& method : methods()) {
        if (!method.symplectic || !has_finite_limit(method)) continue;
        const double h = limit_of(method) * (1 - near_limit);
        const StepMatrix matrix = matrix_of(method, h);
        const auto seen = largest_seen(method, h);
        expect_filled(method, seen[0], extent(matrix, h, 1, 0));
        expect_filled(method, seen[1], extent(matrix, h, 0, h));
        ++symplectic;
    }
    EXPECT_GE(symplectic, 27);
}

// x is (−1)ⁿ·(2n + 1) and v is (−1)ⁿ·4n, all integers.
TEST(StabilityLimit, AtItSemiImplicitEulerGrowsLinearly) {
    Bodies bodies = swinging(2);
    bodies.step(find_method("semi_implicit_euler"), {{1}, 0, 1000});
    EXPECT_EQ(x_of(bodies), 2001);
    EXPECT_EQ(v_of(bodies), 4000);
}

/// ln of the factor by which the amplitude grows in a step, from tick `first` to twice that.
long double growth(const Method& method, double h, int first) {
    Bodies bodies = swinging(h);
    bodies.step(method, {{1}, 0, first});
    const long double before = amplitude(bodies, h);
    bodies.step(method, {{1}, first, first});
    return std::log(amplitude(bodies, h) / before) / first;
}

/// The number of steps to grow by e^`exponent` at `rate` per step.
int steps_to(double exponent, long double rate) {
    return static_cast<int>(std::min(long_run / 2.0L, exponent / std::abs(rate)));
}

// A symplectic method has grown by e^20 when it is measured, and its shrinking part has shrunk by
// as much. The other methods turn and grow every state alike. The roundings of a step appear in its
// growth, and those of the coefficients also in the distance from the limit.
void expect_growth_at(const Method& method, double h) {
    const long double expected = std::log(spectral_radius(matrix_of(method, h)));
    const double tolerance =
        roundings(method) * u * static_cast<double>(1 + std::abs(expected) / near_limit);
    const bool slow = long_run * std::abs(expected) < 2 * 20;  // in an unoptimised build's run
    if (method.symplectic && slow && long_run < 1'000'000) return;
    EXPECT_NEAR(growth(method, h, steps_to(20, expected)), expected, tolerance)
        << method.name << ", h = " << h;
    EXPECT_GT(std::abs(expected), 10 * tolerance) << method.name;
}

TEST(StabilityLimit, JustAboveItMotionGrowsByTheSpectralRadius) {
    for (const Method& method : methods())
        if (has_finite_limit(method)) expect_growth_at(method, limit_of(method) * (1 + near_limit));
}

TEST(StabilityLimit, JustBelowItOtherMethodsShrinkByTheSpectralRadius) {
    for (const Method& method : methods())
        if (has_finite_limit(method) && !method.symplectic)
            expect_growth_at(method, limit_of(method) * (1 - near_limit));
}

// |1 + ih|² = 1 + h² and |1 + ih − h²/2|² = 1 + h⁴/4: 1.2e-13 per step at h = 1e-3.
TEST(StabilityLimit, OfZeroMeansThatEnergyGrowsAtAnyRate) {
    int unlimited = 0;
    for (const Method& method : methods()) {
        if (limit_of(method) != 0) continue;
        for (const double h : {1e-3, 1e-2, 0.1, 1.0}) {
            const long double expected =
                std::log1p(method.order == 1 ? h * h : h * h * h * h / 4) / 2;
            EXPECT_NEAR(growth(method, h, steps_to(100, expected)), expected, roundings(method) * u)
                << method.name << ", h = " << h;
        }
        ++unlimited;
    }
    EXPECT_EQ(unlimited, 4);
}

// At h = 1000 implicit Euler reduces the amplitude to 10⁻³ per step, and to 1e-150 in 50 steps.
TEST(StabilityLimit, OfInfinityMeansThatAThousandRadiansPerStepAreBounded) {
    constexpr double h = 1000;
    int boundless = 0;
    for (const Method& method : methods()) {
        if (!std::isinf(limit_of(method))) continue;
        const int steps = method.symplectic ? long_run : 50;
        const long double factor = method.symplectic ? 1 : 1 / std::sqrt(1 + h * h);
        Bodies bodies = swinging(h);
        bodies.step(method, {{1}, 0, steps});
        EXPECT_NEAR(amplitude(bodies, h) / h / std::pow(factor, steps), 1,
                    steps * roundings(method) * u)
            << method.name;
        ++boundless;
    }
    EXPECT_EQ(boundless, 3);
}

}  // namespace
}  // namespace oiler::test
