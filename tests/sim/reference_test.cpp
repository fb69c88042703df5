// SPDX-License-Identifier: MIT
#include "support/reference.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/convergence.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The largest difference between numbers and those of a reference.
template <std::size_t N>
Real distance(const std::array<Real, N>& numbers, const nlohmann::json& expected) {
    Real largest = 0;
    for (std::size_t i = 0; i < N; ++i)
        largest = std::max(largest, std::abs(numbers[i] - number<Real>(expected.at(i))));
    return largest;
}

/// √((k + 2kc)/m), 1/s: the frequency of the mode in which the masses move oppositely.
const Real fastest = std::sqrt(18.0L);

/// wall-k-m-kc-m-k-wall. `apart` (m) is the distance between the masses at rest, and the rest
/// length of the spring between them. The first mass starts 1 m from its rest position.
Bodies coupled_springs(double apart, Precision precision) {
    Bodies bodies(1, precision);
    bodies.add({.position = {1}}, Spring{.stiffness = 15});
    bodies.add({.position = {apart}}, Spring{.anchor = {apart}, .stiffness = 15});
    bodies.link(0, 1, {.stiffness = 1.5, .rest_length = apart});
    return bodies;
}

Real coupled_distance(const Bodies& bodies, double apart, const nlohmann::json& expected) {
    const auto a = bodies.state(0);
    const auto b = bodies.state(1);
    return distance<4>({a.x[0], a.v[0], b.x[0] - apart, b.v[0]}, expected);
}

/// The largest error over all times of the reference except the last.
Real coupled_error(const Method& method, int steps_per_second, double apart,
                   const nlohmann::json& states) {
    Bodies bodies = coupled_springs(apart, Precision::extended);
    std::int64_t tick = 0;
    Real largest = 0;
    for (const char* t : {"0.5", "1", "5", "10"}) {
        const auto end = static_cast<std::int64_t>(std::stod(t) * steps_per_second);
        bodies.step(method, {{steps_per_second}, tick, end - tick});
        tick = end;
        largest = std::max(largest, coupled_distance(bodies, apart, states.at(t)));
    }
    return largest;
}

TEST(CoupledSprings, MeetTheReference) {
    const auto states = reference("coupled_and_kepler").at("two_coupled_equal").at("states");
    ASSERT_EQ(states.size(), 5U);
    for (const double apart : {0.0, 16.0})
        for (const Method* method : high_orders()) {
            SCOPED_TRACE(std::string(method->name) + ", apart " + std::to_string(apart));
            const auto error = [&](int steps) {
                return coupled_error(*method, steps, apart, states);
            };
            expect_convergence(*method, method->order, error, 16, {fastest, 50},
                               method->order == 4 ? 1e-8L : 1e-11L);
        }
}

// With 128 steps per second the error of methods of order 8 is less than 1e-14. The rest is
// unbiased round-off: a kick and a drift round twice each, by at most ω·u.
TEST(CoupledSprings, MeetTheReferenceInDoubleAfter50Seconds) {
    constexpr int rate = 128;
    const auto states = reference("coupled_and_kepler").at("two_coupled_equal").at("states");
    for (const Method* method : high_orders()) {
        if (method->order < 8) continue;
        Bodies bodies = coupled_springs(0, Precision::double_);
        bodies.step(*method, {{rate}, 0, 50 * rate});
        const auto roundings = 4.0L * 50 * rate * method->evaluations;
        EXPECT_LT(coupled_distance(bodies, 0, states.at("50")),
                  std::sqrt(roundings) * round_off * fastest)
            << method->name;
    }
}

/// A planet with gm = 1 and a semi-major axis of 1, from its perihelion.
struct Orbit {
    explicit Orbit(const char* eccentricity) : e(std::strtold(eccentricity, nullptr)) {
        const auto run = reference("coupled_and_kepler")
                             .at("kepler_GM1_a1")
                             .at("values")
                             .at(std::string("e=") + eccentricity);
        const auto& from = run.at("start");
        start = {{number<Real>(from.at("x")), 0}, {0, number<Real>(from.at("vy"))}};
        states = run.at("states (x,y,vx,vy)");
    }
    /// The rate at which the motion changes. Its singularity in complex time is at 1 − e·cos E = 0.
    [[nodiscard]] Real rate() const {
        return e > 0 ? std::max(1.0L, 1 / (std::acosh(1 / e) - std::sqrt(1 - e * e))) : 1;
    }
    [[nodiscard]] Real error(const State<Real, 2>& at, int t) const {
        return distance<4>({at.x[0], at.x[1], at.v[0], at.v[1]}, states.at(std::to_string(t)));
    }

