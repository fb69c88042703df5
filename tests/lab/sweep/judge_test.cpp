// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/judge.hpp"

#include <complex>

#include "lab/motions.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double start_x = 1000;
const double omega = std::sqrt(15.0);

/// The article's spring, with `rate` samples per second for rates up to 60.
Scene spring(std::int64_t rate, double duration, double damping = 0, double stiffness = 15) {
    Scene scene;
    scene.stepping.rate.steps = rate;
    scene.duration = duration;
    scene.bodies = {{.position = {start_x, 0, 0}}};
    scene.springs = {{.stiffness = stiffness, .damping = damping}};
    return scene;
}

Reference reference_of(const Scene& scene) {
    ReferenceEffort effort;
    effort.most_work = 1e6;
    return make_reference(scene, effort);
}

Settings with(const Method& method, std::int64_t rate) {
    return {.stepping = {.method = &method, .rate = {rate}}};
}
Settings with(const char* method, std::int64_t rate) { return with(find_method(method), rate); }

/// A position and a velocity of the spring.
struct ExactState {
    Real x;
    Real v;
};
ExactState exact(Real t, Real damping = 0, Real stiffness = 15) {
    const State3 state = article_motion(damping, stiffness)(t);
    return {state.x[0], state.v[0]};
}

/// Energy relative to that at the start.
double energy_of(const ExactState& s) {
    return static_cast<double>((s.v * s.v + 15 * s.x * s.x) / (15 * start_x * start_x));
}

/// The largest differences from the exact motion: at the steps, and of the drawn lines.
struct Errors {
    double x = 0;
    double v = 0;
    double energy = 0;
    double drawn = 0;
};

/// The errors of states at consecutive steps, the drawn ones at 200 points of each line up to
/// `until`, s. The energy scale is that of the start.
Errors errors_of(const std::vector<ExactState>& run, std::int64_t rate, double until,
                 double damping = 0, double stiffness = 15) {
    constexpr int points = 200;
    const auto dt = 1 / static_cast<Real>(rate);
    Errors errors;
    const auto add = [](double& most, Real difference) {
        most = std::max(most, static_cast<double>(std::abs(difference)));
    };
    for (std::size_t n = 0; n < run.size(); ++n) {
        const Real t = static_cast<Real>(n) * dt;
        if (t > until) break;
        const ExactState expected = exact(t, damping, stiffness);
        add(errors.x, run[n].x - expected.x);
        add(errors.v, run[n].v - expected.v);
        add(errors.energy, energy_of(run[n]) - energy_of(expected));
        for (int point = 0; point <= points && n + 1 < run.size(); ++point) {
            const Real share = static_cast<Real>(point) / points;
            if (t + share * dt <= until)
                add(errors.drawn, run[n].x + (run[n + 1].x - run[n].x) * share -
                                      exact(t + share * dt, damping, stiffness).x);
        }
    }
    return errors;
}

/// The errors of a method that is stepped here.
Errors stepped_errors(const Method& method, std::int64_t rate, double duration, double damping = 0,
                      double stiffness = 15) {
    Bodies bodies = oscillator(Precision::double_, stiffness, damping, start_x);
    std::vector<ExactState> run;
    const auto steps = static_cast<std::int64_t>(std::ceil(duration * static_cast<double>(rate)));
    for (std::int64_t tick = 0; tick <= steps; ++tick) {
        if (tick > 0) bodies.step(method, {{rate}, tick - 1, 1});
        run.push_back({x_of(bodies), v_of(bodies)});
    }
    return errors_of(run, rate, duration, damping, stiffness);
}

/// The errors of exact steps: those of chords.
Errors chord_errors(std::int64_t rate, double duration, double damping) {
    std::vector<ExactState> run;
    const auto steps = static_cast<std::int64_t>(std::ceil(duration * static_cast<double>(rate)));
    for (std::int64_t tick = 0; tick <= steps; ++tick)
        run.push_back(exact(static_cast<Real>(tick) / static_cast<Real>(rate), damping));
    return errors_of(run, rate, duration, damping);
}

/// Expects the judge's errors at the steps to equal the given ones up to round-off: of long double
/// for motions, of double for energies. Errors as drawn are known to 1 %.
void expect_errors(const Judgement& judgement, const Errors& errors) {
    EXPECT_TRUE(judgement.stable);
    EXPECT_TRUE(judgement.complete);
    EXPECT_NEAR(judgement.position_error, errors.drawn, 0.012 * errors.drawn);
    EXPECT_NEAR(judgement.step_error, errors.x, 1e-12 * start_x);
    EXPECT_NEAR(judgement.velocity_error, errors.v, 1e-12 * omega * start_x);
    EXPECT_NEAR(judgement.energy_drift, errors.energy, 1e-3 * errors.energy + 1e-14);
}

