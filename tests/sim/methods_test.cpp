// SPDX-License-Identifier: MIT
#include "oiler/sim/methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "oiler/core/error.hpp"
#include "oiler/sim/advance.hpp"
#include "oiler/sim/closed_forms.hpp"
#include "oiler/sim/forces.hpp"
#include "support/reference.hpp"
#include "support/spring.hpp"

namespace {

using oiler::advance;
using oiler::Bodies;
using oiler::find_method;
using oiler::make_plan;
using oiler::Method;
using oiler::methods;
using oiler::Move;
using oiler::Splitting;
using oiler::Stage;
using oiler::State;
using oiler::Tableau;
using oiler::Vec;

TEST(Methods, HaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const Method& method : methods()) names.insert(method.name);
    EXPECT_EQ(names.size(), methods().size());
    EXPECT_EQ(names.count("explicit_euler"), 1U);
    EXPECT_EQ(names.count("semi_implicit_euler"), 1U);
}

TEST(Methods, SayWhereTheyComeFrom) {
    for (const Method& method : methods()) {
        EXPECT_FALSE(method.source.empty()) << method.name;
        EXPECT_GE(method.order, 1) << method.name;
        EXPECT_GE(method.evaluations, 1) << method.name;
    }
}

TEST(Methods, AreFoundByName) {
    for (const Method& method : methods()) EXPECT_EQ(&find_method(method.name), &method);
}

TEST(Methods, AnUnknownNameIsAUsageErrorThatNamesTheChoices) {
    try {
        static_cast<void>(find_method("semi_implicit_oiler"));
        FAIL() << "found";
    } catch (const oiler::Error& error) {
        const std::string line = error.what();
        EXPECT_EQ(error.exit(), oiler::Exit::usage);
        EXPECT_NE(line.find("semi_implicit_oiler"), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        for (const Method& method : methods())
            EXPECT_NE(line.find(method.name), std::string::npos) << line;
    }
}

using Number = long double;  // so that round-off leaves high orders to be seen
constexpr Number k = 15;

/// The engine's own spring, so that a method may treat its damping in its own way.
oiler::Forces<Number, 1> spring(Number b) {
    oiler::Forces<Number, 1> forces;
    using Force = oiler::SpringForce<Number, 1>;
    std::get<Force>(forces.list) = Force{.anchor = {0}, .stiffness = k, .damping = b};
    forces.present[1] = true;
    return forces;
}

template <int Axes, class Physics>
State<Number, Axes> run(const Method& method, State<Number, Axes> state, const Physics& physics,
                        Number duration, int steps) {
    const Number dt = duration / steps;
    const auto plan = make_plan<Number>(method, dt);
    for (int i = 0; i < steps; ++i) advance(plan, state, physics, static_cast<double>(i * dt));
    return state;
}

struct Errors {
    Number x;
    Number v;
};

/// After 1 s, the larger of the errors from two independent starts, so that neither position nor
/// velocity can be right by the luck of a phase.
Errors errors_at(const Method& method, Number b, int steps) {
    Errors largest{0, 0};
    for (const oiler::Motion<Number> start : {oiler::Motion<Number>{1, 0}, {0, 4}}) {
        const auto exact = oiler::damped_oscillator<Number>(1, k, b, start, 1);
        const auto end = run<1>(method, {{start.x}, {start.v}}, spring(b), 1, steps);
        largest.x = std::max(largest.x, std::abs(end.x[0] - exact.x));
        largest.v = std::max(largest.v, std::abs(end.v[0] - exact.v));
    }
    return largest;
}

// At h = ω·dt = order/264 the next term of the error is smaller by about that: it moves the slope,
// log2 of a ratio of errors, by less than 0.02·order. Round-off, 1e-17, stays below the errors of
// order 8, 1e-15.
void expect_order(const Method& method, Number b) {
    const int steps = 1024 / method.order;
    const Errors coarse = errors_at(method, b, steps);
    const Errors fine = errors_at(method, b, 2 * steps);
    ASSERT_GT(fine.x, 1e-16) << method.name;
    EXPECT_NEAR(std::log2(coarse.x / fine.x), method.order, 0.1) << method.name << ", b = " << b;
    EXPECT_NEAR(std::log2(coarse.v / fine.v), method.order, 0.1) << method.name << ", b = " << b;
}

TEST(Methods, HaveTheirOrderOnTheSpring) {
    for (const Method& method : methods()) expect_order(method, 0);
}

TEST(Methods, HaveTheirOrderOnTheDampedSpring) {
    for (const Method& method : methods()) expect_order(method, 0.1L);
}

/// a = −K·x with a K that couples the axes, symmetric as that of every potential.
struct Coupled {
    mutable int calls = 0;

    Vec<Number, 2> accelerate(const State<Number, 2>& state, double) const {
        ++calls;
        return {-(15 * state.x[0] + 4 * state.x[1]), -(4 * state.x[0] + 7 * state.x[1])};
    }
};

TEST(Methods, EvaluateAsOftenAsTheySay) {
    for (const Method& method : methods()) {
        const Coupled physics;
        run<2>(method, {{1, 2}, {3, 4}}, physics, 1, 10);
        EXPECT_EQ(physics.calls, 10 * method.evaluations) << method.name;
    }
}

using Matrix = std::array<std::array<Number, 4>, 4>;  // [column][row] over x, y, vx, vy

Matrix step_matrix(const Method& method, Number dt) {
    Matrix matrix{};
    for (std::size_t column = 0; column < 4; ++column) {
        std::array<Number, 4> unit{};
        unit[column] = 1;
        const auto end = run<2>(method, {{unit[0], unit[1]}, {unit[2], unit[3]}}, Coupled{}, dt, 1);
        matrix[column] = {end.x[0], end.x[1], end.v[0], end.v[1]};
    }
    return matrix;
}

/// The largest entry of MᵀJM − J: how far a step is from conserving x ∧ v.
Number symplectic_defect(const Matrix& matrix) {
    Number largest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            const auto& a = matrix[i];
            const auto& b = matrix[j];
            const Number area = a[0] * b[2] - a[2] * b[0] + a[1] * b[3] - a[3] * b[1];
            const Number unit = j == i + 2 ? 1 : i == j + 2 ? -1 : 0;
            largest = std::max(largest, std::abs(area - unit));
        }
    return largest;
}

