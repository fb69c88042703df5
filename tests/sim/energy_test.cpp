// SPDX-License-Identifier: MIT
#include "oiler/sim/bodies.hpp"
#include "support/oscillator.hpp"
#include "support/spring.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// A quadratic form xx·x² + xv·x·v + vv·v² of the spring's state.
struct Form {
    long double xx;
    long double xv;
    long double vv;

    long double of(const Bodies& bodies) const {
        const long double x = bodies.position(0)[0];
        const long double v = bodies.velocity(0)[0];
        return xx * x * x + xv * x * v + vv * v * v;
    }
};

/// The step matrix [[p, q], [r, s]] over (x, v).
struct StepMatrix {
    long double p, q, r, s;

    long double determinant() const { return p * s - q * r; }
    /// The form with MᵀQM = det M · Q. For every 2×2 matrix M the area z ∧ Mz = x·(Mz)_v − v·(Mz)_x
    /// obeys Mz ∧ M²z = det M · z ∧ Mz, and −(z ∧ Mz) = −r·x² + (p − s)·x·v + q·v².
    Form form() const { return {-r, p - s, q}; }
};

/// v' = v + (−k·x − b·v)·dt, x' = x + v'·dt.
StepMatrix semi_implicit_matrix(long double dt, long double b) {
    const long double k = stiffness;
    return {1 - k * dt * dt, (1 - b * dt) * dt, -k * dt, 1 - b * dt};
}

/// The relative error of a quadratic form per step of semi-implicit Euler. The velocity has the
/// roundings of k·x, b·v, their difference, the product with dt and the sum; all but the last are
/// smaller by h or more. The position has those of v·dt and the sum. Each is at most round_off of
/// the amplitude, and a quadratic form doubles them.
constexpr double step_error = 2 * (2 + 2) * round_off;

/// The largest |form/(start·decay^n) − 1| over `steps` steps.
double largest_deviation(const Method& method, Rate rate, double b, int steps) {
    const StepMatrix matrix = semi_implicit_matrix(rate.dt(), b);
    const Form form = matrix.form();
    Bodies bodies = article_spring(b);
    long double expected = form.of(bodies);
    long double largest = 0;
    for (int i = 0; i < steps; ++i) {
        bodies.step(method, {rate, i, 1});
        expected *= matrix.determinant();
        largest = std::max(largest, std::abs(form.of(bodies) / expected - 1));
    }
    return static_cast<double>(largest);
}

// For b = 0 the form over dt is v² + ω²x² − ω²·dt·x·v. If all roundings went to one side, the error
// would be steps · step_error = 9e-10. Unbiased roundings are a random walk, √steps · step_error =
// 9e-13. The test asserts the latter, because a bias is a fault too.
TEST(EnergyDrift, SemiImplicitEulerConservesItsModifiedEnergy) {
    constexpr int steps = 1'000'000;
    const double deviation = largest_deviation(find_method("semi_implicit_euler"), {100}, 0, steps);
    RecordProperty("largest_deviation", std::to_string(deviation * 1e15) + "e-15");
    EXPECT_LT(deviation, std::sqrt(steps) * step_error);
    EXPECT_GT(deviation, 0);
}

// The energy grows by 1 + h² per step. The energy and the form differ by a factor within 1 ± h/2.
TEST(EnergyDrift, ExplicitEulerFailsTheSameCheck) {
    constexpr int steps = 1000;
    const double deviation = largest_deviation(find_method("explicit_euler"), {100}, 0, steps);
    const double h = omega / 100;
    const double growth = std::pow(1 + h * h, steps);
    EXPECT_GT(deviation, 1e6 * std::sqrt(steps) * step_error);
    EXPECT_NEAR(deviation, growth - 1, growth * h);
}

struct Band {
    double lowest;
    double highest;
};

Band energy_band(Rate rate, int steps) {
    Bodies bodies = article_spring(0);
    Band band{bodies.energy().total(), bodies.energy().total()};
    for (int i = 0; i < steps; ++i) {
        bodies.step(find_method("semi_implicit_euler"), {rate, i, 1});
        const double energy = bodies.energy().total();
        band = {std::min(band.lowest, energy), std::max(band.highest, energy)};
    }
    return band;
}

