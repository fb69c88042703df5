// SPDX-License-Identifier: MIT
#include "support/convergence.hpp"
#include "support/oscillator.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The projectile of 1 kg of a reference, in all digits. Its y axis points up.
struct Flight {
    std::string name;
    Real g;
    Real drag;   ///< 1/s, or 1/m where it is quadratic
    Real speed;  ///< its largest, m/s
    State<Real, 2> start;
    nlohmann::json run;

    [[nodiscard]] Real end() const { return number<Real>(run.at("states").back().at("t")); }
    /// The distance at its largest speed over the whole time, m.
    [[nodiscard]] Real reach() const { return speed * end(); }
};

Flight linear_flight(const nlohmann::json& run) {
    const Real angle = number<Real>(run.at("deg")) * std::numbers::pi_v<Real> / 180;
    const Real speed = number<Real>(run.at("v0"));
    const State<Real, 2> start{{0, 0}, {speed * std::cos(angle), speed * std::sin(angle)}};
    return {
        run.at("name"), number<Real>(run.at("g")), number<Real>(run.at("beta")), speed, start, run};
}

Flight quadratic_flight(const nlohmann::json& run) {
    const State<Real, 2> start{{number<Real>(run.at("x0")), number<Real>(run.at("y0"))},
                               {number<Real>(run.at("vx0")), number<Real>(run.at("vy0"))}};
    return {run.at("name"),
            number<Real>(run.at("g")),
            number<Real>(run.at("k_per_m")),
            number<Real>(run.at("v0")),
            start,
            run};
}

/// From rest towards the terminal speed.
Flight fall(const nlohmann::json& run) {
    const Real g = number<Real>(run.at("g"));
    const Real terminal = number<Real>(run.at("vt"));
    return {run.at("name"),
            g,
            g / (terminal * terminal),
            terminal,
            {{0, number<Real>(run.at("y0"))}, {0, 0}},
            run};
}

std::vector<Flight> quadratic_flights() {
    std::vector<Flight> flights;
    for (const auto& run : reference("projectile_quadratic_drag"))
        flights.push_back(quadratic_flight(run));
    for (const auto& run : reference("vertical_quadratic_drag")) flights.push_back(fall(run));
    return flights;
}

Vec3 rounded(const Vec<Real, 2>& vector) {
    return {static_cast<double>(vector[0]), static_cast<double>(vector[1])};
}

template <class Drag>
Bodies bodies_of(const Flight& flight, Precision precision) {
    Bodies bodies(2, precision);
    bodies.set_gravity({0, -static_cast<double>(flight.g)});
    bodies.add({.position = rounded(flight.start.x), .velocity = rounded(flight.start.v)},
               Drag{static_cast<double>(flight.drag)});
    return bodies;
}

template <class State>
Real distance(const State& state, const nlohmann::json& expected) {
    Real largest = 0;
    const auto compare = [&](Real value, const char* key) {
        if (expected.contains(key))
            largest = std::max(largest, std::abs(value - number<Real>(expected.at(key))));
    };
    compare(state.x[0], "x");
    compare(state.x[1], "y");
    compare(state.v[0], "vx");
    compare(state.v[1], "vy");
    compare(state.v[1], "v");
    return largest;
}

/// The largest error at the times of the reference that are multiples of 0.5 s.
template <class Drag>
Real flight_error(const Method& method, const Flight& flight, int steps_per_half,
                  Precision precision = Precision::extended) {
    Bodies bodies = bodies_of<Drag>(flight, precision);
    std::int64_t tick = 0;
    Real largest = 0;
    for (const auto& expected : flight.run.at("states")) {
        const Real halves = 2 * number<Real>(expected.at("t"));
        if (halves != std::floor(halves)) continue;
        const std::int64_t end = static_cast<std::int64_t>(halves) * steps_per_half;
        bodies.step(method, {{2 * steps_per_half}, tick, end - tick});
        tick = end;
        largest = std::max(largest, distance(bodies.state(0), expected));
    }
    return largest;
}

