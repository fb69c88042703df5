// SPDX-License-Identifier: MIT
#include <complex>

#include "lab/motions.hpp"
#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/lab/reference/landing_motion.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Complex = std::complex<Real>;

constexpr Real fine = std::numeric_limits<Real>::epsilon() / 2;
/// The closed form uses forces per mass that are rounded to double.
constexpr Real coarse = std::numeric_limits<double>::epsilon() / 2;

Bodies in_space() { return Bodies(3, Precision::extended); }

Real length(const Vec<Real, 3>& a) { return std::hypot(a[0], a[1], a[2]); }

/// x'' = a − s·x − c·v along one axis.
struct Linear {
    Real a = 0;
    Real s = 0;
    Real c = 0;
    Real x0 = 0;
    Real v0 = 0;

    /// The textbook's formula with the two roots of r² + c·r + s = 0. It is accurate if the roots
    /// are neither close to each other nor far apart.
    [[nodiscard]] std::pair<Real, Real> at(Real t) const {
        const Complex root = std::sqrt(Complex(c * c / 4 - s));
        const Complex r1 = -c / 2 + root;
        const Complex r2 = -c / 2 - root;
        const Real y0 = x0 - a / s;
        const Complex first = (v0 - r2 * y0) / (r1 - r2);
        const Complex second = (r1 * y0 - v0) / (r1 - r2);
        const Complex e1 = first * std::exp(r1 * t);
        const Complex e2 = second * std::exp(r2 * t);
        return {a / s + (e1 + e2).real(), (r1 * e1 + r2 * e2).real()};
    }
    /// Both roots are −c/2.
    [[nodiscard]] std::pair<Real, Real> critical(Real t) const {
        const Real y0 = x0 - a / s;
        const Real w = v0 + c / 2 * y0;
        const Real decay = std::exp(-c / 2 * t);
        return {a / s + (y0 + w * t) * decay, (w - c / 2 * (y0 + w * t)) * decay};
    }
};

/// The sizes of the terms, which scale the roundings.
struct Sizes {
    Real x;
    Real v;
};

/// The tolerance: `roundings` of the motion's size, and as many per radian or time constant.
void expect_near(Real found, Real expected, Real size, Real radians, Real unit) {
    EXPECT_LE(std::abs(found - expected), 16 * (1 + radians) * unit * size) << expected;
}

void expect_axis(const State3& found, int axis, std::pair<Real, Real> expected, const Sizes& sizes,
                 Real radians, Real unit) {
    SCOPED_TRACE("axis " + std::to_string(axis));
    expect_near(found.x[axis], expected.first, sizes.x, radians, unit);
    expect_near(found.v[axis], expected.second, sizes.v, radians, unit);
}

constexpr Vec3 gravity{0.5, -9.75, 1.25};
constexpr Vec3 from{7, -3, 2};
constexpr Vec3 with{-2, 5, 0.25};
const Spring first{.anchor = {1, 2, -4}, .stiffness = 12, .damping = 0.5};
const Spring second{.anchor = {-8, 0, 3}, .stiffness = 3, .damping = 0.25};

Bodies tied(double mass, double drag) {
    Bodies bodies = in_space();
    bodies.set_gravity(gravity);
    bodies.add({.mass = mass, .position = from, .velocity = with}, first, LinearDrag{drag});
    bodies.attach_at(1, 0, second);
    return bodies;
}

Linear axis_of(double mass, double drag, int axis) {
    const Real m = mass;
    return {.a = gravity[axis] + (Real(first.stiffness) * first.anchor[axis] +
                                  Real(second.stiffness) * second.anchor[axis]) /
                                     m,
            .s = (Real(first.stiffness) + second.stiffness) / m,
            .c = (Real(first.damping) + second.damping + drag) / m,
            .x0 = from[axis],
            .v0 = with[axis]};
}

/// The approximate range of the body above on each axis, and ω times that.
constexpr Real reach = 32;