    Real e;
    State<Real, 2> start{};
    nlohmann::json states;
};

/// The largest error at the times of the reference up to `last` s.
Real orbit_error(const Method& method, int steps_per_second, const Orbit& orbit, int last) {
    const AttractorForce<Real, 2> sun{.centre = {}, .gm = 1};
    State<Real, 2> state = orbit.start;
    int at = 0;
    Real largest = 0;
    for (const int t : {1, 2, 5, 10}) {
        if (t > last) break;
        const auto steps = std::int64_t{t - std::exchange(at, t)} * steps_per_second;
        state = moved(method, state, sun, 1.0L / steps_per_second, steps);
        largest = std::max(largest, orbit.error(state, t));
    }
    return largest;
}

void expect_orbit(const Method& method, const Orbit& orbit, int last, int steps, Real ceiling) {
    SCOPED_TRACE(testing::Message() << method.name << ", e = " << orbit.e);
    const auto error = [&](int n) { return orbit_error(method, n, orbit, last); };
    expect_convergence(method, method.order, error, steps, {orbit.rate(), 50}, ceiling);
}

TEST(Kepler, OrbitsMeetTheReference) {
    for (const Method* method : high_orders()) {
        const Real ceiling = method->order == 4 ? 1e-11L : 1e-12L;
        expect_orbit(*method, Orbit("0"), 10, 4, ceiling);
        expect_orbit(*method, Orbit("0.2"), 10, 8, ceiling);
        expect_orbit(*method, Orbit("0.5"), 10, 16, ceiling);
        expect_orbit(*method, Orbit("0.6"), 10, 32, ceiling);
        expect_orbit(*method, Orbit("0.9"), 2, 128, ceiling);
    }
}

// Order 6 would need ten times as many steps, order 4 a million.
TEST(Kepler, ACometsOrbitMeetsTheReference) {
    for (const Method* method : high_orders())
        if (method->order >= 8) expect_orbit(*method, Orbit("0.99"), 1, 4096, 1e-12L);
}

template <class T>
void expect_same_orbit(const Method& method, Precision precision) {
    constexpr double x = 0.4;
    constexpr double vy = 2;
    Bodies bodies(2, precision);
    bodies.add({.position = {x}, .velocity = {0, vy}}, Attractor{.gm = 1});
    bodies.step(method, {{100}, 0, 100});
    const AttractorForce<T, 2> sun{.centre = {}, .gm = 1};
    const auto state = moved(method, State<T, 2>{{T(x), 0}, {0, T(vy)}}, sun, T(1) / 100, 100);
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_EQ(bodies.state(0).x[axis], state.x[axis]) << method.name;
        EXPECT_EQ(bodies.state(0).v[axis], state.v[axis]) << method.name;
    }
}

// The results above for one state in long double also hold for bodies.
TEST(Kepler, BodiesTakeTheStepsOfAState) {
    for (const Method* method : high_orders()) {
        expect_same_orbit<float>(*method, Precision::single);
        expect_same_orbit<double>(*method, Precision::double_);
        expect_same_orbit<Real>(*method, Precision::extended);
    }
}

/// The tolerance for an orbit after `roundings` roundings. A rounding of v by u·v changes the
/// energy by u·v² and so the frequency by 3u·v²; a rounding of x changes it by 3u/r. Unbiased
/// roundings add up to √roundings of these, and move the planet along its orbit in proportion to t.
/// The start adds one rounding.
Real orbit_round_off(const Orbit& orbit, const nlohmann::json& at, Real t, Real roundings) {
    const Real nearest = 1 - orbit.e;
    const Real speed = orbit.start.v[1];
    const Real r = std::hypot(number<Real>(at.at(0)), number<Real>(at.at(1)));
    const Real fastest_change = std::max(speed, 1 / (r * r));
    return 3 * round_off * (speed * speed + 1 / nearest) * t * (1 + std::sqrt(roundings)) *
           fastest_change;
}

