// SPDX-License-Identifier: MIT
#include <random>

#include "oiler/physics/advance.hpp"
#include "oiler/physics/closed_forms.hpp"
#include "oiler/physics/contacts/support.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "oiler/physics/stepping.hpp"
#include "oiler/stability/stability.hpp"
#include "support/reference.hpp"
#include "support/spring.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

TEST(Stepping, IsDescribedAsItIsRead) {
    const Stepping full{&find_method("rk4"), {60}, Precision::single, Damping::in_kick};
    const Stepping usual{&find_method("exact"), {120}};
    EXPECT_EQ(describe(full), "rk4 at 60 Hz in float, damping in the kick");
    EXPECT_EQ(table_text(full), "rk4, 60 Hz, float, kick");
    EXPECT_EQ(table_text(usual), "exact, 120 Hz, double");
    EXPECT_EQ(caption(full), "rk4 at 60 Hz, float");
    EXPECT_EQ(short_text(usual), "120 Hz exact");
    EXPECT_EQ(difference_text(usual, full), "exact, 120 Hz, double");
    EXPECT_EQ(difference_text(full, full), "");
    for (const Precision precision : {Precision::single, Precision::double_})
        EXPECT_EQ(find_precision(name_of(precision)), precision);
    for (const Damping damping : {Damping::in_kick, Damping::in_drift})
        EXPECT_EQ(find_damping(name_of(damping)), damping);
    EXPECT_FALSE(find_precision("long double") || find_precision(""));
    EXPECT_FALSE(find_damping("Kick") || find_damping(""));
}

TEST(Methods, HaveUniqueNames) {
    std::set<std::string_view> names;
    for (const Method& method : methods()) names.insert(method.name);
    EXPECT_EQ(names.size(), methods().size());
    EXPECT_EQ(names.count("explicit_euler"), 1U);
    EXPECT_EQ(names.count("semi_implicit_euler"), 1U);
}

TEST(Methods, NameTheirSources) {
    for (const Method& method : methods()) {
        EXPECT_FALSE(method.source.empty()) << method.name;
        EXPECT_GE(method.order, 1) << method.name;
        EXPECT_GE(method.evaluations, 0) << method.name;
    }
}

TEST(Methods, AreFoundByName) {
    for (const Method& method : methods()) EXPECT_EQ(&find_method(method.name), &method);
}

std::string refusal_of(const char* name) {
    return line_of_error(Exit::usage, [&] { (void)find_method(name); });
}

TEST(Methods, AnUnknownNameIsAUsageErrorWithSimilarNames) {
    EXPECT_EQ(refusal_of("semi_implicit_oiler"),
              "method semi_implicit_oiler: no such method; did you mean `semi_implicit_euler`?; "
              "`oiler methods` lists all");
    EXPECT_EQ(refusal_of("verlet"),
              "method verlet: no such method; did you mean `velocity_verlet` or "
              "`position_verlet`?; `oiler methods` lists all");
    EXPECT_EQ(refusal_of("xyz"), "method xyz: no such method; `oiler methods` lists all");
    EXPECT_EQ(refusal_of(""), "method : no such method; `oiler methods` lists all");
}

constexpr double k = 15;

/// The larger of the errors after 1 s from two independent starts, so that no phase hides an error
/// of position or velocity. In long double, so that round-off does not hide high orders.
struct Errors {
    long double x = 0;
    long double v = 0;
};

Errors errors_at(const Method& method, Damping damping, double b, int steps) {
    Bodies bodies(1, Precision::extended);
    const std::array<Motion<long double>, 2> starts{{{1, 0}, {0, 4}}};
    for (const auto& start : starts)
        bodies.add({.position = {static_cast<double>(start.x)},
                    .velocity = {static_cast<double>(start.v)}},
                   Spring{.stiffness = k, .damping = b});
    bodies.step(method, {.rate = {steps}, .count = steps, .damping = damping});
    Errors largest;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const auto exact = damped_oscillator<long double>(1, k, b, starts[i], 1);
        largest.x = std::max(largest.x, std::abs(bodies.state(i).x[0] - exact.x));
        largest.v = std::max(largest.v, std::abs(bodies.state(i).v[0] - exact.v));
    }
    return largest;
}

// For errors from 1e-15 to 1e-8, the next term of the error changes the slope, log2 of a ratio of
// errors, by less than 0.1. Round-off is about 1e-18.
void expect_order(const Method& method, Damping damping, double b, int order) {
    int steps = 1024;
    while (errors_at(method, damping, b, 2 * steps).x < 1e-15) steps = steps * 3 / 4;
    const Errors coarse = errors_at(method, damping, b, steps);
    const Errors fine = errors_at(method, damping, b, 2 * steps);
    EXPECT_NEAR(std::log2(coarse.x / fine.x), order, 0.1) << method.name << ", b = " << b;
    EXPECT_NEAR(std::log2(coarse.v / fine.v), order, 0.1) << method.name << ", b = " << b;
}

