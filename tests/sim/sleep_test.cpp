// SPDX-License-Identifier: MIT
// Damped bodies fall asleep before their numbers become subnormal. Undamped motion never sleeps.
#include "oiler/physics/closed_forms.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Rate rate{60};
constexpr double stiffness = 40;
constexpr double damping = 0.8;  // ω = 6.3/s; the amplitude fades as e^(−0.4·t)

/// Bodies fall asleep after ticks that are multiples of this.
constexpr std::int64_t interval = 64;

/// The threshold of sleep: 2²⁶ times the smallest normal number.
double threshold_of(Precision precision) {
    return std::ldexp(precision == Precision::single ? double{std::numeric_limits<float>::min()}
                                                     : std::numeric_limits<double>::min(),
                      26);
}

double size_of(const Bodies& bodies) {
    return std::max(std::abs(static_cast<double>(x_of(bodies))),
                    std::abs(static_cast<double>(v_of(bodies))));
}

/// The smallest size of a body that is awake: 1/40.8 of the threshold, 2²⁰ times the smallest
/// normal number. Its distance, speed or acceleration is at least the threshold, and |a| ≤ k·|x| +
/// b·|v| ≤ (k + b)·size for 1 kg. The factor 0.999 allows for roundings.
double smallest_awake(Precision precision) {
    return 0.999 * threshold_of(precision) / (stiffness + damping);
}

// From 1 m a body reaches the threshold of float after ln(1/7.9e-31)/0.4 = 173 s, and that of
// double after 1726 s. Twice that is enough for any method.
TEST(Sleep, ComesBeforeTheSubnormalNumbers) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4", "exact"})
        for (const Precision precision : precisions) {
            Bodies bodies = oscillator(precision, stiffness, damping, 1);
            const double fades = -std::log(threshold_of(precision)) / (damping / 2);
            for (std::int64_t tick = 0; rate.time(tick) < 2 * fades; tick += interval) {
                bodies.step(find_method(name), {rate, tick, interval});
                const double size = size_of(bodies);
                ASSERT_TRUE(size == 0 || size > smallest_awake(precision)) << name << ", " << tick;
            }
            EXPECT_EQ(size_of(bodies), 0) << name << ", " << name_of(precision);
        }
}

TEST(Sleep, PutsTheBodyOnItsAnchor) {
    Bodies bodies(1, Precision::single);
    bodies.add({.position = {1.5}},
               Spring{.anchor = {0.375}, .stiffness = stiffness, .damping = damping});
    bodies.step(find_method("semi_implicit_euler"), {rate, 0, 100'000});
    EXPECT_EQ(x_of(bodies), 0.375L);
    EXPECT_EQ(v_of(bodies), 0);
}

// Undamped motion may be tiny, and damped motion continues above the threshold.
TEST(Sleep, DoesNotEndTinyMotions) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies undamped = oscillator(Precision::single, stiffness, 0, std::ldexp(1, -110));
    undamped.step(method, {rate, 0, 10'000});
    EXPECT_GT(size_of(undamped), std::ldexp(1, -112));
    Bodies damped = oscillator(Precision::single, stiffness, damping, 1e-25);
    damped.step(method, {rate, 0, interval});
    EXPECT_GT(size_of(damped), 1e-26);
}

// A body at a turning point has no speed, but another force still accelerates it.
TEST(Sleep, NeedsASmallAcceleration) {
    Bodies bodies(2, Precision::double_);
    bodies.set_gravity({0, -9.81, 0});
    bodies.add({}, LinearDrag{0.5});
    bodies.step(find_method("semi_implicit_euler"), {rate, interval - 1, 1});
    EXPECT_LT(bodies.velocity(0)[1], -0.1);
}

TEST(Sleep, IsTheSameBesideLinkedBodies) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4"}) {
        Bodies alone = oscillator(Precision::single, stiffness, damping, 1e-29);
        Bodies beside = alone;
        beside.add({.position = {3}, .velocity = {1}});
        beside.add({.position = {5}});
        beside.link(1, 2, {.stiffness = 5, .rest_length = 1});
        bool moved = false;
        for (std::int64_t tick = 0; tick < 2000; ++tick) {
            for (Bodies* bodies : {&alone, &beside})
                bodies->step(find_method(name), {rate, tick, 1});
            moved = moved || size_of(alone) > 0;
            ASSERT_EQ(x_of(beside), x_of(alone)) << name << ", " << tick;
            ASSERT_EQ(v_of(beside), v_of(alone)) << name << ", " << tick;
        }
        EXPECT_TRUE(moved) << name;
        EXPECT_EQ(size_of(alone), 0) << name;
    }
}

// The speed of both bodies fades as e^(−b·t/m). From 1 m/s it is subnormal in float after 109 s.
// Their positions stay between 4 and 8 m, where floats have one spacing, so the link exerts no
// force.
TEST(Sleep, ComesToLinkedBodiesWithDrag) {
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4"}) {
        Bodies bodies(1, Precision::single);
        for (const double x : {5, 6})
            bodies.add({.position = {x}, .velocity = {1}}, LinearDrag{damping});
        bodies.link(0, 1, {.stiffness = stiffness, .rest_length = 1});
        for (std::int64_t tick = 0; rate.time(tick) < 120; ++tick) {
            bodies.step(find_method(name), {rate, tick, 1});
            for (std::size_t row : {0, 1}) {
                const auto speed = static_cast<double>(std::abs(v_of(bodies, row)));
                ASSERT_TRUE(speed == 0 || speed > std::numeric_limits<float>::min())
                    << name << ", " << tick;
            }
        }
        EXPECT_EQ(v_of(bodies, 0), 0) << name;
        EXPECT_EQ(v_of(bodies, 1), 0) << name;
    }
}