void expect_tied(double mass, double drag, Real unit) {
    SCOPED_TRACE(testing::Message() << mass << " kg, drag " << drag);
    const auto motions = exact_motions(tied(mass, drag), 1);
    ASSERT_TRUE(motions);
    ASSERT_EQ(motions->size(), 1U);
    for (const Real t : {0.0L, 0.125L, 1.0L, 3.3L, 20.0L}) {
        const State3 found = (*motions)[0](t);
        for (int axis = 0; axis < 3; ++axis) {
            const Linear linear = axis_of(mass, drag, axis);
            const Real rate = std::max(std::sqrt(linear.s), linear.c);
            expect_axis(found, axis, linear.at(t), {reach, reach * rate}, rate * t, unit);
        }
    }
}

TEST(ExactMotion, OfSeveralSpringsDragAndGravity) {
    expect_tied(1, 0.25, fine);
    expect_tied(4, 0.25, fine);
    expect_tied(0.125, 0, fine);
}

TEST(ExactMotion, OfMassesThatDivideToNoNumberOfDouble) {
    expect_tied(3, 0.25, coarse);
    expect_tied(0.7, 0.25, coarse);
}

// c²/4 is 16 and 24.5 times the stiffness per mass.
TEST(ExactMotion, OverdampedMeetsItsTwoExponentials) {
    expect_tied(1, 30.25, fine);
    expect_tied(4, 76.25, fine);
}

// c²/4 = s where k = 16 and b = 8 on 1 kg, or k = 1 and b = 4 on 4 kg.
TEST(ExactMotion, CriticallyDampedMeetsItsDoubleRoot) {
    for (const auto& [mass, k, b] : {std::array{1.0, 16.0, 8.0}, std::array{4.0, 1.0, 4.0}}) {
        Bodies bodies(1, Precision::extended);
        bodies.set_gravity({-9.75, 0, 0});
        bodies.add({.mass = mass, .position = {3}, .velocity = {40}},
                   Spring{.anchor = {2}, .stiffness = k, .damping = b});
        const Linear linear{-9.75L + k / mass * 2, k / mass, b / mass, 3, 40};
        const auto motions = exact_motions(bodies, 1);
        ASSERT_TRUE(motions);
        for (const Real t : {0.0L, 0.01L, 0.5L, 4.0L}) {
            const Real rate = b / mass;
            expect_axis((*motions)[0](t), 0, linear.critical(t), {200, 200 * rate}, rate * t, fine);
        }
    }
}

// x = x0 + v0·t + g·t²/2, whatever the mass.
TEST(ExactMotion, OfGravityAloneIsAParabola) {
    Bodies bodies = in_space();
    bodies.set_gravity(gravity);
    bodies.add({.mass = 0.7, .position = from, .velocity = with});
    const auto motions = exact_motions(bodies, 1);
    ASSERT_TRUE(motions);
    for (const Real t : {0.0L, 0.5L, 3.0L, 100.0L})
        for (int axis = 0; axis < 3; ++axis)
            expect_axis((*motions)[0](t), axis,
                        {from[axis] + with[axis] * t + gravity[axis] * t * t / 2,
                         with[axis] + gravity[axis] * t},
                        {8 + 5 * t + 5 * t * t, 5 + 10 * t}, 0, fine);
}

// v = v0·e^(−ct), x = x0 + v0·(1 − e^(−ct))/c, and with gravity v → g/c.
TEST(ExactMotion, OfDragTendsToItsTerminalSpeed) {
    for (const bool falls : {false, true}) {
        Bodies bodies = in_space();
        if (falls) bodies.set_gravity(gravity);
        bodies.add({.mass = 4, .position = from, .velocity = with}, LinearDrag{2});
        const auto motions = exact_motions(bodies, 1);
        ASSERT_TRUE(motions);
        const Real c = 0.5;
        for (const Real t : {0.0L, 0.25L, 3.0L, 60.0L})
            for (int axis = 0; axis < 3; ++axis) {
                const Real terminal = falls ? gravity[axis] / c : 0;
                const Real decay = std::exp(-c * t);
                expect_axis((*motions)[0](t), axis,
                            {from[axis] + terminal * t + (with[axis] - terminal) * (1 - decay) / c,
                             terminal + (with[axis] - terminal) * decay},
                            {64 + 20 * t, 32}, 0, fine);
            }
    }
}