// The conserved form is 2E − h·(ωx)·v, and |ωx·v| ≤ E with equality at ωx = ±v. E therefore stays
// between form/(2 + h) and form/(2 − h), from rest between E0/(1 + h/2) and E0/(1 − h/2). 10⁶
// phases less than 1e-4 apart come within 1e-8 of both extremes, where E is stationary.
TEST(EnergyDrift, SemiImplicitEulersEnergyStaysInItsBand) {
    constexpr int steps = 1'000'000;
    for (const int rate : {4, 10, 100}) {
        const double h = omega / rate;
        const double start = 0.5 * stiffness * start_x * start_x;
        const Band band = energy_band({rate}, steps);
        const double slack = std::sqrt(steps) * step_error;
        EXPECT_GE(band.lowest, start / (1 + h / 2) * (1 - slack)) << rate;
        EXPECT_LE(band.highest, start / (1 - h / 2) * (1 + slack)) << rate;
        EXPECT_NEAR(band.lowest, start / (1 + h / 2), 1e-7 * start) << rate;
        EXPECT_NEAR(band.highest, start / (1 - h / 2), 1e-7 * start) << rate;
    }
}

// Under gravity alone v_n is exact. Explicit Euler drifts with the velocity before the kick: its
// drop is g·dt²·n(n − 1)/2, the body is g·dt²·n/2 too high, and each step gains m·g²·dt²/2.
// Semi-implicit Euler drifts with the velocity after the kick, n(n + 1)/2, and loses the same
// energy.
TEST(EnergyDrift, OfEulersProjectilesIsThatOfTheory) {
    constexpr double mass = 2.5;
    constexpr double g = 9.81;
    for (const auto& [method, sign] :
         {std::pair{"explicit_euler", 1}, {"semi_implicit_euler", -1}}) {
        Bodies bodies(3, Precision::double_);
        bodies.set_gravity({0, -g, 0});
        bodies.add({.mass = mass, .position = {1, 2, 3}, .velocity = {20, 30, -10}});
        const double start = bodies.energy().total();
        ASSERT_GT(start, 0);
        for (int n = 1; n <= 1000; ++n) {
            bodies.step(find_method(method), {{100}, n - 1, 1});
            const double expected = sign * n * mass * g * g / (100.0 * 100.0) / 2;
            // Every step rounds a velocity and a height of at most 100 m/s and 250 m twice.
            const double scale = mass * (g * 250 + 100 * 100);
            ASSERT_NEAR(bodies.energy().total() - start, expected, 4 * (n + 1) * round_off * scale)
                << method << " at step " << n;
        }
    }
}

TEST(DampedEnergy, TheModifiedEnergyDecaysByTheDeterminant) {
    for (const int rate : {60, 100}) {
        const int steps = 90 * rate;
        const double deviation =
            largest_deviation(find_method("semi_implicit_euler"), {rate}, damping, steps);
        EXPECT_LT(deviation, std::sqrt(steps) * step_error) << rate;
    }
}

/// The eigenvalues of [[a, c], [c, d]], the larger first.
std::pair<double, double> eigenvalues(double a, double c, double d) {
    const double middle = (a + d) / 2;
    const double radius = std::hypot((a - d) / 2, c);
    return {middle + radius, middle - radius};
}

/// The largest factor by which a step can change the energy: the larger eigenvalue of MᵀM in (ωx,
/// v), where twice the energy is the sum of squares.
double largest_energy_factor(const StepMatrix& matrix) {
    const auto p = static_cast<double>(matrix.p);
    const auto q = static_cast<double>(matrix.q) * omega;
    const auto r = static_cast<double>(matrix.r) / omega;
    const auto s = static_cast<double>(matrix.s);
    return eigenvalues(p * p + r * r, p * q + r * s, q * q + s * s).first;
}

/// The width of the energy's band around the method's form: the ratio of the form's eigenvalues
/// relative to the energy.
double band_of(const Form& form) {
    const auto xx = static_cast<double>(form.xx) / (omega * omega);
    const auto xv = static_cast<double>(form.xv) / omega / 2;
    const auto [larger, smaller] = eigenvalues(xx, xv, static_cast<double>(form.vv));
    return larger / smaller;
}