/// Expects the judge to find the error of a method with a wrong coefficient, and another error for
/// the right one.
void expect_told(const Method& broken, const char* right) {
    const Scene scene = spring(100, 10, 0.125);
    const Reference reference = reference_of(scene);
    const Judgement judgement = judge(scene, with(broken, 100), reference);
    expect_errors(judgement, stepped_errors(broken, 100, 10, 0.125));
    const Judgement sound = judge(scene, with(right, 100), reference);
    expect_errors(sound, stepped_errors(find_method(right), 100, 10, 0.125));
    EXPECT_GT(judgement.step_error, sound.step_error + 0.1);
}

// A kick of 0.5001 makes the spring stiffer by 1e-4: after 10 s it is ahead by ω·t·0.5e-4 = 2 mrad.
TEST(Judge, FindsAWrongSplitting) {
    Method broken = find_method("velocity_verlet");
    broken.rule = Splitting{{Move::kick, 0.5001L}, {Move::drift, 1.0L}, {Move::kick, 0.5001L}};
    expect_told(broken, "velocity_verlet");
}

TEST(Judge, FindsAWrongTableau) {
    Method broken = find_method("rk4");
    broken.rule = Tableau{{{1 / 2.0L}, {0, 1 / 2.0L}, {0, 0, 1}},
                          {1 / 6.0L + 1e-4L, 1 / 3.0L, 1 / 3.0L, 1 / 6.0L},
                          {0, 1 / 2.0L, 1 / 2.0L, 1}};
    expect_told(broken, "rk4");
}

// The second body's spring is four times as stiff and has the larger error.
TEST(Judge, ReportsTheLargestErrorOfAllBodies) {
    Scene scene = spring(60, 5);
    scene.bodies.push_back(scene.bodies[0]);
    scene.springs.push_back({.body = 1, .stiffness = 60});
    const Judgement judgement = judge(scene, with("velocity_verlet", 60), reference_of(scene));
    const Errors errors = stepped_errors(find_method("velocity_verlet"), 60, 5, 0, 60);
    EXPECT_NEAR(judgement.step_error, errors.x, 1e-12 * start_x);
    EXPECT_NEAR(judgement.velocity_error, errors.v, 1e-12 * 2 * omega * start_x);
    EXPECT_NEAR(judgement.position_error, errors.drawn, 0.012 * errors.drawn);
}

TEST(Judge, MeasuresStraightLinesBetweenSteps) {
    const Scene scene = spring(60, 10, 0.125);
    const Reference reference = reference_of(scene);
    for (const std::int64_t rate : {1, 4, 7, 45, 90}) {
        SCOPED_TRACE(rate);
        const Errors errors = chord_errors(rate, 10, 0.125);
        EXPECT_GT(errors.drawn, 0.1);
        const Judgement judgement = judge(scene, with("exact", rate), reference);
        EXPECT_NEAR(judgement.position_error, errors.drawn, 0.012 * errors.drawn);
        EXPECT_TRUE(!(judgement.step_error > 1e-9)) << judgement.step_error;
    }
}

// The scene ends within a step of 1 Hz; its line counts up to the end only.
TEST(Judge, EndsWithinAStep) {
    const Scene scene = spring(60, 0.3);
    const Judgement judgement = judge(scene, with("exact", 1), reference_of(scene));
    const Errors errors = chord_errors(1, 0.3, 0);
    EXPECT_NEAR(judgement.position_error, errors.drawn, 0.012 * errors.drawn);
    EXPECT_LT(errors.drawn, 0.9 * chord_errors(1, 1, 0).drawn);
}

// At the frames of a 60 Hz display, exact steps of 60 Hz have no error, and those of 30 Hz that of
// the middle of each chord.
TEST(Judge, ComparesAtTheFramesOfADisplay) {
    const Scene scene = spring(60, 10);
    const Reference reference = reference_of(scene);
    const auto error = [&](std::int64_t rate) {
        return judge(scene, with("exact", rate), reference, {.display = 60}).position_error;
    };
    EXPECT_TRUE(!(error(60) > 1e-9));
    double middle = 0;
    for (int n = 0; n < 300; ++n) {
        const Real t = n / 30.0L;
        const Real line = (exact(t).x + exact(t + 1 / 30.0L).x) / 2;
        middle = std::max(middle, static_cast<double>(std::abs(line - exact(t + 1 / 60.0L).x)));
    }
    EXPECT_NEAR(error(30), middle, 1e-9);
}

