// SPDX-License-Identifier: MIT
// The pre-flight's warnings of drag, attraction and rounded positions, compared with runs.
#include "oiler/sim/bodies.hpp"
#include "support/dice.hpp"
#include "support/explained_step.hpp"
#include "support/springs.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

bool diverges(Bodies bodies, const Method& method, const Rate& at, std::int64_t steps) {
    return bodies.try_step(method, {at, 0, steps}).has_value();
}

const Method* one_of(Dice& dice, const std::vector<const char*>& names) {
    return &find_method(names[dice.below(names.size())]);
}

// ---- drag

double speed_after_a_step(Bodies bodies, const Method& method, const Rate& at) {
    EXPECT_FALSE(bodies.try_step(method, {at}));
    return bodies.velocity(0)[0];
}

Bodies shot(double speed, double drag) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.velocity = {speed, 0}}, QuadraticDrag{drag});
    return bodies;
}

// v' = v·(1 − c·|v|·dt) is turned round from c·|v|·dt = 1 on, and grows from 2 on.
TEST(QuadraticDragWarning, NamesLimitSpeedAndRate) {
    const Method& euler = find_method("semi_implicit_euler");
    const auto lines = warnings(shot(200, 1), euler, {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "quadratic drag of body 0: c·|v|·dt = 3.333 at 200 m/s, semi_implicit_euler needs < "
              "1: rate ≥ 201 Hz, or implicit_euler");
    EXPECT_TRUE(diverges(shot(200, 1), euler, {99}, 2000));
    EXPECT_LT(speed_after_a_step(shot(200, 1), euler, {199}), 0);
    EXPECT_GT(speed_after_a_step(shot(200, 1), euler, {201}), 0);
    EXPECT_TRUE(warnings(shot(200, 1), euler, {201}).empty());
}

// The factors of a step of linear drag are 1 − x for both kick Euler methods, (2 − x)/(2 + x) for
// implicit_midpoint and 1 − x + x²/2 − x³/6 for rk3, which has its zero at 1.596. Quadratic drag
// has 1 − x, and (2/x)·(√(1 + 2x) − 1) − 1 for implicit_midpoint, negative from 4 on.
TEST(DragWarning, IsGivenIfAStepThrowsTheBodyBack) {
    struct Limit {
        const char* method;
        double linear;
        double quadratic;
    };
    constexpr double none = 1e3;
    for (const auto& [name, linear, quadratic] : {Limit{"explicit_euler", 1, 1},
                                                  {"semi_implicit_euler", 1, 1},
                                                  {"implicit_midpoint", 2, 4},
                                                  {"rk3_kutta", 1.5961, none},
                                                  {"implicit_euler", none, none},
                                                  {"velocity_verlet", none, none}}) {
        const Method& method = find_method(name);
        for (const double part : {0.5, 0.9, 0.99, 1.01, 1.1, 1.4}) {
            const double x = part * std::min(linear, 50.0);
            Bodies slowed(2, Precision::double_);
            slowed.add({.mass = 2, .velocity = {3, -4}}, LinearDrag{2 * 60 * x});
            EXPECT_EQ(!warnings(slowed, method, {60}).empty(), x > linear) << name << x;
            if (quadratic == none) continue;
            EXPECT_EQ(!warnings(shot(60 * part * quadratic, 1), method, {60}).empty(), part > 1)
                << name << part;
        }
    }
}

// Explicit Euler multiplies the velocity by 1 − c·dt, which is stable up to 2 and turns from 1 on.
TEST(DragWarning, NamesARateThatThrowsNothingBack) {
    const Method& euler = find_method("explicit_euler");
    for (const double c : {90.0, 121.0, 200.0, 1000.0}) {
        Bodies slowed(1, Precision::double_);
        slowed.add({.velocity = {1}}, LinearDrag{c});
        const auto lines = warnings(slowed, euler, {60});
        ASSERT_EQ(lines.size(), 1U) << c;
        EXPECT_TRUE(holds(lines[0], "explicit_euler needs < 1:")) << lines[0];
        const auto named = static_cast<double>(rate_in(lines[0]));
        EXPECT_GT(1 - c / named, 0) << lines[0];
        EXPECT_LE(1 - c / (named - 1), 0) << lines[0];
        EXPECT_TRUE(warnings(slowed, euler, {rate_in(lines[0])}).empty()) << c;
    }
}

// Nothing is thrown back that does not move, and the true motion of a soft spring turns.
TEST(DragWarning, IsNotGivenIfNothingIsThrownBack) {
    const Method& euler = find_method("semi_implicit_euler");
    Bodies resting(1, Precision::double_);
    resting.add({}, LinearDrag{90});
    EXPECT_TRUE(warnings(resting, euler, {60}).empty());
    Bodies released(1, Precision::double_);
    released.add({.position = {1}}, Spring{.stiffness = 400}, LinearDrag{90});
    EXPECT_TRUE(warnings(released, euler, {60}).empty());
    Bodies turning(1, Precision::double_);
    turning.add({.position = {10}, .velocity = {1}}, Spring{.stiffness = 400}, LinearDrag{30});
    EXPECT_TRUE(warnings(turning, euler, {60}).empty());
}

// In wind of 50 m/s a body at rest is thrown on to 50 + 33 m/s.
TEST(DragWarning, IsGivenInWind) {
    Bodies bodies(2, Precision::double_);
    bodies.add({}, Wind{.velocity = {50, 0}, .coefficient = 2});
    const Method& euler = find_method("semi_implicit_euler");
    const auto lines = warnings(bodies, euler, {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(holds(lines[0], "c·|v|·dt = 1.667 at 50 m/s")) << lines[0];
    EXPECT_NEAR(speed_after_a_step(bodies, euler, {60}), 50 + 50 * (5 / 3.0 - 1), 1e-9);
    EXPECT_TRUE(warnings(bodies, euler, {rate_in(lines[0])}).empty());
}

// Half-steps of quadratic drag around the step are exact.
TEST(QuadraticDragWarning, IsNotGivenIfTheMethodSplitsDragOff) {
    for (const char* name : {"velocity_verlet", "forest_ruth4", "implicit_euler"}) {
        EXPECT_TRUE(warnings(shot(1e6, 1), find_method(name), {60}).empty()) << name;
        EXPECT_FALSE(diverges(shot(1e6, 1), find_method(name), {60}, 1000)) << name;
    }
}

/// The terminal speed √(g/c) has the rate 2·√(g·c).
Bodies falling(double speed, double drag, double gravity) {
    Bodies bodies = shot(speed, drag);
    bodies.set_gravity({0, -gravity});
    return bodies;
}

double speed_of(const Bodies& bodies) { return std::sqrt(squared_length(bodies.velocity(0))); }

// 2·√(10·10) s⁻¹: explicit Euler needs 10 Hz to settle at 1 m/s.
TEST(QuadraticDragWarning, IsGivenIfTheTerminalSpeedIsNotStable) {
    const Method& euler = find_method("explicit_euler");
    const auto lines = warnings(falling(0.1, 10, 10), euler, {9});
    ASSERT_GE(lines.size(), 1U);
    EXPECT_TRUE(
        holds(lines[0],
              "quadratic drag of body 0: 2·c·|v|·dt = 2.222 at the terminal speed of 1 m/s, "
              "explicit_euler needs < 2: rate ≥ 11 Hz"))
        << lines[0];
    Bodies slow = falling(0.1, 10, 10);
    Bodies fast = slow;
    EXPECT_TRUE(slow.try_step(euler, {{9}, 0, 1000}) || std::abs(speed_of(slow) - 1) > 0.1);
    EXPECT_FALSE(fast.try_step(euler, {{11}, 0, 1000}));
    EXPECT_NEAR(speed_of(fast), 1, 1e-6);
    EXPECT_TRUE(warnings(falling(0.1, 10, 10), euler, {11}).empty());
}

/// Whether v' = v + dt·(−k·x − c·|v|·v), x' = x + dt·v' turns the body from rest at x > 0 outwards
/// before it has passed 0, or diverges.
bool is_thrown_back(double x, double k, double c, double dt) {
    double v = 0;
    for (int tick = 0; tick < 500 && x > 0; ++tick) {
        v += dt * (-k * x - c * std::abs(v) * v);
        x += dt * v;
        if (!(v <= 0)) return true;
    }
    return false;
}

// The spring gives the body its speed. From 1 m it reaches 10 m/s at most.
TEST(QuadraticDragWarning, KnowsTheSpeedThatASpringGives) {
    const auto pulled = [](double distance) {
        Bodies bodies(1, Precision::double_);
        bodies.add({.position = {distance}}, Spring{.stiffness = 100}, QuadraticDrag{1});
        return bodies;
    };
    const Method& method = find_method("semi_implicit_euler");
    for (const double distance : {0.1, 1.0, 3.0, 5.0, 7.0, 10.0, 30.0, 100.0})
        EXPECT_EQ(!warnings(pulled(distance), method, {20}).empty(),
                  is_thrown_back(distance, 100, 1, 1 / 20.0))
            << distance;
}

TEST(RandomDrag, IsWarnedOfIfItDivergesTurnsOrNeverSettles) {
    int unstable_runs = 0;
    for (int seed = 0; seed < campaign_length(); ++seed) {
        Dice random(static_cast<std::uint64_t>(seed));
        const Method& method = *one_of(
            random, {"explicit_euler", "semi_implicit_euler", "rk2_heun", "rk3_kutta", "rk4"});
        const double drag = random.log_uniform(0.01, 10);
        const double gravity = seed % 3 == 0 ? 0 : random.log_uniform(1, 100);
        const double terminal = std::sqrt(gravity / drag);
        const double speed = random.log_uniform(0.5, 5) * (gravity > 0 ? terminal : 10);
        const double dt = random.log_uniform(1, 6) / (drag * std::max(speed, 2 * terminal));
        const auto is_unstable = [&](double step) {
            Bodies bodies = falling(speed, drag, gravity);
            // Drag never turns the velocity along x.
            for (int tick = 0; tick < 512; ++tick)
                if (bodies.try_step(method, {rate_of(step), tick}) || bodies.velocity(0)[0] < 0)
                    return true;
            if (bodies.try_step(method, {rate_of(step), 512, 20'000})) return true;
            return gravity > 0 && std::abs(speed_of(bodies) - terminal) > 0.01 * terminal;
        };
        const bool warned = is_warned(falling(speed, drag, gravity), method, dt);
        const bool unstable = is_unstable(dt);
        unstable_runs += unstable;
        const std::string where = "seed " + std::to_string(seed) + " " + std::string(method.name);
        EXPECT_TRUE(warned || !unstable) << "missed: " << where;
        if (warned && !unstable) {
            EXPECT_TRUE(is_unstable(1.05 * dt)) << "too early: " << where;
        }
    }
    EXPECT_GT(unstable_runs, campaign_length() / 5);
    EXPECT_LT(unstable_runs, campaign_length() * 4 / 5);
}

// ---- attractors

/// A body at the farthest point of an orbit around gm = 1 with the closest point at 1 m.
Bodies orbiting(double eccentricity) {
    const double distance = (1 + eccentricity) / (1 - eccentricity);
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {distance}, .velocity = {0, std::sqrt((1 + eccentricity)) / distance}},
               Attractor{.gm = 1});
    return bodies;
}

/// Whether 100 revolutions change the orbit's energy by half, or by a tenth if the method is not
/// symplectic, or free the body. Energies close to the attractor, where their error is large and
/// vanishes again, do not count.
bool is_lost(Bodies bodies, const Method& method, double dt, double eccentricity) {
    const double farthest = (1 + eccentricity) / (1 - eccentricity);
    const double energy = -(1 - eccentricity) / 2;
    const double period = 2 * std::acos(-1.0) * std::pow(1 / (1 - eccentricity), 1.5);
    const auto steps = static_cast<std::int64_t>(std::min(100 * period / dt, 200'000.0));
    const double tolerance = method.symplectic ? 0.5 : 0.1;
    int inside = 0;
    for (std::int64_t tick = 0; tick < steps; ++tick) {
        if (bodies.try_step(method, {rate_of(dt), tick})) return true;
        const double distance = std::sqrt(squared_length(bodies.position(0)));
        inside = distance < farthest / 2 ? inside + 1 : 0;
        if (inside * dt > 2 * period) return true;
        const double now = squared_length(bodies.velocity(0)) / 2 - 1 / distance;
        if (inside == 0 && std::abs(now / energy - 1) >= tolerance) return true;
    }
    return false;
}

TEST(AttractorWarning, NamesDistanceAndRate) {
    const Method& verlet = find_method("velocity_verlet");
    const auto lines = warnings(orbiting(0.9), verlet, {1, 2});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with(
        "attractor of body 0: ω·dt = 2.828 at the closest point of the "
        "orbit, 1 m, velocity_verlet loses the orbit in revolution 2: rate ≥ "))
        << lines[0];
    EXPECT_FALSE(holds(lines[0], "implicit"));
    const double dt = 1 / static_cast<double>(rate_in(lines[0]));
    EXPECT_FALSE(is_lost(orbiting(0.9), verlet, dt, 0.9)) << lines[0];
}

TEST(AttractorWarning, OfABodyOnAnAttractorIsToMoveIt) {
    for (const Method& method : methods()) {
        if (method.order == exact_order) continue;
        Bodies bodies(2, Precision::single);
        bodies.add({.position = {3, 4}}, Attractor{.centre = {3, 4}, .gm = 1});
        const auto lines = warnings(bodies, method, {60});
        ASSERT_EQ(lines.size(), 1U) << method.name;
        EXPECT_EQ(lines[0],
                  "body 0 is on an attractor, where the force has no direction: move the body");
    }
}

TEST(AttractorWarning, OfAFallIntoTheCentreNamesNoRate) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {3, 4}}, Attractor{.gm = 1});
    const auto lines = warnings(bodies, find_method("rk4"), {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(holds(lines[0], "leads into its centre, which no rate resolves"));
}

// A passage is not a revolution: the local frequency decides.
TEST(AttractorWarning, IsGivenForAFastPassage) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {-10, 0.1}, .velocity = {3, 0}}, Attractor{.gm = 1});
    EXPECT_EQ(warnings(bodies, find_method("velocity_verlet"), {10}).size(), 1U);
    EXPECT_EQ(warnings(bodies, find_method("velocity_verlet"), {10'000}).size(), 0U);
}

// 1 AU from the sun's attraction of 4π² AU³/a², a bit farther out and too slow for a circle.
TEST(AttractorWarning, IsGivenForImplicitMethodsWithARemedy) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {1.3, 0}, .velocity = {0, 4.61}}, Attractor{.gm = 39.478});
    const auto lines = warnings(bodies, find_method("implicit_euler"), {40});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(holds(lines[0], "implicit_euler loses the orbit in revolution 1: ")) << lines[0];
    EXPECT_TRUE(lines[0].ends_with(", or velocity_verlet")) << lines[0];
    EXPECT_TRUE(diverges(bodies, find_method("implicit_euler"), {40}, 20));
    EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), {40}).empty());
    Bodies followed = bodies;
    EXPECT_FALSE(followed.try_step(find_method("velocity_verlet"), {{40}, 0, 100'000}));
    EXPECT_LT(std::sqrt(squared_length(followed.position(0))), 1.5);
}

// The stiff spring alone would name implicit_midpoint, which loses the orbit beside it.
TEST(Remedy, IsNoMethodThatLosesAnOrbit) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = {1, 0}}, Spring{.stiffness = 9 * 3600.0});
    const Method& verlet = find_method("velocity_verlet");
    EXPECT_TRUE(warnings(bodies, verlet, {60})[0].ends_with(", or implicit_midpoint"));
    bodies.add({.position = {10, 0}, .velocity = {0, 60}}, Attractor{.gm = 1e5});
    const auto lines = warnings(bodies, verlet, {60});
    EXPECT_TRUE(is_warned(bodies, find_method("implicit_midpoint"), 1 / 60.0));
    for (const std::string& line : lines) EXPECT_FALSE(holds(line, "implicit_midpoint")) << line;
}