bool kicks_at_both_ends(const Method& method) {
    const auto stages = std::get<Splitting>(method.rule).stages();
    return stages.front().move == Move::kick && stages.back().move == Move::kick;
}
bool is_exact(const Method& method) { return method.order == exact_order; }
bool is_splitting(const Method& method) { return std::holds_alternative<Splitting>(method.rule); }

TEST(Methods, HaveTheirOrderOnTheSpring) {
    for (const Method& method : methods())
        if (!is_exact(method)) expect_order(method, method.damping, 0, method.order);
}

TEST(Methods, HaveTheirOrderOnTheDampedSpring) {
    for (const Method& method : methods())
        if (!is_exact(method)) expect_order(method, Damping::in_drift, 0.5, method.order);
}

// An explicit velocity-dependent force in the kicks reduces the order to 1.
TEST(Methods, LoseTheirOrderToDampingInTheKicks) {
    for (const Method& method : methods()) {
        if (!is_splitting(method)) continue;
        EXPECT_EQ(damped_order(method, Damping::in_kick), 1) << method.name;
        EXPECT_EQ(damped_order(method, Damping::in_drift), method.order) << method.name;
        expect_order(method, Damping::in_kick, 0.5, 1);
    }
}

TEST(Methods, EvaluateAsOftenAsTheirTableSays) {
    constexpr int steps = 10;
    for (const Method& method : methods()) {
        if (method.evaluations == 0) continue;
        Bodies bodies = article_spring(damping);
        bodies.step(method, {.rate = {100}, .count = steps, .damping = Damping::in_drift});
        const bool first_is_extra = is_splitting(method) && kicks_at_both_ends(method);
        EXPECT_EQ(bodies.evaluations(), steps * method.evaluations + (first_is_extra ? 1 : 0))
            << method.name;
    }
}

// With damping in the kicks the force depends on velocity, and no evaluation can be reused.
TEST(Methods, EvaluateAtEveryKickIfForcesDependOnVelocity) {
    Bodies bodies = article_spring(damping);
    bodies.step(find_method("velocity_verlet"),
                {.rate = {100}, .count = 10, .damping = Damping::in_kick});
    EXPECT_EQ(bodies.evaluations(), 20);
}

// A step that conserves area has an error of round-off, about 1e-18. Other methods of order p have
// an error of about h^(p+1) or h^(p+2)/72, at h = 0.8 far more than 1e-9.
TEST(Methods, ConserveAreaIfTheySaySo) {
    const Oscillation oscillation{0.64, 0};
    for (const Method& method : methods()) {
        const auto matrix = step_matrices(method, method.damping, std::span(&oscillation, 1))[0];
        if (method.symplectic)
            EXPECT_LT(std::abs(matrix.determinant() - 1), 1e-17L) << method.name;
        else
            EXPECT_GT(std::abs(matrix.determinant() - 1), 1e-9L) << method.name;
    }
}

// Equal to the last digit of long double, except one method: its 14 published digits give a sum of
// kicks 6e-15 too large, and here its order conditions hold to 1e-25.
TEST(Splittings, AreThePublishedOnes) {
    const auto published = reference("splittings");
    ASSERT_GE(published.size(), 27U);
    for (const auto& [name, entry] : published.items()) {
        const Method& method = find_method(method_named(name));
        const auto stages = std::get<Splitting>(method.rule).stages();
        ASSERT_EQ(stages.size(), entry.at("stages").size()) << name;
        const long double tolerance = name == "calvo_sanz_serna4" ? 2e-12L : 2e-19L;
        for (std::size_t i = 0; i < stages.size(); ++i) {
            const auto& stage = entry.at("stages")[i];
            EXPECT_EQ(stages[i].move == Move::kick, stage[0] == "K") << name;
            const long double off = stages[i].coefficient - number<long double>(stage[1]);
            EXPECT_LE(std::abs(off), tolerance) << name;
        }
        EXPECT_EQ(method.order, entry.at("order")) << name;
        EXPECT_EQ(method.evaluations, entry.at("force_evaluations_per_step")) << name;
        EXPECT_EQ(method.symmetric, entry.at("symmetric")) << name;
    }
}

/// At most `operations` roundings per step, each no larger than the amplitude.
void expect_reference(const Method& method, double b, Rate rate, int steps, const char* run,
                      const char* name, int operations) {
    const auto state = reference("spring_states").at(run).at("state").at(name);
    Bodies bodies = article_spring(b);
    bodies.step(method, {rate, 0, steps});
    const double tolerance = drift_of_rounding(steps, operations, start_x);
    EXPECT_NEAR(bodies.position(0)[0], number(state[0]), tolerance) << method.name;
    EXPECT_NEAR(bodies.velocity(0)[0], number(state[1]), tolerance * omega) << method.name;
}

// The final sum of RK4 makes four roundings in x and in v; earlier ones are smaller by h.
TEST(Reference, StatesOfTheArticlesSpringMatch) {
    constexpr const char* damped = "damped_dt0.01_n1000";
    const auto expect = [&](const char* method, const char* name, int operations) {
        expect_reference(find_method(method), damping, {100}, 1000, damped, name, operations);
    };
    expect("explicit_euler", "explicit_euler", 10);
    expect("semi_implicit_euler", "semi_implicit_euler_kd/E", 8);
    expect("implicit_euler", "implicit_euler", 12);
    expect("implicit_midpoint", "implicit_midpoint", 12);
    expect("rk4", "rk4_classic", 12);
}