// A run may end at an error that is larger than any caller needs to know.
TEST(Judge, EndsEarlyAboveEnough) {
    const Scene scene = spring(60, 90);
    const Reference reference = reference_of(scene);
    const Settings settings = with("semi_implicit_euler", 60);
    const Judgement whole = judge(scene, settings, reference);
    const Judgement part = judge(scene, settings, reference, {.enough = whole.position_error / 4});
    EXPECT_TRUE(whole.complete);
    EXPECT_FALSE(part.complete);
    EXPECT_GT(part.position_error, whole.position_error / 4);
    EXPECT_LT(part.position_error, whole.position_error / 3);
}

// The largest error at the steps so far, at the ends of 64 parts: a quarter of the way at a quarter
// of the time.
TEST(Judge, RecordsTheGrowthOfTheError) {
    const Scene scene = spring(60, 10);
    const Judgement judgement = judge(scene, with("semi_implicit_euler", 240), reference_of(scene));
    ASSERT_EQ(judgement.growth.size(), 64U);
    for (const std::size_t part : {15U, 31U, 63U}) {
        const double until = 10 * static_cast<double>(part + 1) / 64;
        const Errors errors = stepped_errors(find_method("semi_implicit_euler"), 240, until);
        EXPECT_NEAR(judgement.growth[part], errors.x, 0.012 * errors.x) << part;
    }
}

// Without damping, energies at steps are exact, and so are those between.
TEST(Judge, ReportsNoDriftOfAnExactEnergy) {
    const Scene scene = spring(60, 10);
    const Judgement judgement = judge(scene, with("exact", 4), reference_of(scene));
    EXPECT_GT(judgement.position_error, 1);
    EXPECT_TRUE(std::isnan(judgement.energy_drift)) << judgement.energy_drift;
}

// 2 kg that fall for 2 s reach 400 J, the scale of drifts. After n
// steps semi-implicit Euler is at −g·dt²·n(n + 1)/2, which is g·dt·t/2 too low: m·g²·dt·t/2 =
// 10/3 J are missing at the end, 1/120 of 400 J.
TEST(Judge, ScalesDriftsByTheLargestKineticEnergy) {
    Scene scene;
    scene.stepping.rate.steps = 60;
    scene.duration = 2;
    scene.gravity = {{-10, 0, 0}};
    scene.bodies = {{.matter = {.mass = 2}}};
    const Reference reference = reference_of(scene);
    const Judgement judgement = judge(scene, with("semi_implicit_euler", 60), reference);
    EXPECT_NEAR(judgement.energy_drift, 1 / 120.0, 1e-12);
}

TEST(Judge, ReportsNoErrorBelowTheFloor) {
    const Scene scene = spring(60, 10);
    const Reference reference = reference_of(scene);
    const Settings settings = with("semi_implicit_euler", 60);
    const Judgement told = judge(scene, settings, reference);
    ASSERT_TRUE(std::isfinite(told.position_error + told.velocity_error + told.energy_drift));
    for (const double times : {0.99, 1.01}) {
        Reference poor = reference;
        // Only the uncertainty at the last sample counts; it is a hundredth of the floor.
        poor.uncertainties.back() = {times * told.position_error / 100, 0, 0};
        Judgement judgement = judge(scene, settings, poor);
        EXPECT_EQ(judgement.below_floor(), times > 1);
        EXPECT_EQ(std::isnan(judgement.position_error), times > 1);
        EXPECT_EQ(judgement.velocity_error, told.velocity_error);
        EXPECT_EQ(judgement.energy_drift, told.energy_drift);
        EXPECT_TRUE(judgement.stable);
        poor.uncertainties.back() = {0, times * told.velocity_error / 100,
                                     times * told.energy_drift / 100};
        judgement = judge(scene, settings, poor);
        EXPECT_EQ(judgement.position_error, told.position_error);
        EXPECT_EQ(std::isnan(judgement.velocity_error), times > 1);
        EXPECT_EQ(std::isnan(judgement.energy_drift), times > 1);
        EXPECT_FALSE(judgement.below_floor());
    }
}

