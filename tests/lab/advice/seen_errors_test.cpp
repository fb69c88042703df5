// SPDX-License-Identifier: MIT
// Scenes whose errors were once told wrongly, because runs were sampled at instants that players do
// not see. Each truth is a closed form.
#include <fmt/core.h>

#include "lab/advice/made_up_clock.hpp"
#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/rates/budget.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double pi = std::numbers::pi;

std::string spring(const std::string& name, double omega, double amplitude) {
    return fmt::format(
        "[[body]]\nname = \"{0}\"\nposition = [{1}]\n[[spring]]\nbody = \"{0}\"\n"
        "anchor = [0.0]\nstiffness = {2:.17g}\n",
        name, amplitude, omega * omega);
}

std::string scene_of(double duration, std::int64_t rate, const std::string& bodies,
                     const std::string& method = "velocity_verlet") {
    return fmt::format("[scene]\naxes = 1\nrate = {}\nduration = {:g}\nmethod = \"{}\"\n{}", rate,
                       duration, method, bodies);
}

Advice advice_of(const MeasuredScene& measured, double tolerance,
                 const std::vector<const char*>& methods) {
    return advise(measured.scene, measured.reference,
                  {.position_error = tolerance, .methods = methods_of(methods)},
                  clock_by_evaluations());
}

/// The largest distance of the drawn lines of a setting from x = A·cos ωt, at 64 instants of each
/// step, of the body in that row.
double truth(const Scene& scene, const Stepping& choice, std::size_t row, double amplitude,
             double omega) {
    World world = make_world(scene, Settings{choice});
    double most = 0;
    while (world.time() < scene.duration) {
        const double from = world.time();
        const double before = world.bodies().position(row)[0];
        world.step();
        const double after = world.bodies().position(row)[0];
        for (int i = 0; i <= 64; ++i) {
            const double t = from + (world.time() - from) * i / 64;
            if (t > scene.duration) break;
            const double line = before + (after - before) * i / 64;
            most = std::max(most, std::abs(line - amplitude * std::cos(omega * t)));
        }
    }
    return most;
}

// A spring of 60 Hz at one step per second: every step is at the crest, 2 m above the trough.
TEST(SeenErrors, OfAFastSpringAtOneStepPerPeriod) {
    MeasuredScene measured(scene_of(3, 1, spring("a", 120 * pi, 1), "exact"));
    EXPECT_NEAR(measured.reference.extent, 2, 1e-3);
    measured.scene.budget.position_error = 1e-3;
    const auto lines = check_budget(measured.scene, Settings{measured.scene.stepping});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_FALSE(lines[0].kept);
    EXPECT_NEAR(lines[0].measured, 2, 0.03);
}

// A spring of 30 Hz: samples at 60 per second fall on its turning points alone.
TEST(SeenErrors, OfASpringAtHalfTheSamplingRate) {
    const MeasuredScene measured(scene_of(3, 60, spring("a", 60 * pi, 1)));
    const Advice advice = advice_of(measured, 1e-3, {"velocity_verlet", "mclachlan_atela4"});
    ASSERT_TRUE(advice.meets);
    const double seen = truth(measured.scene, advice.best->stepping, 0, 1, 60 * pi);
    EXPECT_LE(seen, 1e-3);
    EXPECT_NEAR(advice.best->judgement.position_error, seen, 0.02 * seen);
    // Its phase error ω·t·(ω·dt)²/24 is 1e-2 at 6,600 Hz: it can.
    const Advice verlet = advice_of(measured, 1e-2, {"velocity_verlet"});
    ASSERT_TRUE(verlet.meets);
    const auto rate = static_cast<double>(verlet.best->stepping.rate.steps);
    const double phase = 60 * pi * 3 * std::pow(60 * pi / rate, 2) / 24;
    EXPECT_NEAR(verlet.best->judgement.step_error, phase, 0.05 * phase);
}