TEST(Reference, StatesOfTheUndampedSpringMatch) {
    constexpr const char* undamped = "undamped_dt0.1_n900";
    const auto expect = [&](const char* method, const char* name, int operations) {
        expect_reference(find_method(method), 0, {10}, 900, undamped, name, operations);
    };
    expect("semi_implicit_euler", "semi_implicit_euler_kd", 8);
    expect("velocity_verlet", "verlet_velocity_kdk", 12);
    expect("rk4", "rk4_classic", 16);
    expect("implicit_euler", "implicit_euler", 12);
    expect("implicit_midpoint", "implicit_midpoint", 12);
}

// The square of the amplitude grows by 1 + h² = 1.15 in each of 900 steps: the amplitude to 1.8e30.
TEST(Reference, ExplicitEulersUndampedGrowthMatches) {
    const auto state =
        reference("spring_states").at("undamped_dt0.1_n900").at("state").at("explicit_euler");
    Bodies bodies = article_spring(0);
    bodies.step(find_method("explicit_euler"), {{10}, 0, 900});
    const double size = std::hypot(number(state[0]) * omega, number(state[1]));
    EXPECT_NEAR(bodies.position(0)[0], number(state[0]), drift_of_rounding(900, 10, size / omega));
    EXPECT_NEAR(bodies.velocity(0)[0], number(state[1]), drift_of_rounding(900, 10, size));
}

// Textbook leapfrog starts its velocities half a step early. From there it takes the steps of
// semi-implicit Euler, through the positions of velocity Verlet.
TEST(Leapfrog, IsSemiImplicitEulerWithAStaggeredStartAndVelocityVerletsPositions) {
    Bodies verlet = article_spring(0);
    Bodies leapfrog = article_spring(0);
    leapfrog.set_velocity(0, {stiffness * start_x * 0.01 / 2, 0, 0});
    for (int i = 0; i < 1000; ++i) {
        verlet.step(find_method("velocity_verlet"), {{100}, i, 1});
        leapfrog.step(find_method("semi_implicit_euler"), {{100}, i, 1});
        ASSERT_NEAR(verlet.position(0)[0], leapfrog.position(0)[0],
                    drift_of_rounding(i + 1, 20, start_x));
    }
}

/// a = t: every stage needs its own time.
struct Clock {
    Vec<double, 1> accelerate(const State<double, 1>&, double t) const { return {t}; }
};

// From rest at t = 2 with dt = 1, v = ∫t = 2.5 exactly for both; RK4's x is 2/2 + 1/6.
TEST(Stages, KnowTheirTime) {
    const Clock clock;
    State<double, 1> state{{0}, {0}};
    advance(make_plan<double>(find_method("rk4"), 1), state, clock, 2);
    EXPECT_DOUBLE_EQ(state.v[0], 2.5);
    EXPECT_DOUBLE_EQ(state.x[0], 1 + 1 / 6.0);
    state = {{0}, {0}};
    advance(make_plan<double>(find_method("velocity_verlet"), 1), state, clock, 2);
    EXPECT_EQ(state.v[0], 2.5);
    EXPECT_EQ(state.x[0], 1);
}

template <class T>
class Supports : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(Supports, Precisions);

// A body thrown towards the edge of a wedge of angle θ presses into the floor or the ceiling; after
// either has taken its part, the rest presses into the other one. What both leave is along the
// edge. Their reactions are up to v/θ, so that round-off leaves some ε·v/θ.
TYPED_TEST(Supports, OfANarrowWedgeAreBothPlanes) {
    using T = TypeParam;
    std::mt19937_64 random(1);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(random);
    };
    for (int i = 0; i < 20000; ++i) {
        const double angle = between(0.02, 0.2);
        const double to_edge = between(0, 6.28);
        const double c = std::cos(to_edge);
        const double s = std::sin(to_edge);
        const double speed = between(1, 20);
        const double along = between(-5, 5);
        std::array<TouchOf<T, 3>, 2> planes{};
        planes[0].normal = {T(0), T(0), T(1)};
        planes[1].normal = {T(std::sin(angle) * c), T(std::sin(angle) * s), T(-std::cos(angle))};
        const Vec<T, 3> push{T(-speed * c - along * s), T(-speed * s + along * c),
                             T(-between(0.01, 0.99) * speed * std::tan(angle))};
        const auto support = Support<T, 3>::against(push, planes, [](const auto&) { return true; });
        ASSERT_EQ(support.size(), 2U) << "case " << i;
        const Vec<T, 3> rest = support.without_push(push);
        const double round_off = 64 * std::numeric_limits<T>::epsilon() * speed / angle;
        for (const auto& plane : planes)
            ASSERT_NEAR(dot(plane.normal, rest), 0, round_off) << "case " << i;
        ASSERT_NEAR(-rest.axis[0] * s + rest.axis[1] * c, along, round_off) << "case " << i;
    }
}

}  // namespace
}  // namespace oiler::test