TEST(Judge, StopsWhereTheReferenceStopsBeingMeaningful) {
    const Scene scene = spring(60, 10);
    Reference reference = reference_of(scene);
    reference.meaningful_until = 2;
    const Judgement judgement = judge(scene, with("semi_implicit_euler", 60), reference);
    expect_errors(judgement, stepped_errors(find_method("semi_implicit_euler"), 60, 2));
    EXPECT_EQ(judgement.evaluations, 120);
}

void expect_unstable(const Judgement& judgement) {
    EXPECT_FALSE(judgement.stable);
    EXPECT_FALSE(judgement.below_floor());
    EXPECT_TRUE(std::isnan(judgement.position_error));
    EXPECT_TRUE(std::isnan(judgement.velocity_error));
    EXPECT_TRUE(std::isnan(judgement.phase_error));
    EXPECT_TRUE(std::isnan(judgement.energy_drift));
}

// Explicit Euler's amplitude grows by √(1 + 15/60²) per step: 75,000 times in 90 s. Verlet's limit
// is ω·dt = 2; at 1 Hz it grows 12 times per second.
TEST(Judge, DetectsAnUnstableRun) {
    const Scene scene = spring(60, 90);
    const Reference reference = reference_of(scene);
    expect_unstable(judge(scene, with("explicit_euler", 60), reference));
    expect_unstable(judge(scene, with("velocity_verlet", 1), reference));
    EXPECT_TRUE(judge(scene, with("velocity_verlet", 2), reference).stable);
}

TEST(Judge, CountsAnErrorAboveTenTimesTheExtentAsUnstable) {
    const Scene scene = spring(60, 10);
    Reference reference = reference_of(scene);
    const Settings settings = with("semi_implicit_euler", 60);
    const double error = judge(scene, settings, reference).position_error;
    reference.extent = error / 10 * 1.001;
    EXPECT_TRUE(judge(scene, settings, reference).stable);
    reference.extent = error / 10 * 0.999;
    expect_unstable(judge(scene, settings, reference));
}

// In a second, explicit Euler grows by √(1 + 10⁸/61²) = 164 per step, to
// 10¹³⁵ m: infinite in float, finite in double.
TEST(Judge, DetectsARunThatOverflows) {
    const Scene scene = spring(61, 5, 0, 1e8);
    const Reference reference = reference_of(scene);
    Settings settings = with("explicit_euler", 61);
    expect_unstable(judge(scene, settings, reference));
    settings.stepping.precision = Precision::single;
    expect_unstable(judge(scene, settings, reference));
}

/// The time of the `nth` upward crossing of `level` by cos(angle·t + φ).
double upwards(double angle, double phase, double level, double nth) {
    return ((1.5 + 2 * nth) * std::numbers::pi + std::asin(level) - phase) / angle;
}

// With the kick first, x = A·cos(Ωt + φ) at steps, with Ω·dt = 2·asin(ω·dt/2), φ = Ω·dt/2 and
// A = x0/cos φ: the run is ahead. A chord from −a to b around the middle of a sine crosses it
// ab(a − b)/6 ≤ h³·√3/108 beside it, h = Ω·dt; off the middle, up to h²/8 of the level more.
TEST(Judge, ReportsThePhaseOfSemiImplicitEuler) {
    for (const std::int64_t rate : {100, 20}) {
        SCOPED_TRACE(rate);
        const Scene scene = spring(rate, 90);
        const Reference reference = reference_of(scene);
        ASSERT_TRUE(reference.oscillation);
        const double dt = 1 / static_cast<double>(rate);
        const double faster = 2 / dt * std::asin(omega * dt / 2);
        const double phase = faster * dt / 2;
        const double level = reference.oscillation->level / start_x;
        const auto last = static_cast<double>(reference.oscillation->crossings.size() - 1);
        EXPECT_EQ(last, 54);
        const double ahead =
            upwards(omega, 0, level, last) - upwards(faster, phase, level * std::cos(phase), last);
        const double h = faster * dt;
        const double slack =
            (std::pow(h, 3) * std::sqrt(3) / 108 + h * h / 8 * std::abs(level)) / omega;
        const double degrees = 360 * omega / (2 * std::numbers::pi);
        EXPECT_NEAR(judge(scene, with("semi_implicit_euler", rate), reference).phase_error,
                    degrees * ahead, degrees * slack);
        EXPECT_GT(ahead, 20 * slack);
    }
}