// The file's numbers are decimal: speed, g and c each have a rounding to double.
TEST(ExactMotion, OfLinearDragMeetsTheReference) {
    const auto runs = reference("linear_drag");
    ASSERT_EQ(runs.size(), 2U);
    for (const auto& run : runs) {
        const double angle = number(run.at("deg")) * std::numbers::pi / 180;
        const double speed = number(run.at("v0"));
        Bodies bodies(2, Precision::extended);
        bodies.set_gravity({0, -number(run.at("g")), 0});
        bodies.add({.velocity = {speed * std::cos(angle), speed * std::sin(angle)}},
                   LinearDrag{number(run.at("beta"))});
        const auto motions = exact_motions(bodies, 1);
        ASSERT_TRUE(motions);
        ASSERT_EQ(run.at("states").size(), 4U);
        for (const auto& state : run.at("states")) {
            const Real t = number<Real>(state.at("t"));
            const State3 found = (*motions)[0](t);
            const Sizes sizes{speed * t + 5 * t * t, speed + 10 * t};
            for (int axis = 0; axis < 2; ++axis)
                expect_axis(found, axis,
                            {number<Real>(state.at(axis == 0 ? "x" : "y")),
                             number<Real>(state.at(axis == 0 ? "vx" : "vy"))},
                            sizes, 0, coarse / 2);
        }
    }
}

// b = 0.1 is rounded to double: an error of γt roundings of the amplitude.
TEST(ExactMotion, OfTheArticlesSpringMeetsTheReference) {
    for (const char* which : {"exact_damped", "exact_undamped"}) {
        Bodies bodies(1, Precision::extended);
        bodies.add(
            {.position = {1000}},
            Spring{.stiffness = 15, .damping = which == std::string("exact_damped") ? 0.1 : 0});
        const auto motions = exact_motions(bodies, 1);
        ASSERT_TRUE(motions);
        const auto table = reference("article").at(which).at("table");
        ASSERT_EQ(table.size(), 9U);
        for (const auto& [t, state] : table.items())
            expect_axis((*motions)[0](std::stold(t)), 0,
                        {number<Real>(state[0]), number<Real>(state[1])}, {1000, 3873},
                        0.05L * std::stold(t), coarse / 16);
    }
}

// Each body has its own forces; columns hold zeros for the forces of others.
TEST(ExactMotion, OfEachBodyIsItsOwn) {
    Bodies bodies = in_space();
    bodies.add({.position = from, .velocity = with});
    bodies.add({.position = from, .velocity = with}, first);
    bodies.add({.position = from, .velocity = with}, LinearDrag{0.5});
    const auto motions = exact_motions(bodies, 1);
    ASSERT_TRUE(motions);
    ASSERT_EQ(motions->size(), 3U);
    constexpr Real t = 2;
    for (int axis = 0; axis < 3; ++axis) {
        const Real x = from[axis];
        const Real v = with[axis];
        expect_axis((*motions)[0](t), axis, {x + 2 * v, v}, {32, 8}, 0, fine);
        const Linear spring{12.0L * first.anchor[axis], 12, 0.5L, x, v};
        expect_axis((*motions)[1](t), axis, spring.at(t), {32, 128}, 7, fine);
        expect_axis((*motions)[2](t), axis,
                    {x + v * 2 * (1 - std::exp(-1.0L)), v * std::exp(-1.0L)}, {32, 8}, 1, fine);
    }
}

TEST(ExactMotion, WithZeroStiffnessIsFree) {
    Bodies bodies = in_space();
    bodies.add({.position = from, .velocity = with}, Spring{.anchor = {9, 9, 9}});
    const auto motions = exact_motions(bodies, 1);
    ASSERT_TRUE(motions);
    for (int axis = 0; axis < 3; ++axis)
        expect_axis((*motions)[0](4), axis, {from[axis] + 4 * with[axis], with[axis]}, {32, 8}, 0,
                    fine);
}

const Vec3 sun{3, -2, 1};