/// The fraction of phases from which a step raises the energy. In coordinates in which the method's
/// form Q is a circle, the phase turns by a constant angle per step. There the change of energy
/// MᵀEM − E is a form with eigenvalues λ₁ > 0 > λ₂, which is positive within ±atan √(λ₁/−λ₂) of an
/// axis. Its trace and determinant are those of Q⁻¹(MᵀEM − E).
double rising_share(const StepMatrix& m) {
    const Form q = m.form();
    const long double k = stiffness;
    const Form change{k * m.p * m.p + m.r * m.r - k, 2 * (k * m.p * m.q + m.r * m.s),
                      k * m.q * m.q + m.s * m.s - 1};
    const long double q_determinant = q.xx * q.vv - q.xv * q.xv / 4;
    const long double trace =
        (q.vv * change.xx + q.xx * change.vv - q.xv * change.xv / 2) / q_determinant;
    const long double determinant =
        (change.xx * change.vv - change.xv * change.xv / 4) / q_determinant;
    const long double radius = std::sqrt(trace * trace / 4 - determinant);
    const long double ratio = (trace / 2 + radius) / (radius - trace / 2);
    return static_cast<double>(2 * std::atan(std::sqrt(ratio)) / std::numbers::pi_v<long double>);
}

struct Rises {
    int count = 0;
    double largest_in_a_step = 0;
    double largest_in_the_run = 0;  // relative to the decayed energy of any earlier step
};

Rises measure_rises(Rate rate, int steps) {
    Bodies bodies = article_spring(damping);
    const auto decay = static_cast<double>(semi_implicit_matrix(rate.dt(), damping).determinant());
    double before = bodies.energy().total();
    double least = before;
    Rises rises;
    for (int i = 0; i < steps; ++i) {
        bodies.step(find_method("semi_implicit_euler"), {rate, i, 1});
        const double after = bodies.energy().total();
        rises.count += after > before ? 1 : 0;
        rises.largest_in_a_step = std::max(rises.largest_in_a_step, after / before);
        least *= decay;
        rises.largest_in_the_run = std::max(rises.largest_in_the_run, after / least);
        least = std::min(least, after);
        before = after;
    }
    return rises;
}

// Semi-implicit Euler's energy rises on some steps in spite of damping. The step matrix bounds the
// rise. The fraction of such steps is a fraction of phases, with an uncertainty of about 10/5400
// from the four ends of its arcs.
TEST(DampedEnergy, RisesOnSomeStepsWithinTheBoundOfTheStepMatrix) {
    constexpr int steps = 90 * 60;
    const StepMatrix matrix = semi_implicit_matrix(1 / 60.0L, damping);
    const Rises rises = measure_rises({60}, steps);
    const double share = static_cast<double>(rises.count) / steps;
    RecordProperty("rising_share", std::to_string(share));
    EXPECT_NEAR(share, rising_share(matrix), 10.0 / steps);
    EXPECT_GT(rises.largest_in_a_step, 1);
    EXPECT_LE(rises.largest_in_a_step, largest_energy_factor(matrix) * (1 + 2 * step_error));
    EXPECT_GT(largest_energy_factor(matrix), 1);
    EXPECT_LE(rises.largest_in_the_run, band_of(matrix.form()) * (1 + steps * step_error));
    EXPECT_GT(rises.largest_in_the_run, largest_energy_factor(matrix));
}

/// Kinetic and potential energy of one body with one force, 2 axes.
template <class... Force>
Energy energy_of(const Body& body, const Force&... force) {
    Bodies bodies(2, Precision::double_);
    bodies.add(body, force...);
    return bodies.energy();
}

constexpr Body heavy{.mass = 3, .position = {4, -2, 0}, .velocity = {1, 2, 0}};

// ½·3·(1 + 4).
TEST(Energy, OfMotionIsHalfMassTimesSpeedSquared) {
    EXPECT_EQ(energy_of(heavy).kinetic, 7.5);
    EXPECT_EQ(energy_of(heavy).potential, 0);
}

// −3·(0.5·4 + −8·−2).
TEST(Energy, OfGravityIsMinusWeightTimesPosition) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0.5, -8, 0});
    bodies.add(heavy);
    EXPECT_EQ(bodies.energy().potential, -54);
    EXPECT_EQ(bodies.energy().kinetic, 7.5);
    EXPECT_EQ(bodies.energy().total(), -46.5);
}