// A float at 10⁶ m has multiples of 1/16 m; with both methods 1/60 m is rounded to nothing.
TEST(Remedy, IsNamedBesideARoundingThatBothMethodsHave) {
    const Method& verlet = find_method("velocity_verlet");
    Bodies bodies(1, Precision::single);
    bodies.add({.position = {1}}, Spring{.stiffness = 9 * 3600.0});
    bodies.add({.position = {1e6}, .velocity = {1}});
    const auto lines = warnings(bodies, verlet, {60});
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_TRUE(lines[0].ends_with(", or implicit_midpoint")) << lines[0];
    EXPECT_TRUE(holds(lines[1], "do not move it")) << lines[1];
}

TEST(RandomOrbits, AreWarnedOfIfTheBodyIsLost) {
    int lost_runs = 0;
    for (int seed = 0; seed < campaign_length(); ++seed) {
        Dice random(static_cast<std::uint64_t>(seed));
        const Method& method =
            *one_of(random, {"semi_implicit_euler", "velocity_verlet", "position_verlet",
                             "rk3_kutta", "rk4", "pefrl", "implicit_midpoint", "implicit_euler"});
        const double eccentricity = random.uniform(0, 0.95);
        const double dt = random.log_uniform(0.1, 4);
        const bool warned = is_warned(orbiting(eccentricity), method, dt);
        const bool lost = is_lost(orbiting(eccentricity), method, dt, eccentricity);
        lost_runs += lost;
        const std::string where = "seed " + std::to_string(seed) + " " + std::string(method.name) +
                                  " e = " + std::to_string(eccentricity) +
                                  ", dt = " + std::to_string(dt);
        EXPECT_TRUE(warned || !lost) << "missed: " << where;
        if (warned && !lost) {
            EXPECT_TRUE(is_lost(orbiting(eccentricity), method, 1.05 * dt, eccentricity))
                << "too early: " << where;
        }
    }
    EXPECT_GT(lost_runs, campaign_length() / 5);
    EXPECT_LT(lost_runs, campaign_length() * 4 / 5);
}