Real rounding_of(Real exact) { return std::abs(exact - static_cast<double>(exact)); }

/// The largest distance from the reference's states caused by rounding the start to double.
Real start_effect(const Flight& flight) {
    const Real t = flight.end();
    return (rounding_of(flight.start.v[0]) + rounding_of(flight.start.v[1])) * t +
           rounding_of(flight.g) * t * t / 2 +
           rounding_of(flight.drag) * (flight.speed * t * t / 2 + flight.g * t * t * t / 6);
}

// Gravity in the kicks and drag in the drifts do not commute: this tests the order. The motion is a
// sum of 1, t and e^(−ct), so that it changes at the rate c. It lasts 3 s, in which order 8 needs
// one or two steps.
TEST(LinearDrag, MeetsTheReference) {
    const auto runs = reference("linear_drag");
    ASSERT_EQ(runs.size(), 2U);
    for (const auto& run : runs) {
        const Flight flight = linear_flight(run);
        const auto& last = run.at("states").back();
        ASSERT_EQ(last.at("t"), "3");
        for (const Method* method : high_orders()) {
            SCOPED_TRACE(flight.name + ", " + std::string(method->name));
            const auto error = [&](int steps) {
                Bodies bodies = bodies_of<LinearDrag>(flight, Precision::extended);
                bodies.step(*method, {{steps, 3}, 0, steps});
                return distance(bodies.state(0), last);
            };
            expect_convergence(*method, method->order, error, 1, {3 * flight.drag, flight.reach()},
                               1e-12L);
            EXPECT_LE(flight_error<LinearDrag>(*method, flight, 256),
                      start_effect(flight) + 1e-12L);
        }
    }
}

/// The largest round-off, with every factor of a step rounded to the same side: steps · factors ·
/// round_off, relative to the reach plus the fall.
Real worst_round_off(const Flight& flight, Real steps, int factors) {
    return steps * factors * round_off * (flight.reach() + flight.g * flight.end() * flight.end());
}

TEST(LinearDrag, MeetsTheReferenceInDoubleToRoundOff) {
    for (const auto& run : reference("linear_drag"))
        for (const Method* method : high_orders()) {
            if (method->order < 6) continue;
            const Flight flight = linear_flight(run);
            EXPECT_LE(flight_error<LinearDrag>(*method, flight, 16, Precision::double_),
                      start_effect(flight) + worst_round_off(flight, 96, method->evaluations + 1))
                << flight.name << ", " << method->name;
        }
}

TEST(LinearDrag, IsExactForTheExactMethod) {
    const Method& exact = find_method("exact");
    for (const auto& run : reference("linear_drag"))
        for (const int steps : {1, 64}) {
            const Flight flight = linear_flight(run);
            const Real start = start_effect(flight);
            // The round-off of long double is 2048 times smaller than that of double.
            const Real rounding = worst_round_off(flight, 6 * steps, 2);
            EXPECT_LE(flight_error<LinearDrag>(exact, flight, steps), start + rounding / 2048);
            EXPECT_LE(flight_error<LinearDrag>(exact, flight, steps, Precision::double_),
                      start + rounding);
        }
}

/// Drag alone changes the speed by 1/(1 + κ·v·t); gravity and drag have the time scale 1/√(gκ).
Scale quadratic_scale(const Flight& flight) {
    return {std::sqrt(flight.g * flight.drag) + flight.drag * flight.speed, 5 * flight.reach()};
}

// Runge–Kutta methods keep their orders. The leading error of order 3 is so small that with weak
// drag the next order dominates.
TEST(QuadraticDrag, MeetsTheReferencesWithItsDraggedOrder) {
    const auto flights = quadratic_flights();
    ASSERT_EQ(flights.size(), 10U);
    for (const Flight& flight : flights)
        for (const Method& method : methods()) {
            const int order = dragged_order(method, Damping::in_drift);
            if (order != 2 && order != 4) continue;
            SCOPED_TRACE(flight.name + ", " + std::string(method.name));
            const auto error = [&](int steps) {
                return flight_error<QuadraticDrag>(method, flight, steps);
            };
            Scale scale = quadratic_scale(flight);
            scale.rate /= 2;
            expect_convergence(method, order, error, 1, scale,
                               flight.reach() * (order == 2 ? 1e-7L : 1e-13L));
        }
}