// ½·6·(3² + 4²), measured from the anchor, for any mass; 6/3 is exact.
TEST(Energy, OfASpringIsHalfStiffnessTimesStretchSquared) {
    const auto energy = energy_of(heavy, Spring{.anchor = {1, 2, 0}, .stiffness = 6, .damping = 9});
    EXPECT_EQ(energy.potential, 75);
    EXPECT_EQ(energy.kinetic, 7.5);
}

TEST(Energy, DragHasNoPotential) {
    EXPECT_EQ(energy_of(heavy, LinearDrag{2}).potential, 0);
    EXPECT_EQ(energy_of(heavy, QuadraticDrag{2}).potential, 0);
    EXPECT_EQ(energy_of(heavy, QuadraticDrag{2}).kinetic, 7.5);
}

// Body i of 20 has mass i + 1, velocity 2 and height i; g is 8, and every fourth body has a spring
// of 2 N/m. Kinetic: Σ 2(i + 1) = 420. Gravity: Σ 8·i(i + 1) = 21280. Springs: Σ i² over 0, 4, …,
// 16 = 480.
TEST(Energy, SumsOverBodies) {
    for (const Precision precision : {Precision::single, Precision::double_}) {
        Bodies bodies(1, precision);
        bodies.set_gravity({-8, 0, 0});
        for (int i = 0; i < 20; ++i) {
            const Body body{.mass = i + 1.0, .position = {double(i), 0, 0}, .velocity = {2, 0, 0}};
            if (i % 4 == 0)
                bodies.add(body, Spring{.stiffness = 2});
            else
                bodies.add(body);
        }
        // 2/(i + 1) and its product are rounded in the columns' precision.
        const double u = precision == Precision::single ? 6e-8 : 1.2e-16;
        EXPECT_EQ(bodies.energy().kinetic, 420);
        EXPECT_NEAR(bodies.energy().potential, 21280 + 480, 2 * u * 480 + 20 * 1.2e-16 * 21760);
    }
}

// Measures of bodies include every axis.

TEST(Deviation, CountsEachAxisAlone) {
    for (const Precision precision : precisions)
        for (int axis = 0; axis < 3; ++axis) {
            Bodies bodies(3, precision);
            bodies.add({.position = {1, 2, 3}});
            Bodies moved = bodies;
            Vec3 by{};
            by[axis] = -0.25;
            moved.set_position(0, Vec3{1, 2, 3} + by);
            EXPECT_EQ(bodies.deviation_from(moved).distance, 0.25) << axis;
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(bodies.deviation_from(moved).along[i], i == axis ? 0.25 : 0) << axis;
        }
}

// The deviation of row 0 is √(3² + 4² + 12²) = 13 m. That of row 1 is larger along z but 12.5 m in
// total.
TEST(Deviation, IsTheLargestOfAllRowsInDistanceAndAlongEachAxis) {
    Bodies bodies(3, Precision::double_);
    for (int i = 0; i < 3; ++i) bodies.add({.position = {1, 1, 1}});
    Bodies moved = bodies;
    moved.set_position(0, {4, 5, 13});
    moved.set_position(1, {1, 1, -11.5});
    const Deviation apart = bodies.deviation_from(moved);
    EXPECT_EQ(apart.distance, 13);
    EXPECT_EQ(apart.along, (Vec3{3, 4, 12.5}));
}

TEST(Deviation, IsNotZeroIfTheSquareOfADifferenceUnderflows) {
    Bodies bodies(3, Precision::double_);
    bodies.add({});
    Bodies moved = bodies;
    moved.set_position(0, {0, 0, 1e-200});
    EXPECT_EQ(bodies.deviation_from(moved).distance, 1e-200);
}

// ½·2·3² = 9 J along one axis; 2·10·5 = 100 J in gravity, ½·6·5² = 75 J on a spring.
TEST(Energy, CountsEachAxisAlone) {
    for (const Precision precision : precisions)
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 unit{};
            unit[axis] = 1;
            Bodies bodies(3, precision);
            bodies.set_gravity(unit * -10.0);
            bodies.add({.mass = 2, .position = unit * 5.0, .velocity = unit * -3.0},
                       Spring{.stiffness = 6});
            EXPECT_EQ(bodies.energy().kinetic, 9) << axis;
            EXPECT_EQ(bodies.energy().potential, 175) << axis;
        }
}

}  // namespace
}  // namespace oiler::test