/// The energy of a long run relative to its first, at the farthest place of each revolution.
double worst_energy(const Orbit& orbit, const Method& method, std::int64_t hertz,
                    double revolutions) {
    Bodies bodies(2, Precision::double_);
    bodies.add({.position = orbit.r, .velocity = orbit.v}, Attractor{.gm = orbit.gm});
    double worst = 0;
    const double steps = revolutions * orbit.period() * static_cast<double>(hertz);
    for (std::int64_t tick = 0; static_cast<double>(tick) < steps; tick += 8) {
        if (bodies.try_step(method, {{hertz}, tick, 8})) return INFINITY;
        const Orbit now{{}, bodies.position(0), bodies.velocity(0), orbit.gm};
        if (length(now.r) > orbit.farthest() / 2)
            worst = std::max(worst, std::abs(now.energy() / orbit.energy() - 1));
    }
    return worst;
}

// A body that falls almost straight into the centre has thousands of steps per revolution, and few
// at its closest point, which decide: a rate that is named holds it for as many revolutions as this
// test has time for, or none is named.
TEST(AttractorWarning, NamesARateThatHoldsLongEllipses) {
    int named = 0;
    int without = 0;
    for (const char* name : {"velocity_verlet", "rk4"})
        for (const double across : {0.1, 0.05, 0.01}) {
            const Orbit orbit{{}, {1.97, 0, 0}, {0, across, 0}, 1};
            Bodies bodies(2, Precision::double_);
            bodies.add({.position = orbit.r, .velocity = orbit.v}, Attractor{.gm = 1});
            const Method& method = find_method(name);
            const auto lines = warnings(bodies, method, {60});
            if (lines.empty()) {
                EXPECT_LT(worst_energy(orbit, method, 60, 100), 0.5) << name << across;
                continue;
            }
            const std::size_t at = lines[0].find("rate ≥ ");
            without += at == std::string::npos;
            if (at == std::string::npos) {
                EXPECT_TRUE(holds(lines[0], "another position or velocity") ||
                            holds(lines[0], "velocity_verlet"));
                continue;
            }
            const std::int64_t hertz = rate_in(lines[0]);
            const double revolutions = hertz < 2000 ? 100 : 3;
            EXPECT_LT(worst_energy(orbit, method, hertz, revolutions), 0.5) << lines[0];
            ++named;
        }
    EXPECT_GT(named, 2) << without;
}