TEST(Sleep, DoesNotDependOnTheStepsPerCall) {
    const Method& method = find_method("semi_implicit_euler");
    Bodies one_call = oscillator(Precision::single, stiffness, damping, 1e-29);
    Bodies one_by_one = one_call;
    bool moved = false;
    for (std::int64_t tick = 0; tick < 2000; ++tick) {
        one_by_one.step(method, {rate, tick, 1});
        moved = moved || size_of(one_by_one) > 0;
    }
    one_call.step(method, {rate, 0, 2000});
    EXPECT_TRUE(moved);
    EXPECT_EQ(x_of(one_call), x_of(one_by_one));
    EXPECT_EQ(v_of(one_call), v_of(one_by_one));
    EXPECT_EQ(size_of(one_call), 0);
}

// Damping from none to heavy overdamping, where the mass creeps back by k/b of its distance per
// second.

constexpr double k = 15;

long double stored(Precision precision, double number) {
    return precision == Precision::single ? static_cast<float>(number) : number;
}
long double stored_dt(Precision precision) {
    return precision == Precision::single ? static_cast<long double>(rate.dt<float>())
                                          : static_cast<long double>(rate.dt<double>());
}

/// The exact motion after `steps` steps from rest at 1 m.
Motion<long double> exact_motion(Precision precision, double b, int steps) {
    return damped_oscillator<long double>(1, k, stored(precision, b), {1, 0},
                                          steps * stored_dt(precision));
}

// 2·√15 is critical, to within a rounding. Above 1e4 N·s/m each velocity is independent of the one
// before, so that it has the roundings of one step only.
TEST(Creep, OfTheExactMethodIsRightForAnyDamping) {
    constexpr int steps = 600;
    const Method& method = find_method("exact");
    for (const Precision precision : precisions)
        for (const double b :
             {0.0, 1e-9, 0.1, 2 * std::sqrt(15.0), 10.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12}) {
            SCOPED_TRACE(testing::Message() << name_of(precision) << ", b = " << b);
            Bodies bodies = oscillator(precision, k, b, 1);
            bodies.step(method, {rate, 0, steps});
            const auto exact = exact_motion(precision, b, steps);
            const double u = round_off_of(precision);
            EXPECT_NEAR(x_of(bodies), exact.x, steps * roundings(method) * u);
            EXPECT_NEAR(v_of(bodies), exact.v, steps * roundings(method) * u * std::sqrt(k));
            if (b < 1e4) continue;
            EXPECT_NEAR(v_of(bodies) / x_of(bodies), exact.v / exact.x,
                        static_cast<double>(8 * u * -exact.v / exact.x));
        }
}

std::vector<long double> coefficients(const Method& method, Move move) {
    std::vector<long double> found;
    if (const auto* splitting = std::get_if<Splitting>(&method.rule))
        for (const auto& stage : splitting->stages())
            if (stage.move == move) found.push_back(stage.coefficient);
    return found;
}

/// The longest backward drift as a fraction of dt.
double farthest_back(const Method& method) {
    long double farthest = 0;
    for (const long double drift : coefficients(method, Move::drift))
        farthest = std::max(farthest, -drift);
    return static_cast<double>(farthest);
}

/// The methods that are stable with any damping.
std::vector<const Method*> creeping_methods() {
    std::vector<const Method*> found;
    for (const Method& method : methods()) {
        const bool explicit_tableau = std::holds_alternative<Tableau>(method.rule);
        if (!explicit_tableau && farthest_back(method) == 0) found.push_back(&method);
    }
    return found;
}

TEST(Creep, IsKeptByPositiveSplittingsImplicitMethodsAndTheExactMethod) {
    EXPECT_EQ(creeping_methods().size(), 5U + 2 + 1);
}

/// The largest relative error of the creep distance with damping `b`. With ε = k·dt/b, a step of a
/// splitting is Π(1 − aᵢ·ε) instead of e^(−ε): a relative error of at most (Σ|aᵢ|)²·ε. Implicit
/// Euler, 1/(1 + ε), has an error of ε/2. Implicit midpoint rings at k/b², which adds
/// 1/(b·dt·steps). Each move also rounds a position of 1 m.
double creep_error(const Method& method, Precision precision, double b, int steps) {
    const auto kicks = coefficients(method, Move::kick);
    long double sum = 1;
    if (!kicks.empty()) sum = 0;
    for (const long double kick : kicks) sum += std::abs(kick);
    const double epsilon = k * rate.dt() / b;
    const auto moves = static_cast<double>(1 + coefficients(method, Move::drift).size());
    return static_cast<double>(sum * sum) * epsilon + 2 / (b * rate.dt() * steps) +
           moves * round_off_of(precision) / epsilon;
}