// At 4 Hz semi-implicit Euler is ahead by 2.4 cycles at the end. RK4, with a phase of
// arg(1 + iθ − θ²/2 − iθ³/6 + θ⁴/24) per step, θ = ω/4, is behind by 100°. A chord of 1 rad crosses
// the middle up to 0.01 rad beside the sine. The level is 0.02 of RK4's remaining amplitude.
TEST(Judge, CountsWholeCyclesAndLags) {
    const Scene scene = spring(60, 90);
    const Reference reference = reference_of(scene);
    ASSERT_TRUE(reference.oscillation);
    const double t = upwards(omega, 0, 0, 54);
    const double euler = 8 * std::asin(omega / 8);
    const double degrees = 180 / std::numbers::pi;
    EXPECT_NEAR(judge(scene, with("semi_implicit_euler", 4), reference).phase_error,
                degrees * omega * (t - upwards(euler, euler / 8, 0, 54)), 2);
    const std::complex<double> i(0, omega / 4);
    const double rk4 = 4 * std::arg(1.0 + i * (1.0 + i / 2.0 * (1.0 + i / 3.0 * (1.0 + i / 4.0))));
    const double lag = degrees * omega * (t - upwards(rk4, 0, 0, 54));
    EXPECT_LT(lag, -90);
    EXPECT_NEAR(judge(scene, with("rk4", 4), reference).phase_error, lag, 2.5);
}

TEST(Judge, ReportsNoPhaseWithoutAnOscillation) {
    Scene scene;
    scene.stepping.rate.steps = 60;
    scene.duration = 2;
    scene.gravity = {-10, 0, 0};
    scene.bodies = {{.velocity = {10, 0, 0}}};
    const Judgement judgement = judge(scene, with("semi_implicit_euler", 60), reference_of(scene));
    EXPECT_TRUE(std::isnan(judgement.phase_error));
    // The error of x is g·dt·t/2.
    EXPECT_NEAR(judgement.position_error, 10 / 60.0 * 2 / 2, 1e-12);
}

// v² + ω²x² − ω²·dt·x·v stays ω²x0², so 2E/ω²x0² − 1 = dt·x·v/x0², which is at most h/(2 − h) on
// that ellipse, h = ω·dt. Steps fall everywhere on it; the one nearest to the maximum is within a
// step's phase over the number of periods.
TEST(Judge, ReportsTheEnergyOfSemiImplicitEuler) {
    for (const std::int64_t rate : {50, 20}) {
        const Scene scene = spring(rate, 90);
        const Judgement judgement =
            judge(scene, with("semi_implicit_euler", rate), reference_of(scene));
        const double h = omega / static_cast<double>(rate);
        EXPECT_LE(judgement.energy_drift, h / (2 - h) * (1 + 1e-12));
        EXPECT_GE(judgement.energy_drift, h / (2 - h) * (1 - 1e-3));
    }
}

TEST(Judge, CountsEvaluations) {
    const Scene scene = spring(60, 10);
    const Reference reference = reference_of(scene);
    for (const auto& [name, evaluations] :
         {std::pair{"semi_implicit_euler", 1}, {"velocity_verlet", 1}, {"rk4", 4}, {"pefrl", 4}}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(evaluations_per_step(scene, with(name, 60)), evaluations);
        EXPECT_EQ(judge(scene, with(name, 60), reference).evaluations, 600 * evaluations);
        EXPECT_EQ(judge(scene, with(name, 45), reference).evaluations, 450 * evaluations);
    }
    // The last kick depends on velocities, so the next step's first kick needs another evaluation.
    const Scene damped = spring(60, 10, 0.1);
    Settings settings = with("velocity_verlet", 60);
    EXPECT_EQ(evaluations_per_step(damped, settings), 1);
    settings.stepping.damping = Damping::in_kick;
    EXPECT_EQ(evaluations_per_step(damped, settings), 2);
}

TEST(Judge, RefusesAMethodThatCannotStepTheScene) {
    Scene scene = spring(60, 10);
    const Reference reference = reference_of(scene);
    EXPECT_EQ(why_not(scene, with("exact", 60)), "");
    scene.springs[0].rest_length = 1;
    const std::string reason = why_not(scene, with("exact", 60));
    EXPECT_FALSE(reason.empty());
    EXPECT_EQ(reason, line_of_error(Exit::usage,
                                    [&] { (void)judge(scene, with("exact", 60), reference); }));
    EXPECT_EQ(why_not(scene, with("rk4", 60)), "");
}

}  // namespace
}  // namespace oiler::test