/// gm = 2 m³/s², and a planet that crosses the x-y plane, `at` m from the sun.
Bodies planet(double speed, double at = 0.5) {
    Bodies bodies = in_space();
    bodies.add({.mass = 0.7, .position = {3, -2 + at, 1}, .velocity = {0, 0, speed}},
               Attractor{.centre = sun, .gm = 2});
    return bodies;
}

// r·v²/gm = 1 + e. Roundings of the angle are magnified: 3 times by the energy's, and
// (1 + e)/(1 − e)² = 8 times at the perihelion.
TEST(ExactMotion, AroundAnAttractorMeetsKeplersEquation) {
    constexpr Real e = 0.5625;
    constexpr Real a = 0.5L / (1 - e);
    const Real n = std::sqrt(2 / a) / a;
    const auto motions = exact_motions(planet(2.5), 1);
    ASSERT_TRUE(motions);
    for (const Real t : {0.0L, 0.25L, 1.0L, 5.0L, 17.0L}) {
        const Real anomaly_now = anomaly(e, n * t);
        const Real rate = n / (1 - e * std::cos(anomaly_now));
        const Real minor = a * std::sqrt(1 - e * e);
        const State3 found = (*motions)[0](t);
        const Vec<Real, 3> x{3, -2 + a * (std::cos(anomaly_now) - e),
                             1 + minor * std::sin(anomaly_now)};
        const Vec<Real, 3> v{0, -a * rate * std::sin(anomaly_now),
                             minor * rate * std::cos(anomaly_now)};
        EXPECT_LE(length(found.x - x), 16 * fine * (length(x) + 3 * 8 * n * t * a)) << t;
        EXPECT_LE(length(found.v - v), 16 * fine * (1 + 3 * 8 * n * t) * 2.5L) << t;
    }
}

void expect_none(const Bodies& bodies) { EXPECT_FALSE(exact_motions(bodies, 1)); }

TEST(NoExactMotion, OfLinkedBodies) {
    Bodies bodies = tied(1, 0);
    bodies.add({.position = {1, 1, 1}});
    EXPECT_TRUE(exact_motions(bodies, 1));
    bodies.link(0, 1, {.stiffness = 1});
    expect_none(bodies);
}

TEST(NoExactMotion, OfNonlinearForces) {
    Bodies coil = in_space();
    coil.add({.position = from}, CoilSpring{.stiffness = 1, .rest_length = 2});
    expect_none(coil);
    Bodies damper = in_space();
    damper.add({.position = from, .velocity = with}, CoilSpring{.damping = 1, .rest_length = 2});
    expect_none(damper);
    Bodies drag = in_space();
    drag.add({.velocity = with}, QuadraticDrag{0.25});
    expect_none(drag);
}

// If one body has no closed form, the scene has none.
TEST(NoExactMotion, OfOneAmongOthers) {
    Bodies bodies = tied(1, 0);
    bodies.add({.velocity = with}, QuadraticDrag{0.25});
    bodies.add({.position = from});
    expect_none(bodies);
    Bodies nth = tied(1, 0);
    nth.attach(0, CoilSpring{});
    nth.attach_at(1, 0, CoilSpring{.stiffness = 1, .rest_length = 2});
    expect_none(nth);
    Bodies before = tied(1, 0);
    before.attach(0, CoilSpring{.stiffness = 1, .rest_length = 2}, QuadraticDrag{0.25});
    before.attach_at(1, 0, CoilSpring{}, QuadraticDrag{});
    expect_none(before);
    Bodies coil = tied(1, 0);
    coil.attach(0, CoilSpring{.stiffness = 1, .rest_length = 2});
    coil.attach_at(1, 0, CoilSpring{});
    expect_none(coil);
    Bodies drag = tied(1, 0);
    drag.attach(0, QuadraticDrag{0.25}, CoilSpring{});
    drag.attach_at(1, 0, QuadraticDrag{});
    expect_none(drag);
}