/// −ln of the ratio of the distances after `steps` + 1 steps and after 1 step. The first step is
/// left out because half a kick may be missing in it.
long double creep(const Method& method, Precision precision, double b, int steps) {
    Bodies bodies = oscillator(precision, k, b, 1);
    bodies.step(method, {.rate = rate, .damping = Damping::in_drift});
    const long double before = x_of(bodies);
    bodies.step(method, {rate, 1, steps, Damping::in_drift});
    return -std::log1p((x_of(bodies) - before) / before);
}

// In double the error is 0.1 % at 1e12 N·s/m, where a step is 2.5e-13 m. Float is tested up to 1e6
// only, because creep stops above 8.4e6 N·s/m.
TEST(Creep, MatchesTheClosedForm) {
    constexpr int steps = 600;
    for (const Method* method : creeping_methods())
        for (const Precision precision : precisions)
            for (double b = 1e4; b <= (precision == Precision::single ? 1e6 : 1e12); b *= 10) {
                const long double exact = -std::log1p(
                    (exact_motion(precision, b, steps + 1).x - exact_motion(precision, b, 1).x) /
                    exact_motion(precision, b, 1).x);
                const long double creeps = creep(*method, precision, b, steps);
                EXPECT_NEAR(creeps / exact, 1, creep_error(*method, precision, b, steps))
                    << method->name << " in " << name_of(precision) << ", b = " << b;
            }
}

/// The damping at which a step from 1 m is half the distance to the next smaller number.
double damping_that_stops(Precision precision) {
    return k * rate.dt() / (round_off_of(precision) / 2);
}

// A limit of the number types: above 8.4e6 N·s/m in float, and 4.5e15 in double, a mass at 1 m
// stands still, with the right velocity.
TEST(Creep, StopsIfAStepIsLessThanHalfTheDistanceBetweenNumbers) {
    EXPECT_NEAR(damping_that_stops(Precision::single), 8.39e6, 1e4);
    EXPECT_NEAR(damping_that_stops(Precision::double_), 4.50e15, 1e13);
    for (const Method* method : creeping_methods())
        for (const Precision precision : precisions) {
            const double b = 1.01 * damping_that_stops(precision);
            Bodies bodies = oscillator(precision, k, b, 1);
            bodies.step(*method, {rate, 0, 10'000, Damping::in_drift});
            EXPECT_EQ(x_of(bodies), 1) << method->name << " in " << name_of(precision);
            EXPECT_GT(creep(*method, precision, b / 4, 10), 0) << method->name;
            if (!is_exact(*method)) continue;
            EXPECT_NEAR(v_of(bodies) * b / -k, 1, 8 * round_off_of(precision));
        }
}

// At 0.9 of the damping that stops creep, a step is 0.556 of the distance between numbers. It
// rounds to 1, which is 1.8 times too fast.
TEST(Creep, IsAlmostTwiceAsFastJustBelowTheDampingThatStopsIt) {
    for (const Precision precision : precisions) {
        Bodies bodies = oscillator(precision, k, 0.9 * damping_that_stops(precision), 1);
        bodies.step(find_method("exact"), {rate, 0, 1000});
        EXPECT_EQ(x_of(bodies), 1 - 1000 * static_cast<long double>(round_off_of(precision)));
    }
}

// A backward drift reverses damping, by the factor e^(c·|τ|). If the factor overflows, the step is
// refused with a remedy, and nothing changes. Arithmetic with twice the digits needs some range, so
// that in double the limit is e^697, not e^709.
TEST(Creep, IsRefusedIfABackwardDriftOverflows) {
    int refused = 0;
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            if (farthest_back(method) == 0) continue;
            SCOPED_TRACE(testing::Message() << method.name << " in " << name_of(precision));
            const double most =
                std::log(largest_of(precision)) / (farthest_back(method) * rate.dt());
            Bodies bodies = oscillator(precision, k, 1.01 * most, 1);
            const std::uint64_t before = hash_of(bodies);
            const std::string line = line_of_error(Exit::usage, [&] {
                bodies.step(method, {rate, 0, 10});
            });
            EXPECT_TRUE(holds(line, "backward drift"));
            EXPECT_TRUE(holds(line, "implicit_euler"));
            EXPECT_EQ(hash_of(bodies), before);
            Bodies just_less = oscillator(precision, k, 0.97 * most, 1);
            EXPECT_NO_THROW(static_cast<void>(just_less.try_step(method, {rate, 0, 1})));
            ++refused;
        }
    EXPECT_GE(refused, 2 * 20);
}

}  // namespace
}  // namespace oiler::test
