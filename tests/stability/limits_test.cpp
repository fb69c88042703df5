// SPDX-License-Identifier: MIT
// 10⁻⁶ on either side of the stability limit of each method, on the undamped spring. Only ω·dt
// matters: dt = 1 s, ω = h.
#include "oiler/stability/stability.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

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