// The transient of a stiff damper is over within 1/60 s; rk4 at 4800 Hz has ω·dt of 2.1 there.
TEST(SeenErrors, OfATransient) {
    const MeasuredScene measured(
        scene_of(0.5, 4800, spring("a", 1000, 1) + "damping = 10000.0\n", "rk4"));
    const double error =
        judge(measured.scene, Settings{measured.scene.stepping}, measured.reference).step_error;
    // From rest, λ = 5000 ± √(5000² − 10⁶): x = (λ₁e^(−λ₂t) − λ₂e^(−λ₁t))/(λ₁ − λ₂); rk4 multiplies
    // each part by the series of e^z of degree 4.
    const double fast = 5000 + std::sqrt(24e6);
    const double slow = 1e6 / fast;
    const auto series = [](double z) {
        return 1 + z + z * z / 2 + z * z * z / 6 + z * z * z * z / 24;
    };
    double most = 0;
    for (int n = 0; n <= 2400; ++n) {
        const double t = n / 4800.0;
        const auto part = [&](double rate) {
            return std::pow(series(-rate / 4800), n) - std::exp(-rate * t);
        };
        most = std::max(most, std::abs(fast * part(slow) - slow * part(fast)) / (fast - slow));
    }
    EXPECT_NEAR(error, most, 1e-6 * most);
    EXPECT_GT(most, 1e-3);
}

// 100 m slowly beside 2 m at 60 Hz.
TEST(SeenErrors, OfAFastBodyBesideASlowOne) {
    const MeasuredScene measured(
        scene_of(5, 60, spring("slow", 0.3, 100) + spring("fast", 120 * pi, 2)));
    const Advice advice = advice_of(measured, 0.05, {"exact", "rk4"});
    ASSERT_TRUE(advice.meets);
    EXPECT_LE(truth(measured.scene, advice.best->stepping, 1, 2, 120 * pi), 0.05);
}

// The chord of g·dt²/8 is the same for one body and for many.
TEST(SeenErrors, OfManyBodiesAreThoseOfOne) {
    for (const int bodies : {1, 5000}) {
        const MeasuredScene measured(fmt::format(
            "[scene]\naxes = 2\nrate = 60\nduration = 4.0\n[gravity]\nacceleration = [0.0, "
            "-9.81]\n[[scatter]]\ncount = {}\nseed = 1\nposition_from = [0.0, 0.0]\nposition_to = "
            "[1.0, 1.0]\nvelocity_from = [-9.0, 0.0]\nvelocity_to = [9.0, 20.0]\n",
            bodies));
        const Judgement judgement =
            judge(measured.scene, Settings{{&find_method("exact"), {1}, Precision::double_}},
                  measured.reference);
        EXPECT_NEAR(judgement.position_error, 9.81 / 8, 1e-3) << bodies;
    }
}

// A critically damped spring: methods whose backward drifts overflow are left out, the others are
// compared.
TEST(SeenErrors, OfACriticallyDampedSpringAreCompared) {
    const MeasuredScene measured(scene_of(2, 60, spring("camera", 50, 1) + "damping = 100.0\n"));
    std::vector<const char*> all{"velocity_verlet", "rk4", "yoshida8d_kdk", "mclachlan6_s9_kdk"};
    EXPECT_TRUE(advice_of(measured, 1e-2, all).meets);
}

// At rest on its spring, 100 rad/s: at 30 Hz ω·dt is 3.3. Nothing moves, but a touch would explode.
TEST(SeenErrors, OfASceneAtRestAreThoseAfterATouch) {
    const MeasuredScene measured(
        scene_of(5, 60, "[gravity]\nacceleration = [-10.0]\n" + spring("a", 100, -0.001)));
    const Advice advice = advice_of(measured, 1e-3, {"explicit_euler", "velocity_verlet"});
    ASSERT_TRUE(advice.meets);
    EXPECT_EQ(advice.best->stepping.method->name, "velocity_verlet");
    EXPECT_GE(advice.best->stepping.rate.steps, 50);
}

// Nobody plays a jump at 6 Hz.
TEST(SeenErrors, OfAJumpAreJudgedAtThirtyHertzOrMore) {
    const MeasuredScene measured(
        "[scene]\naxes = 1\nrate = 60\nduration = 1.2\n[gravity]\nacceleration = "
        "[-20.0]\n[[body]]\nvelocity = [9.0]\n");
    EXPECT_GE(advice_of(measured, 0.1, {"velocity_verlet"}).best->stepping.rate.steps, 30);
}

}  // namespace
}  // namespace oiler::test