// The silent rates of a body that passes at 0.2 mm: its energy changes by half within some
// revolutions.
TEST(AttractorWarning, IsGivenAtRatesThatFlingTheBodyOut) {
    for (const auto& [across, hertz] : {std::pair(0.02, 65'034), std::pair(0.01, 71'538)}) {
        const Orbit orbit{{}, {1.97, 0, 0}, {0, across, 0}, 1};
        Bodies bodies(2, Precision::double_);
        bodies.add({.position = orbit.r, .velocity = orbit.v}, Attractor{.gm = 1});
        const Method& verlet = find_method("velocity_verlet");
        EXPECT_GT(worst_energy(orbit, verlet, hertz, 3.3), 0.5) << across;
        EXPECT_EQ(warnings(bodies, verlet, {hertz}).size(), 1U) << across;
    }
}

// ---- positions in float

Bodies far_away(Precision precision, double x, double v) {
    Bodies bodies(2, precision);
    bodies.add({.position = {x, 1}, .velocity = {v, 0}});
    return bodies;
}

// Half of the last place of 10⁷ is 0.5 m.
TEST(RoundedPosition, IsWarnedOfWithItsRemedy) {
    const auto lines =
        warnings(far_away(Precision::single, 1e7, 10), find_method("velocity_verlet"), {60});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0],
              "position x of body 0: its steps are shorter than 0.5 m, half of the last place in "
              "float, and do not move it: take precision double, or an origin nearer to it");
    EXPECT_TRUE(
        warnings(far_away(Precision::double_, 1e7, 10), find_method("velocity_verlet"), {60})
            .empty());
}