// With 256 steps per second the error of methods of order 8 is less than 1e-14 in 10 s.
TEST(Kepler, BodiesMeetTheReferenceInDoubleFor100Seconds) {
    constexpr int rate = 256;
    const std::array<Orbit, 4> orbits{Orbit("0"), Orbit("0.2"), Orbit("0.5"), Orbit("0.6")};
    for (const Method* method : high_orders()) {
        if (method->order < 8) continue;
        Bodies bodies(2, Precision::double_);
        for (const Orbit& orbit : orbits)
            bodies.add({.position = {static_cast<double>(orbit.start.x[0])},
                        .velocity = {0, static_cast<double>(orbit.start.v[1])}},
                       Attractor{.gm = 1});
        std::int64_t tick = 0;
        for (const int t : {1, 2, 5, 10, 50, 100}) {
            bodies.step(*method, {{rate}, tick, t * rate - tick});
            tick = std::int64_t{t} * rate;
            for (std::size_t i = 0; i < orbits.size(); ++i) {
                const auto& expected = orbits[i].states.at(std::to_string(t));
                const auto [x, v] = bodies.state(i);
                EXPECT_LT(distance<4>({x[0], x[1], v[0], v[1]}, expected),
                          orbit_round_off(orbits[i], expected, t, Real(tick) * method->evaluations))
                    << method->name << ", e = " << orbits[i].e << ", t = " << t;
            }
        }
    }
}

/// The complete elliptic integral K for the modulus √(1 − b²): π/2 over the arithmetic-geometric
/// mean of 1 and b.
Real elliptic_k(Real b) {
    Real a = 1;
    for (int i = 0; i < 8; ++i) {
        const Real mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return std::numbers::pi_v<Real> / (2 * a);
}

/// An oscillation that is a Jacobi function of time, from rest at `start`, through 0 with −`speed`.
struct Oscillation {
    Real start;    ///< the amplitude
    Real speed;    ///< at 0, a quarter period later
    Real quarter;  ///< quarter period, s
    Real rate;     ///< per quarter period: K/K′, because its poles are at iK′
    Real size;     ///< scale of errors: the largest acceleration
};

/// The larger of the errors after a quarter period and after a period.
template <class Physics>
Real oscillation_error(const Method& method, const Physics& physics, const Oscillation& oscillation,
                       int steps) {
    const Real dt = oscillation.quarter / steps;
    const auto quarter =
        moved(method, State<Real, 1>{{oscillation.start}, {0}}, physics, dt, steps);
    const auto period = moved(method, quarter, physics, dt, 3 * steps);
    return std::max({std::abs(quarter.x[0]), std::abs(quarter.v[0] + oscillation.speed),
                     std::abs(period.x[0] - oscillation.start), std::abs(period.v[0])});
}

template <class Physics>
void expect_oscillation(const Physics& physics, const Oscillation& oscillation) {
    for (const Method* method : high_orders()) {
        SCOPED_TRACE(method->name);
        const auto error = [&](int n) {
            return oscillation_error(*method, physics, oscillation, n);
        };
        expect_convergence(*method, method->order, error, 4,
                           {oscillation.rate, 50 * oscillation.size},
                           method->order == 4 ? 1e-11L : 1e-12L);
    }
}

struct Pendulum {
    static Vec<Real, 1> accelerate(const State<Real, 1>& state, double) {
        return {-std::sin(state.x[0])};
    }
};

// From 2 rad: the modulus is sin 1, and v²/2 = 1 − cos 2 at the bottom.
TEST(Pendulum, MeetsItsEllipticFunctions) {
    const Real k = std::sin(1.0L);
    const Real quarter = elliptic_k(std::cos(1.0L));
    expect_oscillation(Pendulum{}, {2, 2 * k, quarter, quarter / elliptic_k(k), 1});
}

struct Duffing {
    static Vec<Real, 1> accelerate(const State<Real, 1>& state, double) {
        const Real x = state.x[0];
        return {-x - 3 * x * x * x};
    }
};

// The motion from 2 is 2·cn(Ωt) with Ω² = 1 + 3·2² and the squared modulus m = 3·2²/2Ω² = 6/13. At
// 0, v²/2 = 2²/2 + 3·2⁴/4.
TEST(Duffing, MeetsItsEllipticFunction) {
    const Real m = 6 / 13.0L;
    const Real k = elliptic_k(std::sqrt(1 - m));
    expect_oscillation(
        Duffing{}, {2, std::sqrt(28.0L), k / std::sqrt(13.0L), k / elliptic_k(std::sqrt(m)), 26});
}

}  // namespace
}  // namespace oiler::test
