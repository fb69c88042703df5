// SPDX-License-Identifier: MIT
// Errors that accumulate over 10⁶ and 10⁸ steps of the undamped spring.
#include "oiler/stability/stability.hpp"
#include "support/oscillator.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double u = round_off_of(Precision::double_);
constexpr double k = 15;

/// The quadratic form that a step of det = 1 conserves, see energy_test.
struct Form {
    long double xx, xv, vv;

    explicit Form(const StepMatrix& m) : xx(-m.vx), xv(m.xx - m.vv), vv(m.xv) {}
    long double of(const Bodies& bodies) const {
        const long double x = x_of(bodies);
        const long double v = v_of(bodies);
        return xx * x * x + xv * x * v + vv * v * v;
    }
};

StepMatrix matrix_of(const Method& method, double h) {
    const Oscillation oscillation{h * h, 0};
    return step_matrices(method, method.damping, std::span(&oscillation, 1)).front();
}

/// The slope of the line through `values` at 0, 1, 2, … by least squares.
long double slope_of(const std::vector<long double>& values) {
    const auto n = static_cast<long double>(values.size());
    long double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += (static_cast<long double>(i) - (n - 1) / 2) * values[i];
    return sum * 12 / (n * (n * n - 1));
}

/// The number of blocks of a long run. Energies are sampled at their ends, relative to the start.
constexpr int blocks = 200;
constexpr std::int64_t block = long_run / blocks;

struct Course {
    std::vector<long double> own;
    std::vector<long double> energy;  // the true energy, sampled likewise
};
Course course_of(const Method& method, const Form& form, double h) {
    Bodies bodies = oscillator(Precision::double_, h * h, 0, 1);
    const long double start = form.of(bodies);
    Course course;
    for (int i = 0; i < blocks; ++i) {
        course.own.push_back(form.of(bodies) / start);
        course.energy.push_back(std::pow(amplitude(bodies, h) / h, 2.0L));
        bodies.step(method, {{1}, i * block, block});
    }
    return course;
}

/// The ratio of the largest to the smallest true energy on a level set of the form: the ratio of
/// its eigenvalues over (h·x, v).
long double width_of(const Form& form, long double h) {
    const long double middle = (form.xx / (h * h) + form.vv) / 2;
    const long double radius = std::hypot((form.xx / (h * h) - form.vv) / 2, form.xv / (2 * h));
    return (middle + radius) / (middle - radius);
}

/// The largest slope that random roundings explain. The line through a random walk of n steps, each
/// of r roundings of up to u and doubled by the squares, has the slope 0 ± 2·√(r/3)·u·√(6/5n). The
/// limit is four times that. A bias of one rounding per step would be a slope of 2·u, about √n
/// times as steep.
double random_slope(const Method& method) {
    return 4 * 2 * std::sqrt(roundings(method) / 3.0 * 1.2 / long_run) * u;
}

// Kicks and drifts conserve area for any rounding of their coefficients, and so does a step of
// implicit midpoint: their energy errors are random. The true energy oscillates within the band of
// the modified energy, without a trend.
TEST(LongRun, NoSymplecticMethodsEnergyHasATrend) {
    constexpr double h = 0.1;
    int symplectic = 0;
    for (const Method& method : methods()) {
        if (!method.symplectic || is_exact(method)) continue;
        SCOPED_TRACE(method.name);
        const Form form(matrix_of(method, h));
        const Course course = course_of(method, form, h);
        EXPECT_NEAR(slope_of(course.own) / block, 0, random_slope(method));
        const auto [least, most] = std::minmax_element(course.energy.begin(), course.energy.end());
        EXPECT_LE(*most / *least, width_of(form, h) * (1 + std::sqrt(long_run) * 100 * u));
        EXPECT_GT(*most, *least);
        ++symplectic;
    }
    EXPECT_GE(symplectic, 28);
}

// The four coefficients of its step are right to the last digit. Their determinant differs from 1
// by a rounding or two, which every step adds to the energy.
TEST(LongRun, TheExactMethodsEnergyHasATrendOfARoundingPerStep) {
    const Method& method = find_method("exact");
    const Course course = course_of(method, Form(matrix_of(method, 0.1)), 0.1);
    const auto slope = static_cast<double>(slope_of(course.own) / block);
    RecordProperty("roundings_a_step", std::to_string(slope / u));
    EXPECT_LT(std::abs(slope), 2 * u);
}