// A symplectic step has only round-off, some 1e-18; one that is not, of order p, misses by about
// h^(p+1) or h^(p+2)/72, at h = 0.8 far more than 1e-9.
TEST(Methods, AreSymplecticWhenTheySaySo) {
    for (const Method& method : methods()) {
        const Number defect = symplectic_defect(step_matrix(method, 0.2L));
        if (method.symplectic)
            EXPECT_LT(defect, 1e-16L) << method.name;
        else
            EXPECT_GT(defect, 1e-9L) << method.name;
    }
}

constexpr std::array<long double, 6> rk4_a{0.5L, 0, 0.5L, 0, 0, 1};
constexpr std::array<long double, 4> rk4_b{1 / 6.0L, 1 / 3.0L, 1 / 3.0L, 1 / 6.0L};
constexpr std::array<long double, 4> rk4_c{0, 0.5L, 0.5L, 1};
constexpr Method rk4{.name = "rk4 by hand",
                     .order = 4,
                     .evaluations = 4,
                     .symplectic = false,
                     .rule = Tableau{rk4_a, rk4_b, rk4_c},
                     .source = "Kutta 1901"};

constexpr std::array verlet_stages{Stage{Move::kick, 0.5L}, Stage{Move::drift, 1},
                                   Stage{Move::kick, 0.5L}};
constexpr Method verlet{.name = "Verlet by hand",
                        .order = 2,
                        .evaluations = 2,
                        .symplectic = true,
                        .rule = Splitting{verlet_stages},
                        .source = "Verlet 1967"};

/// `operations` roundings a step at most, each no larger than the amplitude.
void expect_reference(const Method& method, double b, oiler::Rate rate, int steps, const char* run,
                      const char* name, int operations) {
    const auto state = reference("spring_states").at(run).at("state").at(name);
    Bodies bodies = article_spring(b);
    bodies.step(method, {rate, 0, steps});
    const double tolerance = drift_of_rounding(steps, operations, start_x);
    EXPECT_NEAR(bodies.position(0)[0], number(state[0]), tolerance) << method.name;
    EXPECT_NEAR(bodies.velocity(0)[0], number(state[1]), tolerance * omega) << method.name;
}

// The final sum of RK4 makes four roundings in x and in v, what comes before is smaller by h.
TEST(Tableaus, ClassicalRungeKuttaComesOutOfItsTable) {
    expect_reference(rk4, damping, {100}, 1000, "damped_dt0.01_n1000", "rk4_classic", 12);
    expect_reference(rk4, 0, {10}, 900, "undamped_dt0.1_n900", "rk4_classic", 16);
}

TEST(Splittings, VelocityVerletComesOutOfItsStages) {
    expect_reference(verlet, 0, {10}, 900, "undamped_dt0.1_n900", "verlet_velocity_kdk", 12);
}

TEST(Tableaus, AndSplittingsByHandAreWhatTheySay) {
    expect_order(rk4, 0);
    expect_order(rk4, 0.1L);
    expect_order(verlet, 0);
    EXPECT_GT(symplectic_defect(step_matrix(rk4, 0.2L)), 1e-9L);
    EXPECT_LT(symplectic_defect(step_matrix(verlet, 0.2L)), 1e-16L);
    const Coupled physics;
    run<2>(rk4, {{1, 2}, {3, 4}}, physics, 1, 10);
    EXPECT_EQ(physics.calls, 40);
}

/// a = t, of which every stage must be told its own time.
struct Clock {
    Vec<double, 1> accelerate(const State<double, 1>&, double t) const { return {t}; }
};

// From rest at t = 2 with dt = 1: v = ∫t = 2.5 for both, exactly; RK4's x = 2/2 + 1/6.
TEST(Tableaus, AndSplittingsKnowTheTimeOfAStage) {
    State<double, 1> state{{0}, {0}};
    advance(make_plan<double>(rk4, 1), state, Clock{}, 2);
    EXPECT_DOUBLE_EQ(state.v[0], 2.5);
    EXPECT_DOUBLE_EQ(state.x[0], 1 + 1 / 6.0);
    state = {{0}, {0}};
    advance(make_plan<double>(verlet, 1), state, Clock{}, 2);
    EXPECT_EQ(state.v[0], 2.5);
    EXPECT_EQ(state.x[0], 1);
}

}  // namespace