// Gravity makes it fast enough; a body at rest need not move.
TEST(RoundedPosition, IsNotWarnedOfIfTheBodySoonMoves) {
    const Method& verlet = find_method("velocity_verlet");
    Bodies bodies = far_away(Precision::single, 1e4, 0.01);
    EXPECT_EQ(warnings(bodies, verlet, {60}).size(), 1U);
    bodies.set_gravity({9.8, 0});
    EXPECT_EQ(warnings(bodies, verlet, {60}).size(), 0U);
    EXPECT_EQ(warnings(far_away(Precision::single, 1e9, 0), verlet, {60}).size(), 0U);
}

/// A body that flies along x under a constant acceleration.
struct Flight {
    double x;  ///< m
    double v;  ///< m/s
    double a;  ///< m/s²

    [[nodiscard]] Bodies in(Precision precision) const {
        Bodies bodies(2, precision);
        bodies.add({.position = {static_cast<float>(x), 1}, .velocity = {static_cast<float>(v)}});
        bodies.set_gravity({static_cast<float>(a), 0});
        return bodies;
    }
    /// The relative error in float of the way, or of the change of the velocity, of some steps.
    [[nodiscard]] double error(Risk::Of of, const Method& method, const Rate& rate,
                               std::int64_t steps) const {
        const auto change = [&](Precision precision) {
            Bodies bodies = in(precision);
            const auto number = [&] {
                return of == Risk::Of::rounded_position ? bodies.position(0)[0]
                                                        : bodies.velocity(0)[0];
            };
            const double before = number();
            EXPECT_FALSE(bodies.try_step(method, {rate, 0, steps}));
            return number() - before;
        };
        return change(Precision::single) / change(Precision::double_) - 1;
    }
    [[nodiscard]] std::optional<Risk> risk(const Method& method, const Rate& rate) const {
        const std::vector<Risk> risks = preflight(in(Precision::single), method, {rate});
        return risks.empty() ? std::nullopt : std::optional(risks.front());
    }
};