// |R(ih)|² < 1 for RK4: every step loses energy, and not by round-off.
TEST(LongRun, RK4LosesTheEnergyOfTheReference) {
    for (const auto& [rate, run] :
         {std::pair(Rate{10}, "undamped_90s_dt_0.1"), {Rate{4}, "undamped_90s_dt_0.25"}}) {
        const int steps = static_cast<int>(90 * rate.steps);
        Bodies bodies = oscillator(Precision::double_, k, 0, 1000);
        const double start = bodies.energy().total();
        const Method& method = find_method("rk4");
        bodies.step(method, {rate, 0, steps});
        const double lost = 100 * (1 - bodies.energy().total() / start);
        const double rounded = 100 * 2 * steps * roundings(method) * u;
        EXPECT_NEAR(lost, number(reference("article").at(run).at("rk4_energy_lost_percent")),
                    rounded);
    }
}

#ifdef NDEBUG
constexpr std::int64_t hundred_million = 100'000'000;
#else
constexpr std::int64_t hundred_million = 100'000;
#endif

/// The article's spring, from 1 m at rest, after 10⁸ steps in one call: 11.6 days at 100 Hz.
struct Far {
    long double x;
    long double v;
    double energy;  // relative to the start
};
Far hundred_million_steps(const char* method) {
    Bodies bodies = oscillator(Precision::double_, k, 0, 1);
    bodies.step(find_method(method), {{100}, 0, hundred_million});
    return {x_of(bodies), v_of(bodies), bodies.energy().total() / (k / 2)};
}

/// sin(θ/2) = ω·dt/2, with dt rounded to double.
const long double half_h = std::sqrt(15.0L) * Rate{100}.dt<double>() / 2;
const long double theta = 2 * std::asin(half_h);

/// The random walk of the relative energy error, see energy_test. Each kick rounds the velocity,
/// each drift the position, and a quadratic form doubles the roundings.
double walk(int moves) { return std::sqrt(static_cast<double>(hundred_million)) * 4 * moves * u; }

/// The tolerance of the phase, rad. No conserved form bounds the phase, so that a bias of the
/// roundings accumulates. One rounding per step to one side is allowed; the measured error is 6e-11
/// rad, 0.006 of that.
constexpr double phase = hundred_million * u;

// From rest x = cos((n + ½)·θ)/cos(θ/2) and v = −2·tan(θ/2)·sin(n·θ)/dt, as in the reference.
TEST(HundredMillionSteps, OfSemiImplicitEulerEndAtTheReference) {
    const Far far = hundred_million_steps("semi_implicit_euler");
    const long double dt = Rate{100}.dt<double>();
    const long double form = far.v * far.v + k * far.x * far.x - k * dt * far.x * far.v;
    EXPECT_NEAR(form / k, 1, walk(2));
    EXPECT_GE(far.energy, 1 / (1 + half_h) - walk(2));
    EXPECT_LE(far.energy, 1 / (1 - half_h) + walk(2));
    const auto n = static_cast<long double>(hundred_million);
    EXPECT_NEAR(far.x, std::cos((n + 0.5L) * theta) / std::cos(theta / 2), phase);
    EXPECT_NEAR(far.v, -2 * std::tan(theta / 2) * std::sin(n * theta) / dt, phase * 4);
}

// x = cos(n·θ), and v² + ω²·(1 − h²/4)·x² is constant.
TEST(HundredMillionSteps, OfVelocityVerletEndAtTheReference) {
    const Far far = hundred_million_steps("velocity_verlet");
    const long double part = 1 - half_h * half_h;
    EXPECT_NEAR((far.v * far.v + k * part * far.x * far.x) / (k * part), 1, walk(3));
    EXPECT_GE(far.energy, part - walk(3));
    EXPECT_LE(far.energy, 1 + walk(3));
    EXPECT_NEAR(far.x, std::cos(static_cast<long double>(hundred_million) * theta), phase);
}

// Time is a quotient of two integers. n times a rounded 1/60 s differs from it for some n.
TEST(HundredMillionSteps, HaveTheirTimeToTheLastDigit) {
    for (std::int64_t n = 99'999'900; n <= 100'000'000; ++n) {
        EXPECT_EQ(Rate{60}.time(n), static_cast<double>(n) / 60);
        EXPECT_EQ(Rate{100}.time(n), static_cast<double>(n) / 100);
        EXPECT_EQ((Rate{3, 10}.time(n)), static_cast<double>(10 * n) / 3);
    }
    EXPECT_EQ(Rate{1'000'000'000}.time(100'000'000), 0.1);
    EXPECT_EQ(Rate{60}.time(6'000'000'000'000), 1e11);
}

}  // namespace
}  // namespace oiler::test