TEST(NoExactMotion, AroundAnAttractorThatIsNotAlone) {
    EXPECT_TRUE(exact_motions(planet(2.5), 1));
    Bodies two = planet(2.5);
    two.attach_at(1, 0, Attractor{.centre = {9, 9, 9}, .gm = 0.01});
    expect_none(two);
    Bodies heavy = planet(2.5);
    heavy.set_gravity({0, 0, -1e-9});
    expect_none(heavy);
    Bodies slow = planet(2.5);
    slow.attach(0, LinearDrag{1e-9});
    expect_none(slow);
    Bodies held = planet(2.5);
    held.attach(0, Spring{.stiffness = 1e-9});
    expect_none(held);
}

// At 0.5 m the square of the escape speed is 2·gm/r = 8 m²/s².
TEST(NoExactMotion, OfUnboundOrbits) {
    expect_none(planet(std::sqrt(8.0)));
    expect_none(planet(3));
    expect_none(planet(0));
}

// Both ways to compute a state round alike, to far less than 1e-15 of positions of 1 m. An orbit
// turns fastest near its centre, within a tenth of a tick.
TEST(ExactMotions, AreAtTicksAsTheyAreAtTheirTimes) {
    constexpr std::int64_t rate = 7;
    Bodies bodies = in_space();
    bodies.add({.position = {1, 0, 0}, .velocity = {0, 1, 0}}, LinearDrag{0.5});
    bodies.add({.position = {1, 0, 0}, .velocity = {0, 1, 0}},
               Spring{.anchor = {0.5, 0, 0}, .stiffness = 12, .damping = 0.5});
    bodies.add({.position = {1, 0, 2}, .velocity = {0, 0.4, 0}},
               Attractor{.centre = {0, 0, 2}, .gm = 1});
    auto closed_forms = exact_motions(bodies, 1);
    ASSERT_TRUE(closed_forms);
    const ExactMotions motions(std::move(*closed_forms));
    const auto at_ticks = motions.at_ticks(rate);
    std::vector<State3> states(3);
    const auto expect_at = [&](std::int64_t tick) {
        at_ticks(tick, states);
        for (std::size_t row = 0; row < states.size(); ++row) {
            const State3 there = motions.at(row, static_cast<Real>(tick) / rate);
            EXPECT_LE(length(states[row].x - there.x), 1e-15L) << row << " at tick " << tick;
            EXPECT_LE(length(states[row].v - there.v), 1e-14L) << row << " at tick " << tick;
        }
    };
    for (std::int64_t tick = 0; tick < 300; ++tick) expect_at(tick);
    for (const std::int64_t tick : {130, 129, 700, 0}) expect_at(tick);
}

// A ball over a floor has a closed form, and no other obstacle has one for bodies with a contact.
TEST(ExactMotions, AreUnknownAmongObstaclesOtherThanStandingPlanes) {
    const Obstacle floor{.shape = HalfSpaceShape{{0, 1}}, .restitution = 0.5};
    const auto is_known = [&](const Obstacle& obstacle, const std::optional<Contact>& contact) {
        Bodies bodies(2, Precision::extended);
        bodies.set_gravity({0, -9.81});
        bodies.add_obstacle(floor);
        bodies.add_obstacle(obstacle);
        bodies.add({.position = {0, 4}, .contact = contact});
        return exact_motions(bodies, 2).has_value();
    };
    Obstacle moving{.shape = HalfSpaceShape{{1, 0}, -9}, .velocity = {0.5, 0}};
    Obstacle one_way{.shape = HalfSpaceShape{{1, 0}, -9}, .one_way = Vec3{1, 0}};
    Obstacle belt{.shape = HalfSpaceShape{{1, 0}, -9}, .belt = 1};
    const std::vector<Obstacle> others{{.shape = CircleShape{{9, 9}, 0.5}},
                                       {.shape = SegmentShape{{9, 9}, {9, 8}}},
                                       {.shape = BoxShape{{9, 9}, {1, 1}}},
                                       moving,
                                       one_way,
                                       belt};
    EXPECT_TRUE(is_known({.shape = HalfSpaceShape{{1, 0}, -9}}, Contact{0.25}));
    for (const Obstacle& other : others) {
        EXPECT_FALSE(is_known(other, Contact{0.25})) << other.shape.index();
        EXPECT_TRUE(is_known(other, {})) << other.shape.index();
    }
}

