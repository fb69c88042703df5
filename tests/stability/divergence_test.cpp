// SPDX-License-Identifier: MIT
// A run that is no longer finite names the step and body that theory predicts.
#include "oiler/stability/preflight.hpp"
#include "support/explained_step.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{60};

/// Bodies, the third of which is on a spring along z, from 1 m, with ω·dt = h.
Bodies one_on_a_spring(Precision precision, double h) {
    const double omega = h * 60;
    Bodies bodies(3, precision);
    bodies.set_gravity({0, -1, 0});
    bodies.add({.position = {1, 2, 3}, .velocity = {4, 5, 6}});
    bodies.add({.velocity = {7, 8, 9}}, LinearDrag{1});
    bodies.add({.position = {0, 0, 1}}, Spring{.stiffness = omega * omega});
    bodies.add({.position = {3, 2, 1}}, LinearDrag{2});
    return bodies;
}

/// The error message of the run, with `per_call` steps per call.
std::string message_of(Bodies bodies, const char* method, std::int64_t per_call) {
    return line_of_error(Exit::diverged, [&] {
        for (std::int64_t tick = 0; tick < 100'000; tick += per_call)
            explained_step(bodies, find_method(method), {rate, tick, per_call});
    });
}

/// The n of "diverged at step n …".
long step_in(const std::string& line) {
    const std::string start = "diverged at step ";
    EXPECT_TRUE(line.starts_with(start)) << line;
    return std::stol(line.substr(start.size()));
}

/// The first step whose force, k·|z| before the step, overflows. `ln_z` is ln|z| after n steps.
template <class F>
long predicted_step(Precision precision, double h, F ln_z) {
    const double most = std::log(largest_of(precision)) - 2 * std::log(h * 60);
    long n = 0;
    while (ln_z(n) <= most) ++n;
    return n + 1;
}

// z = (1 + h²)^(n/2)·cos(n·atan h). The force overflows first and makes the velocity infinite. The
// position took the velocity before that, which is finite.
TEST(Diverging, ExplicitEulerStopsAtTheStepOfTheory) {
    for (const Precision precision : precisions)
        for (const double h : {0.5, 1.25, 10.0, 1000.0}) {
            SCOPED_TRACE(testing::Message() << name_of(precision) << ", h = " << h);
            const long step = predicted_step(precision, h, [&](long n) {
                return n * std::log1p(h * h) / 2 + std::log(std::abs(std::cos(n * std::atan(h))));
            });
            const Bodies bodies = one_on_a_spring(precision, h);
            const std::string line = message_of(bodies, "explicit_euler", 100'000);
            EXPECT_NEAR(step_in(line), step, 1) << line;
            EXPECT_TRUE(holds(line, ": velocity z of body 2 is no longer finite; "));
            EXPECT_TRUE(holds(line, "; spring of body 2: ω·dt = "));
            EXPECT_TRUE(holds(line, "explicit_euler gains energy at any rate"));
        }
}

// The eigenvalues of a step are λ and 1/λ, λ + 1/λ = 2 − h² < −2. From (1, 0) to (1 − h², …), z =
// A·λⁿ + B·λ⁻ⁿ, A = (1 − h² − 1/λ)/(λ − 1/λ). The position takes the new velocity in the same step
// and is checked first.
TEST(Diverging, SemiImplicitEulerStopsAtTheStepOfTheory) {
    for (const Precision precision : precisions)
        for (const double h : {2.1, 2.4, 10.0, 1000.0}) {
            SCOPED_TRACE(testing::Message() << name_of(precision) << ", h = " << h);
            const double half = (2 - h * h) / 2;
            const double lambda = half - std::sqrt(half * half - 1);
            const double a = (1 - h * h - 1 / lambda) / (lambda - 1 / lambda);
            const long step = predicted_step(precision, h, [&](long n) {
                return std::log(std::abs(a)) + n * std::log(-lambda);
            });
            const Bodies bodies = one_on_a_spring(precision, h);
            const std::string line = message_of(bodies, "semi_implicit_euler", 100'000);
            EXPECT_NEAR(step_in(line), step, 1) << line;
            EXPECT_TRUE(holds(line, ": position z of body 2 is no longer finite; "));
            EXPECT_TRUE(holds(line, "semi_implicit_euler needs < 2: rate ≥ "));
        }
}

// The whole message. 144/s at 60 Hz is ω·dt = 2.4, and 72 Hz is exactly the limit. The range is
// 709.8 − 9.9 e-folds because of ω², and a step grows by 1.2447 e-folds: step 563.
TEST(Diverging, NamesStepCauseAndRemedy) {
    EXPECT_EQ(message_of(one_on_a_spring(Precision::double_, 2.4), "semi_implicit_euler", 1),
              "diverged at step 563 (t = 9.38333 s): position z of body 2 is no longer "
              "finite; spring of body 2: ω·dt = 2.4, semi_implicit_euler needs < 2: rate ≥ 73 Hz, "
              "or implicit_midpoint");
}

TEST(Diverging, HasAMessageThatDoesNotDependOnTheStepsPerCall) {
    for (const char* name : {"explicit_euler", "semi_implicit_euler", "rk4"}) {
        const Bodies bodies = one_on_a_spring(Precision::single, 3);
        EXPECT_EQ(message_of(bodies, name, 100'000), message_of(bodies, name, 7)) << name;
    }
}

// The stable bodies before the divergence are where they would be alone.
TEST(Diverging, DoesNotAffectStableBodies) {
    const Bodies bodies = one_on_a_spring(Precision::double_, 1.9);
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "implicit_euler"}) {
        Bodies stable = bodies;
        EXPECT_FALSE(stable.try_step(find_method(name), {rate, 0, 10'000})) << name;
    }
}

// With negative stiffness the motion grows as cosh(ω·t) with any method. The run ends with the
// usual message.
TEST(Diverging, NegativeStiffnessIsReportedToo) {
    for (const char* name : {"semi_implicit_euler", "rk4"}) {
        Bodies bodies = oscillator(Precision::single, -15, 0, 1);
        const std::string line = line_of_error(Exit::diverged, [&] {
            explained_step(bodies, find_method(name), {rate, 0, 100'000});
        });
        EXPECT_TRUE(line.starts_with("diverged at step ")) << line;
    }
}

/// 1 kg each in rows 1 and 2. A step of 1 s of their damper makes the relative velocity
/// w' = w − 2·1.5·w = −2w: after n steps each body has 2^n m/s exactly.
Bodies doubling_pair(Precision precision) {
    Bodies bodies(1, precision);
    bodies.add({.position = {5}});
    bodies.add({.position = {1}, .velocity = {1}});
    bodies.add({.position = {-1}, .velocity = {-1}});
    bodies.link(1, 2, {.damping = 1.5});
    return bodies;
}

// After 127 (1023) steps each body has 2^127 (2^1023) m/s, which is finite in float (double). Their
// difference is twice that and overflows: the force of step 128 (1024) is infinite.
TEST(DivergingNet, NamesTheStepOfTheFirstInfiniteVelocity) {
    for (const auto& [precision, last] :
         {std::pair(Precision::single, 128), {Precision::double_, 1024}})
        for (const std::int64_t first : {0, 1000})
            for (const std::int64_t per_call : {1, 7, 2000}) {
                SCOPED_TRACE(testing::Message() << name_of(precision) << " from " << first << ", "
                                                << per_call << " per call");
                Bodies bodies = doubling_pair(precision);
                std::optional<Divergence> at;
                for (std::int64_t tick = first; !at; tick += per_call)
                    at = bodies.try_step(find_method("explicit_euler"), {{1}, tick, per_call});
                EXPECT_EQ(at->tick, first + last);
                EXPECT_EQ(at->row, 1U);
                EXPECT_EQ(at->axis, 0);
                EXPECT_EQ(at->of, Divergence::Of::velocity);
            }
}

/// A spring of ω·dt = 5 whose body rests on its anchor, and a stretched link from row 2 to row 1 of
/// ω² = 15552·(1 + 1/3) = 144² s⁻², ω·dt = 2.4.
Bodies resting_spring_and_stretched_link() {
    Bodies bodies(1, Precision::double_);
    bodies.add({}, Spring{.stiffness = 300.0 * 300});
    bodies.add({.mass = 3});
    bodies.add({.position = {1}});
    bodies.link(2, 1, {.stiffness = 15552});
    return bodies;
}

const std::string link_of_2_and_1 =
    "link of bodies 2 and 1: ω·dt up to 2.4, semi_implicit_euler needs < 2: rate ≥ 73 Hz, or "
    "implicit_midpoint";

// Row 1 diverges first and is the second end of its link. The spring has the larger ω·dt, but its
// body does not move.
TEST(DivergingNet, BlamesTheLinkWhoseSecondEndDiverges) {
    const Steps steps{rate, 0, 100'000};
    const Method& method = find_method("semi_implicit_euler");
    Bodies bodies = resting_spring_and_stretched_link();
    const auto at = bodies.try_step(method, steps);
    ASSERT_TRUE(at);
    const std::string line = line_of_error(Exit::diverged, [&] {
        fail_diverged(bodies, *at, method, steps,
                      [](std::size_t row) { return std::to_string(row); });
    });
    EXPECT_TRUE(holds(line, ": position x of body 1 is no longer finite; "));
    EXPECT_TRUE(line.ends_with("; " + link_of_2_and_1)) << line;
}

TEST(DivergingNet, IsWarnedOfWithBothEndsOfTheLink) {
    const Steps steps{.rate = rate};
    const Method& method = find_method("semi_implicit_euler");
    const auto risks = preflight(resting_spring_and_stretched_link(), method, steps);
    ASSERT_EQ(risks.size(), 2U);
    EXPECT_EQ(risks[0].row, 0U);
    EXPECT_FALSE(risks[0].linked);
    EXPECT_EQ(
        describe(risks[1], method, steps, [](std::size_t row) { return std::to_string(row); }),
        link_of_2_and_1);
}

// explicit_euler multiplies a velocity by 1 − c·|v|·dt, which turns it from 1 on. The limit is that
// of any speed, and a higher rate helps from the start.
TEST(QuadraticDrag, ThatDivergedNamesTheLimitOfTheMethod) {
    const auto line_of = [](const char* method, double speed) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.velocity = {speed}}, QuadraticDrag{1});
        return line_of_error(Exit::diverged, [&] {
            for (std::int64_t tick = 0; tick < 100; ++tick)
                explained_step(bodies, find_method(method), {rate, tick, 1});
        });
    };
    const std::string remedy = ": take a higher rate, or implicit_euler";
    for (const double speed : {200.0, 1000.0, 3000.0}) {
        const std::string line = line_of("explicit_euler", speed);
        EXPECT_TRUE(holds(line, remedy)) << line;
        EXPECT_TRUE(holds(line, "not finite") || holds(line, "needs < 1:")) << line;
        const std::string classic = line_of("rk4", speed);
        EXPECT_TRUE(holds(classic, remedy)) << classic;
    }
}

// A chain whose springs turn is tried with no method once its state is not finite.
TEST(CoilChain, ThatDivergedNamesNoMethod) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -10});
    for (int i = 0; i < 8; ++i) bodies.add({.position = {1.0 + i, 0}});
    bodies.link_to_point(0, {}, {.stiffness = 100'000, .rest_length = 1});
    for (std::size_t i = 1; i < 8; ++i)
        bodies.link(i, i - 1, {.stiffness = 100'000, .rest_length = 1});
    const std::string line = line_of_error(Exit::diverged, [&] {
        explained_step(bodies, find_method("rk4"), {rate, 0, 10'000});
    });
    EXPECT_TRUE(holds(line, "take a higher rate, or another method")) << line;
}

// A spring that turns. Its divergence names the remedy of the start, wherever the body has come to.
TEST(CoilSpring, ThatDivergedNamesTheWarningOfItsStart) {
    const NameOfRow name = [](std::size_t row) { return std::to_string(row); };
    const Method& method = find_method("rk4");
    const Steps steps{rate};
    Bodies start(2, Precision::double_);
    start.add({.position = {1, 0.5}}, CoilSpring{.stiffness = 1e6, .rest_length = 1});
    const auto risks = preflight(start, method, steps);
    ASSERT_FALSE(risks.empty());
    const std::string warning = describe(risks.front(), method, steps, name);
    EXPECT_TRUE(holds(warning, "rate ≥ ")) << warning;
    for (const double far : {1e3, 1e150, 1e308}) {
        Bodies now = start;
        now.set_position(0, {far, far});
        const Divergence at{10, 0, 0, Divergence::Of::position};
        const std::string line = line_of_error(
            Exit::diverged, [&] { fail_diverged(now, at, method, steps, name, &start); });
        EXPECT_TRUE(line.ends_with("; " + warning)) << line;
    }
}

/// A body 25 cm from the centre that moves straight at it with 25 cm per step.
Bodies falling_in(Precision precision) {
    Bodies bodies(1, precision);
    bodies.add({.position = {0.25}, .velocity = {-1}}, Attractor{.gm = 1});
    return bodies;
}

// Explicit Euler evaluates the force at the centre in its second step, the others in their first.
// The force is 0/0 there.
TEST(Attractor, HitHeadOnIsReported) {
    const std::map<std::string_view, int> ticks{
        {"explicit_euler", 2}, {"semi_implicit_euler_drift_kick", 1}, {"rk2_heun", 1}};
    for (const Precision precision : precisions)
        for (const auto& at : ticks) {
            Bodies bodies = falling_in(precision);
            const std::string line = line_of_error(Exit::diverged, [&] {
                explained_step(bodies, find_method(at.first), {{4}, 0, 10});
            });
            EXPECT_EQ(step_in(line), at.second) << line;
            EXPECT_TRUE(holds(line, ": velocity x of body 0 is no longer finite; "));
            EXPECT_TRUE(holds(line, "take a higher rate, or another method"));
        }
}

// Newton's iteration does not converge from there, which has its own message. No rate helps a body
// that starts there.
TEST(Attractor, HitByAnImplicitStepHasNoSolution) {
    for (const char* name : {"implicit_euler", "implicit_midpoint"}) {
        Bodies bodies(1, Precision::double_);
        bodies.add({}, Attractor{.gm = 1});
        const std::string line = line_of_error(
            Exit::diverged, [&] { explained_step(bodies, find_method(name), {{4}}); });
        EXPECT_EQ(step_in(line), 1);
        EXPECT_TRUE(holds(line, "found no solution"));
        EXPECT_TRUE(holds(line,
                          "body 0; body 0 is on an attractor, where the force has no "
                          "direction: move the body"));
    }
}

TEST(Attractor, NoMethodStartsFromItsCentre) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            if (is_exact(method)) continue;
            Bodies bodies(2, precision);
            bodies.add({.position = {1, 2}});
            bodies.add({.position = {3, 4}}, Attractor{.centre = {3, 4}, .gm = 1});
            const auto where = bodies.try_step(method, {rate, 0, 5});
            ASSERT_TRUE(where) << method.name;
            EXPECT_EQ(where->tick, 1) << method.name;
            EXPECT_EQ(where->row, 1U) << method.name;
        }
}

}  // namespace
}  // namespace oiler::test