struct FlightForces {
    GravityForce<Real, 2> gravity;
    QuadraticDragForce<Real, 2> drag;

    [[nodiscard]] Vec<Real, 2> accelerate(const State<Real, 2>& state, double t) const {
        return oiler::accelerate(gravity, state, t) + drag.accelerate(state, t);
    }
};

FlightForces forces_of(const Flight& flight) {
    return {{.acceleration = {0, -flight.g}}, {flight.drag}};
}

/// Compares at the exact time of an event, which no integer rate has, from the start in all digits.
void expect_event(const Method& method, const Flight& flight, const nlohmann::json& event) {
    const Real t = number<Real>(event.at("t"));
    const FlightForces forces = forces_of(flight);
    SCOPED_TRACE(flight.name + ", t = " + event.at("t").get<std::string>() + ", " +
                 std::string(method.name));
    const auto error = [&](int steps) {
        return distance(moved(method, flight.start, forces, t / steps, steps), event);
    };
    const Scale scale = quadratic_scale(flight);
    expect_convergence(method, 4, error, 4, {t * scale.rate, scale.size}, 1e-12L * flight.reach());
}

TEST(QuadraticDrag, ApexAndLandingMatchTheReferences) {
    const auto runs = reference("projectile_quadratic_drag");
    const auto ball = reference("vertical_quadratic_drag").at(1);
    for (const char* name : {"rk4", "rk4_38"}) {
        for (const auto& run : runs) {
            nlohmann::json apex = run.at("apex");
            nlohmann::json landing = run.at("landing");
            apex["vy"] = landing["y"] = "0";
            expect_event(find_method(name), quadratic_flight(run), apex);
            expect_event(find_method(name), quadratic_flight(run), landing);
        }
        expect_event(find_method(name), fall(ball), ball.at("states").at(2));
    }
}

/// Strang's step: half a step of drag, one of falling, half a step of drag.
State<Real, 2> strang_step(State<Real, 2> at, Real g, Real drag, Real dt) {
    const auto slow = [&] {
        const Real factor = 1 / (1 + drag * std::hypot(at.v[0], at.v[1]) * dt / 2);
        at.v = {at.v[0] * factor, at.v[1] * factor};
    };
    slow();
    at.x = {at.x[0] + at.v[0] * dt, at.x[1] + at.v[1] * dt - g * dt * dt / 2};
    at.v[1] -= g * dt;
    slow();
    return at;
}

// Splittings of order 2 and above are exact for constant gravity, so that all take the same step
// with drag around it. They differ by the last of their 14 or more published digits.
TEST(QuadraticDrag, SplittingsTakeStrangsStep) {
    const Flight flight = quadratic_flight(reference("projectile_quadratic_drag").at(0));
    const Bodies start = bodies_of<QuadraticDrag>(flight, Precision::extended);
    const auto from = start.state(0);
    State<Real, 2> expected{{from.x[0], from.x[1]}, {from.v[0], from.v[1]}};
    for (int i = 0; i < 64; ++i)
        expected = strang_step(expected, static_cast<double>(flight.g),
                               static_cast<double>(flight.drag), 1 / 64.0L);
    for (const Method& method : methods()) {
        if (!is_splitting(method) || method.order < 2) continue;
        Bodies bodies = start;
        bodies.step(method, {{64}, 0, 64});
        const auto [x, v] = bodies.state(0);
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_LE(std::abs(x[axis] - expected.x[axis]), 1e-14L * flight.speed) << method.name;
            EXPECT_LE(std::abs(v[axis] - expected.v[axis]), 1e-14L * flight.speed) << method.name;
        }
    }
}

}  // namespace
}  // namespace oiler::test