constexpr long double g = 9.81L;

/// The heights of the bounces of a ball that falls from h: h·e^(2n), at times that add up flights.
TEST(LandingMotion, OfABallHasTheKnownHeightsAndTimes) {
    const long double e = 0.8L;
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 2, 0}, {1, 0, 0}}};
    const Plane floor{.normal = {0, 2, 0}, .offset = 1, .restitution = 0.8};
    const auto motion = landing_motion(free, std::span(&floor, 1), 0.25L, 60);
    ASSERT_TRUE(motion);
    const long double height = 2 - 0.75L;
    const long double u = std::sqrt(2 * g * height);
    long double t = u / g;
    for (int n = 1; n <= 20; ++n) {
        // restitution is rounded to double.
        const long double speed = u * std::pow(e, static_cast<long double>(n));
        const auto apex = motion->at(t + speed / g);
        EXPECT_NEAR(static_cast<double>(apex.x[1]),
                    static_cast<double>(0.75L + speed * speed / (2 * g)), 1e-15)
            << n;
        // g·t, with t ≤ 3 s, and restitution rounded to double in n impacts
        EXPECT_NEAR(static_cast<double>(apex.v[1]), 0, 1.2e-16 * g * 3 * n) << n;
        EXPECT_NEAR(static_cast<double>(apex.x[0]), static_cast<double>(t + speed / g), 1e-15);
        t += 2 * speed / g;
    }
    // All bounces are over after u/g + 2·u·e/(g·(1 − e)); then it glides on.
    const long double rest = u / g + 2 * u * e / (g * (1 - e));
    EXPECT_NEAR(static_cast<double>(motion->at(rest + 1e-6L).x[1]), 0.75, 1e-16);
    EXPECT_EQ(static_cast<double>(motion->at(rest + 1).v[1]), 0);
    EXPECT_NEAR(static_cast<double>(motion->at(50).x[0]), 50, 1e-13);
}

// u/(μg) after 4 bounces of no restitution: it slides u²/(2μg) and stays.
TEST(LandingMotion, OfASlideEnds) {
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 0, 0}, {-2, 0, 0}}};
    const Plane floor{.normal = {0, 1, 0}, .friction = 0.5};
    const auto motion = landing_motion(free, std::span(&floor, 1), 0, 10);
    ASSERT_TRUE(motion);
    EXPECT_NEAR(static_cast<double>(motion->at(9).x[0]), static_cast<double>(-4 / g), 1e-17);
    EXPECT_EQ(static_cast<double>(motion->at(9).v[0]), 0);
    const long double half = 1 / g * 2;
    EXPECT_NEAR(static_cast<double>(motion->at(half).v[0]), -1, 1e-17);
}

// At rest again, the body has had all of gravity's impulse from the plane, m·g·t, and μ times that
// along it. Some 40 pieces round speeds of 20 m/s by 1e-18 m/s each.
TEST(LandingMotion, LosesAsMuchSpeedToFrictionInBouncesAsInASlide) {
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 1, 0}, {20, 0, 0}}};
    for (const double restitution : {0.0, 0.25, 0.5}) {
        const Plane floor{.normal = {0, 1, 0}, .restitution = restitution, .friction = 0.25};
        const auto motion = landing_motion(free, std::span(&floor, 1), 0, 5);
        ASSERT_TRUE(motion);
        const auto difference = motion->at(4).v[0] - (20 - 0.25L * g * 4);
        EXPECT_NEAR(static_cast<double>(difference), 0, 1e-16) << restitution;
    }
}

TEST(LandingMotion, IsUnknownBelowAPlaneAndInACorner) {
    const LinearMotion free{{0, -g, 0}, 0, 0, {{0, 1, 0}, {}}};
    const Plane above{.normal = {0, 1, 0}, .offset = 2};
    EXPECT_FALSE(landing_motion(free, std::span(&above, 1), 0, 10));
    const Plane corner[] = {{.normal = {1, 1, 0}}, {.normal = {-1, 1, 0}}};
    EXPECT_FALSE(landing_motion(free, corner, 0, 10));
}

}  // namespace
}  // namespace oiler::test