// The last place is 2⁻¹⁰ m at 10 km, 8 m at 10⁸ m, 2⁻¹⁵ m/s at 300 m/s and 2⁻⁹ m/s at 30 km/s. rk4
// adds sixths and thirds: of 17.07 places 3 + 6 + 6 + 3.
TEST(Rounding, HasTheEffectOfTheRoundedParts) {
    struct Case {
        const char* method;
        Flight flight;
        std::int64_t rate;
        Risk::Of of;
        double effect;
    };
    using enum Risk::Of;
    const double d = 1024.0 / 60;
    const double pull = 0.01 / 240 * 32768;
    for (const Case& one : std::vector<Case>{
             {"rk4", {1e4, 1, 0}, 60, rounded_position, 18 / d - 1},
             {"velocity_verlet", {1e4, 0.03, 0}, 60, rounded_position, 1 / (0.03 * d) - 1},
             {"velocity_verlet", {1e8, 0, 9.81}, 60, rounded_position, -1},
             {"semi_implicit_euler", {0, 300, 0.01}, 240, rounded_velocity, 1 / pull - 1},
             {"velocity_verlet", {0, 300, 0.01}, 240, rounded_velocity, 2 / pull - 1},
             {"implicit_midpoint", {0, 300, 0.01}, 240, rounded_velocity, 2 / pull - 1},
             {"rk4", {0, 300, 0.01}, 240, rounded_velocity, -1},
             {"velocity_verlet", {0, 3e4, 0.00593}, 60, rounded_velocity, -1}}) {
        const Method& method = find_method(one.method);
        const auto risk = one.flight.risk(method, {one.rate});
        ASSERT_TRUE(risk) << one.method;
        EXPECT_EQ(risk->of, one.of) << one.method;
        EXPECT_NEAR(risk->effect, one.effect, 1e-6) << one.method;
        EXPECT_NEAR(one.flight.error(one.of, method, {one.rate}, 64), one.effect, 1e-3)
            << one.method;
    }
}

