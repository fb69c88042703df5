// SPDX-License-Identifier: MIT
// What adds up over a million and a hundred million steps of the undamped spring.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "oiler/stability/stability.hpp"
#include "support/oscillator.hpp"
#include "support/reference.hpp"

namespace {

using namespace oiler::test;
using oiler::Bodies;
using oiler::find_method;
using oiler::Method;
using oiler::methods;
using oiler::Oscillation;
using oiler::Precision;
using oiler::Rate;
using oiler::StepMatrix;

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
    const Oscillation swing{h * h, 0};
    return step_matrices(method, method.damping, std::span(&swing, 1)).front();
}

/// The slope of the line through `values` at 0, 1, 2, … by least squares.
long double slope_of(const std::vector<long double>& values) {
    const auto n = static_cast<long double>(values.size());
    long double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += (static_cast<long double>(i) - (n - 1) / 2) * values[i];
    return sum * 12 / (n * (n * n - 1));
}

/// The method's own energy over that of the start, at the ends of 200 blocks of a long run.
constexpr int blocks = 200;
constexpr std::int64_t block = long_run / blocks;

struct Course {
    std::vector<long double> own;
    std::vector<long double> energy;  // the true one, likewise
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

/// How many times the largest of equal values of the form are the smallest, by true energy: the
/// ratio of its eigenvalues over (h·x, v).
long double width_of(const Form& form, long double h) {
    const long double middle = (form.xx / (h * h) + form.vv) / 2;
    const long double radius = std::hypot((form.xx / (h * h) - form.vv) / 2, form.xv / (2 * h));
    return (middle + radius) / (middle - radius);
}

/// The slope of a line through a random walk of n steps of √r roundings of up to u each, and twice
/// that in squares, is 0 ± 2·√(r/3)·u·√(6/5n); four times that happens to no method in practice. A
/// bias of one rounding a step would be a slope of 2·u, some √n times as steep.
double random_slope(const Method& method) {
    return 4 * 2 * std::sqrt(roundings(method) / 3.0 * 1.2 / long_run) * u;
}

// Kicks and drifts conserve area whatever their coefficients round to, and so does a step of
// implicit midpoint: what they gain is roundings that come and go. The true energy stays in the
// band that this leaves it, and swings, but has no trend of its own.
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

// The four numbers of its step are right to the last place, and what they miss of det = 1, a
// rounding or two, is gained in every step alike.
TEST(LongRun, TheExactMethodsEnergyHasATrendOfARoundingAStep) {
    const Method& method = find_method("exact");
    const Course course = course_of(method, Form(matrix_of(method, 0.1)), 0.1);
    const auto slope = static_cast<double>(slope_of(course.own) / block);
    RecordProperty("roundings_a_step", std::to_string(slope / u));
    EXPECT_LT(std::abs(slope), 2 * u);
}

// |R(ih)|² < 1 for RK4: every step takes its part, which is no round-off.
TEST(LongRun, RK4LosesWhatTheArticleHasItLose) {
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

/// 1 m at rest after 10⁸ steps of the article's spring, eleven and a half days at 100 Hz, in one
/// call.
struct Far {
    long double x;
    long double v;
    double energy;  // over that of the start
};
Far hundred_million_steps(const char* method) {
    Bodies bodies = oscillator(Precision::double_, k, 0, 1);
    bodies.step(find_method(method), {{100}, 0, hundred_million});
    return {x_of(bodies), v_of(bodies), bodies.energy().total() / (k / 2)};
}

/// sin(θ/2) = ω·dt/2 of the double dt.
const long double half_h = std::sqrt(15.0L) * Rate{100}.dt<double>() / 2;
const long double theta = 2 * std::asin(half_h);

/// As in energy_test: the velocity gathers a sum and smaller roundings in each kick, the position
/// those of a drift, and squares take them twice. Up or down, they walk at random.
double walk(int moves) { return std::sqrt(static_cast<double>(hundred_million)) * 4 * moves * u; }

/// No form keeps account of the phase, and the least bias of the roundings adds up. A rounding a
/// step to one side is allowed; measured is 6e-11 rad, 0.006 of that.
constexpr double phase = hundred_million * u;

// From rest x = cos((n + ½)·θ)/cos(θ/2) and v = −2·tan(θ/2)·sin(n·θ)/dt, as the reference has it.
TEST(HundredMillionSteps, OfSemiImplicitEulerAreWhereTheyShouldBe) {
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

// x = cos(n·θ), and v² + ω²·(1 − h²/4)·x² stays.
TEST(HundredMillionSteps, OfVelocityVerletAreWhereTheyShouldBe) {
    const Far far = hundred_million_steps("velocity_verlet");
    const long double part = 1 - half_h * half_h;
    EXPECT_NEAR((far.v * far.v + k * part * far.x * far.x) / (k * part), 1, walk(3));
    EXPECT_GE(far.energy, part - walk(3));
    EXPECT_LE(far.energy, 1 + walk(3));
    EXPECT_NEAR(far.x, std::cos(static_cast<long double>(hundred_million) * theta), phase);
}

// The quotient of two integers; n times a rounded sixtieth of a second is another number for some.
TEST(HundredMillionSteps, TakeTheirTimeToTheLastDigit) {
    for (std::int64_t n = 99'999'900; n <= 100'000'000; ++n) {
        EXPECT_EQ(Rate{60}.time(n), static_cast<double>(n) / 60);
        EXPECT_EQ(Rate{100}.time(n), static_cast<double>(n) / 100);
        EXPECT_EQ((Rate{3, 10}.time(n)), static_cast<double>(10 * n) / 3);
    }
    EXPECT_EQ(Rate{1'000'000'000}.time(100'000'000), 0.1);
    EXPECT_EQ(Rate{60}.time(6'000'000'000'000), 1e11);
}

}  // namespace