TEST(Rounding, IsToldWithItsSize) {
    EXPECT_EQ(warnings(Flight{1e4, 1, 0}.in(Precision::single), find_method("rk4"), {60}).at(0),
              "position x of body 0: its steps are rounded to 0.000977 m, the last place in float, "
              "and add up to 5.5 % too much: take precision double, or an origin nearer to it");
    EXPECT_EQ(warnings(Flight{0, 300, 0.01}.in(Precision::single),
                       find_method("semi_implicit_euler"), {240})
                  .at(0),
              "velocity x of body 0: its steps are rounded to 3.05e-05 m/s, the last place in "
              "float, and add up to 27 % too little: take precision double");
}

// A mass that hangs at rest, whose forces balance but for round-off, is not warned of.
TEST(Rounding, IsNoRiskOfABalance) {
    for (const double stiffness : {3.0, 30.0, 700.0}) {
        Bodies bodies(1, Precision::single);
        bodies.set_gravity({-9.81});
        bodies.add({.position = {100 - 9.81 / stiffness}},
                   Spring{.anchor = {100}, .stiffness = stiffness});
        EXPECT_TRUE(warnings(bodies, find_method("velocity_verlet"), {60}).empty()) << stiffness;
    }
}

// The error is that of a run in double, to 1 % of the change.
TEST(RandomFlights, AreWarnedOfWithTheErrorOfTheRun) {
    int wrong_runs = 0;
    for (int seed = 0; seed < campaign_length(); ++seed) {
        Dice random(static_cast<std::uint64_t>(seed));
        // No run of 64 steps leaves the binade.
        const double sign = seed % 2 == 0 ? 1 : -1;
        const double x = sign * 1.5 * std::exp2(std::floor(random.uniform(0, 30)));
        const double v = 1.5 * std::exp2(std::floor(random.uniform(-10, 15)));
        const double a = seed % 3 == 0 ? 0 : random.log_uniform(1e-6, 100);
        const Flight flight{x, v * random.uniform(0.8, 1.2), a};
        const Method& method =
            *one_of(random, {"semi_implicit_euler", "velocity_verlet", "rk4", "blanes_moan_srkn6b",
                             "implicit_midpoint", "exact"});
        const Rate rate{64};
        // Rounding adds up if acceleration changes steps by less than a quarter of a last place.
        const double place = std::exp2(std::floor(std::log2(std::abs(x))) - 23);
        const double turned = a / 64 / place;
        if (std::abs(v) > std::abs(x) / 8 || (turned > 0.2 && turned < 16)) continue;
        const auto risk = flight.risk(method, rate);
        const double error = flight.error(Risk::Of::rounded_position, method, rate, 64);
        const double lost = a == 0 ? 0 : flight.error(Risk::Of::rounded_velocity, method, rate, 64);
        const std::string what = fmt::format("{} m, {} m/s, {} m/s², {}: {} and {}", flight.x,
                                             flight.v, a, method.name, error, lost);
        wrong_runs += std::abs(error) > 0.03 || std::abs(lost) > 0.03;
        if (risk)
            EXPECT_NEAR(risk->of == Risk::Of::rounded_position ? error : lost, risk->effect, 0.01)
                << what;
        else
            EXPECT_LE(std::max(std::abs(error), std::abs(lost)), 0.03) << what;
    }
    EXPECT_GT(wrong_runs, campaign_length() / 8);
}

}  // namespace
}  // namespace oiler::test
